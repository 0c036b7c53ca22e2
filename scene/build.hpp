#pragma once

#include "core/geometry/axis.hpp"
#include "mechanics/frames/frame_table.hpp"
#include "mechanics/motion/system/beam_system.hpp"
#include "mechanics/spin/spin_element.hpp"
#include "scene/derived.hpp"

namespace vlbeam {

/// The first D components of a point of the scene.
template <int D>
Vec<double, D> vector_of(const Point& point) {
  return Eigen::Map<const Vec<double, D>>(point.data());
}

/// The beam's initial axis. Throws NurbsError.
template <int D>
Axis<D> build_axis(const Scene& scene);

/// Material coordinates of the initial nodes, and which of them are the joints' and the point masses'. Throws
/// InvalidInput where a joint has no node of its own between two knots of a NURBS curve.
struct InitialNodes {
  std::vector<double> x;
  std::vector<int> joints = {};
  std::vector<int> masses = {};  ///< of the scene's point masses
};
InitialNodes place_nodes(const Scene& scene, const std::vector<double>& breaks);

/// Of two bending stiffnesses that about the section's axis y, which is across the plane where there is one.
BeamSection build_section(const BeamSpec& beam);
/// The same, of a rope that goes slack if the scene's does.
BeamSection build_section(const Scene& scene);
SpinSection build_spin(const BeamSpec& beam);
FrameSection build_frames(const BeamSpec& beam);

/// Of the point r in the rigid motion that the scene starts with [m/s].
template <int D>
Vec<double, D> initial_velocity(const Scene& scene, const Vec<double, D>& r);

/// What holds a node at which the axis has the given tangent.
template <int D>
Support<D> build_support(const SupportSpec& spec, const Vec<double, D>& tangent);

/// The model of a scene that has been validated; `D` is its dimension.
template <int D>
BeamModel<D> build_model(const Scene& scene);

/// The beam as it is built, at rest.
template <int D>
ChainState<D> build_shape(const Scene& scene);
/// Gives the scene's initial velocities to a beam at rest.
template <int D>
void set_in_motion(const Scene& scene, ChainState<D>& chain);
/// Both: the initial state of a scene that starts as it is built.
template <int D>
ChainState<D> build_chain(const Scene& scene);

}  // namespace vlbeam
