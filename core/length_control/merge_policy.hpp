#pragma once

namespace vlbeam {

/// How the weights of a merged element are found.
enum class MergePolicy {
  point_fit,  ///< minimum-norm point fit (Ding & Ouyang 2022, Eq. 31-38)
  unit,       ///< unit weights: what ALE-ANCF does
};

/// Where the velocities of the new mesh come from.
enum class VelocityTransfer {
  nodal,         ///< nodes keep theirs (the paper)
  projected,     ///< mass-orthogonal projection of the old velocity field: keeps momentum, never adds kinetic energy
  conservative,  ///< that, and its fluctuation scaled so that the total energy is what it was
};

}  // namespace vlbeam
