#pragma once

#include <Eigen/Core>

namespace vlbeam {

/// A point, slope or force: `D` components of scalar type `Real`.
template <class Real, int D>
using Vec = Eigen::Matrix<Real, D, 1>;

}  // namespace vlbeam
