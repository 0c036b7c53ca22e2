#pragma once

#include <array>
#include <functional>

namespace vlbeam {

/// How the shape of a merged element is found.
enum class MergeShape {
  point_fit,     ///< weights by a minimum-norm point fit (Ding & Ouyang 2022, Eq. 31-38); unit weights for ALE-ANCF
  unit,          ///< unit weights
  rest_arc,      ///< weights of the evenly run arc that turns as much as the element does at rest; of cut ones, too
  least_change,  ///< weights and neighbouring slopes by the least change of curve and strain, strain energy kept
  own,           ///< weights by a MergeRule
};

/// What a merge starts from: the merged element, but for its weights, and the node it has lost. Lengths in metres,
/// slopes are derivatives by the material coordinate; in the plane the third component is zero.
struct LostNode {
  using Point = std::array<double, 3>;

  double x_a, x_b;           ///< material coordinates of the merged element's ends [m]
  Point r_a, s_a, r_b, s_b;  ///< position [m] and slope [-] there
  double x;                  ///< material coordinate of the lost node [m]
  Point r, s;                ///< its position [m] and slope [-]
};

/// Weights w_0, w_1, w_2 of a merged element, measured against w_3 = 1; all must be positive.
using MergeRule = std::function<std::array<double, 3>(const LostNode&)>;

/// Where the velocities of the new mesh come from.
enum class VelocityTransfer {
  nodal,         ///< nodes keep theirs (the paper)
  projected,     ///< mass-orthogonal projection of the old velocity field: keeps momentum, never adds kinetic energy
  conservative,  ///< that, and its fluctuation scaled so that the total energy is what it was
};

}  // namespace vlbeam
