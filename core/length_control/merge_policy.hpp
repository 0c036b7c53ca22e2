#pragma once

namespace vlbeam {

/// How the shape of a merged element is found.
enum class MergePolicy {
  point_fit,     ///< weights by a minimum-norm point fit (Ding & Ouyang 2022, Eq. 31-38); unit weights for ALE-ANCF
  unit,          ///< unit weights
  rest_arc,      ///< weights of the evenly run arc that turns as much as the element does at rest; of cut ones, too
  least_change,  ///< weights and neighbouring slopes by the least change of curve and strain, strain energy kept
};

/// Where the velocities of the new mesh come from.
enum class VelocityTransfer {
  nodal,         ///< nodes keep theirs (the paper)
  projected,     ///< mass-orthogonal projection of the old velocity field: keeps momentum, never adds kinetic energy
  conservative,  ///< that, and its fluctuation scaled so that the total energy is what it was
};

}  // namespace vlbeam
