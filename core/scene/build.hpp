#pragma once

#include "core/geometry/axis.hpp"
#include "core/scene/scene.hpp"
#include "core/system/beam_system.hpp"

namespace vlbeam {

/// A scene to which nothing but the setting is given. Options that depend on others stay open; what they stand for is
/// said by the functions below.
Scene scene_in(SceneSetting setting);

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

/// How the elements of the scene follow a curved axis: evenly; in the paper's setting exactly, where its elements can
/// and no mass slides along a beam that is curved at rest.
AxisForm axis_form(const Scene& scene);

/// How the scene's elements are merged: if it does not say so by the paper's fit, or, where the beam is curved at rest,
/// with the weights of the arc.
MergePolicy merge_policy(const Scene& scene);

/// How weights follow the ends of the scene's elements: if it does not say so they are frozen, but transported where
/// the beam is curved at rest.
WeightTransport weight_transport(const Scene& scene);

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
