#pragma once

namespace vlbeam {

/// How the weights of a merged element are found.
enum class MergePolicy {
  point_fit,  ///< minimum-norm point fit (Ding & Ouyang 2022, Eq. 31-38)
  unit,       ///< unit weights: what ALE-ANCF does
};

}  // namespace vlbeam
