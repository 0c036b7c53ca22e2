#pragma once

#include <array>

#include "core/element/twice_active.hpp"
#include "mechanics/frames/frame_element.hpp"
#include "mechanics/frames/rest_triads.hpp"

namespace vlbeam {

// The element of frame_element.hpp between ends whose material coordinates move. With c = l s for slopes, the
// parameter u in the place of x and the length 1 it is the element of a table that never changes, whose strains K are
// |r_x|-free for the green law, and l times those of the engineering one. So its energy is
//   U = l^e V(K - K_0),  V = sum_g w_g (EI_y (K_y - K_0y)^2 + ...)/2,  e = 1 (green), -1 (engineering),
// and it depends on x_A and x_B through l, through c and through K_0, the same element on the rest shape between the
// present marks. Its gradient at fixed nodal coordinates, with the signs turned, is the configurational force.

/// Where an end is at rest: the rest curve and its first three derivatives by arc length, and the y axis of the
/// section. Of an end that does not move the first two of them, and the axis, alone count.
struct FrameRestEnd {
  double x = 0;
  bool moves = false;
  std::array<Vec<double, 3>, 4> curve;
  Vec<double, 3> direction;
};

/// Strains K_0 of the element of length 1 at both points of its table: K_y, K_z, torsion, by x_A and x_B.
using MovingFrameRest = std::array<TwiceActive, 6>;
/// `along` tells how sections stand at rest at ends that move.
MovingFrameRest moving_frame_rest(const FrameTable& unit, const FrameSection& section, const FrameRestEnd& a,
                                  const FrameRestEnd& b, const RestTriads& along);

/// Coordinates: r_A, s_A, phi_A, r_B, s_B, phi_B, x_A, x_B.
using MovingFrameVector = Eigen::Matrix<double, 16, 1>;
using MovingFrameMatrix = Eigen::Matrix<double, 16, 16>;

/// One element as it is: `unit` is a table of length 1, of which it keeps its own with the strains at rest.
class MovingFrame {
 public:
  /// `rest` is null for a beam that is straight at rest. `turned` is the twist to within half a turn [rad].
  MovingFrame(const FrameTable& unit, const FrameSection& section, const FrameNode& a, const FrameNode& b, double x_a,
              double x_b, double turned, const MovingFrameRest* rest);

  double length() const { return l_; }
  /// The twist, and the inner angle [rad].
  std::array<double, 2> angles() const;
  MovingFrameVector gradient() const;
  MovingFrameMatrix tangent() const;
  /// [J], of bending and of torsion.
  std::array<double, 2> energy() const;
  /// At both points of its table, from the rest shape [1/m].
  std::array<FrameStrain<double>, 2> from_rest() const;

 private:
  /// Power of l in the energy.
  int exponent() const { return section_.law == StrainLaw::green ? 1 : -1; }
  double scale() const { return exponent() > 0 ? l_ : 1 / l_; }
  /// dV/dK_0.
  Eigen::Matrix<double, 6, 1> on_rest(const FrameElement<double>& element, double inner) const;

  FrameTable table_;
  const FrameSection& section_;
  const FrameNode &a_, &b_;
  double l_;
  FrameEnds<double> ends_;
  MovingFrameRest rest_{};
};

/// The frame of an element at u, and the tangent there, its ends and its inner angle being these.
TriadReference frame_at(double u, double length, const Weights<double>& weights, const FrameEnds<double>& ends,
                        double twist, double inner);

}  // namespace vlbeam
