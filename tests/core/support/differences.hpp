#pragma once

#include <Eigen/Core>

namespace vlbeam::test {

/// d/ds of `along(s)` at s = 0: central differences of two widths, extrapolated to order 4.
template <class Function>
Eigen::VectorXd slope_of(const Function& along) {
  auto central = [&](double s) -> Eigen::VectorXd { return (along(s) - along(-s)) / (2 * s); };
  return (4 * central(5e-5) - central(1e-4)) / 3;
}

}  // namespace vlbeam::test
