#pragma once

#include "core/scene/scene.hpp"
#include "core/system/beam_system.hpp"

namespace vlbeam {

/// Gauss points an element that a scene asks for, its element's default filled in.
int quadrature_points(const Scene& scene);

/// Length of the beam [m] and standard element length L_std [m].
double beam_length(const Scene& scene);
double standard_length(const Scene& scene);

/// Distance from a free end at which the sliding mass of the scene leaves [m].
double separation_distance(const Scene& scene);

/// The model and the initial state of a scene that has been validated; `D` is its dimension.
template <int D>
BeamModel<D> build_model(const Scene& scene);
template <int D>
ChainState<D> build_chain(const Scene& scene);

}  // namespace vlbeam
