#pragma once

#include "core/geometry/axis.hpp"
#include "core/scene/scene.hpp"
#include "core/system/beam_system.hpp"

namespace vlbeam {

/// Gauss points an element that a scene asks for, its element's default filled in.
int quadrature_points(const Scene& scene);

/// The beam's initial axis. Throws NurbsError.
template <int D>
Axis<D> build_axis(const Scene& scene);

/// Length of the beam [m] and standard element length L_std [m].
double beam_length(const Scene& scene);
double standard_length(const Scene& scene);

/// Whether strains are measured from a shape other than a straight, unstrained one.
bool has_rest_shape(const Scene& scene);

/// How the scene's elements are merged.
MergePolicy merge_policy(const Scene& scene);

/// Distance from a free end at which the sliding mass of the scene leaves [m].
double separation_distance(const Scene& scene);

/// Length of the last element, over L_std, at which the sliding mass of the scene loses its node; 0 for never.
double end_merge(const Scene& scene);
/// With what is not given.
AbsoluteTolerances with_defaults(AbsoluteTolerances atol, const Scene& scene);

/// Material coordinates of the initial nodes, and which of them is the joint's. Throws InvalidInput where the sliding
/// mass has no node of its own between two knots of a NURBS curve.
struct InitialNodes {
  std::vector<double> x;
  int joint = no_joint;
};
InitialNodes place_nodes(const Scene& scene, const std::vector<double>& breaks);

BeamSection build_section(const BeamSpec& beam);

/// What holds a node at which the axis has the given tangent.
template <int D>
Support<D> build_support(const SupportSpec& spec, const Vec<double, D>& tangent);

/// The model and the initial state of a scene that has been validated; `D` is its dimension.
template <int D>
BeamModel<D> build_model(const Scene& scene);
template <int D>
ChainState<D> build_chain(const Scene& scene);

}  // namespace vlbeam
