#pragma once

#include "core/geometry/axis.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// Whether the beam has no bending stiffness.
bool is_rope(const BeamSpec& beam);

/// The beam's initial axis as the scene draws it, with its corners. Throws NurbsError.
template <int D>
Axis<D> drawn_axis(const CurveSpec& curve);

/// The NURBS curve of a scene, with its weights.
template <int D>
Nurbs<D> drawn_nurbs(const CurveSpec& curve);

/// Whether a drawn axis can have corners at all.
bool may_have_corners(const CurveSpec& curve);

/// How near a joint stands to a corner that is its own, over the length of the beam.
constexpr double corner_rounding = 1e-9;
/// How near a written position is that means the corner, over the standard length of an element.
constexpr double means_corner = 1e-2;

/// Gives joints that are placed by a corner of the drawn axis its material coordinate, and those of a position next to
/// a corner exactly that. Throws InvalidInput for a corner that is not there.
void place_at_corners(Scene& scene);

/// A node of a rope with two slopes, as at a joint that keeps its place. A lumped mass hangs there, a force acts, its
/// section changes, or the drawn axis has a corner that no joint could reach. Where joints with kinks slide along a
/// beam that bends, its lumped masses stop them in the same way, with one slope.
struct Knot {
  int node;
  JointSlopes slopes;
};
/// All knots of a scene, in order. There are none with elements, integrators and joints that do not go with them.
std::vector<Knot> knots(const Scene& scene);

/// Which corners of the drawn axis are rounded off [m]: those of a rope at which neither a joint nor a knot stands.
/// That shortens the rope.
std::vector<double> rounded_corners(const Scene& scene, const Axis<3>& drawn);

/// Where a joint stands on an axis with these breaks [m]: on the drawn axis, or on the one with round corners. Its
/// position is counted along the drawn axis.
double position_on_axis(const CurveSpec& curve, const std::vector<double>& breaks, double position);

}  // namespace vlbeam
