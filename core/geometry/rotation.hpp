#pragma once

#include <Eigen/Core>

namespace vlbeam {

/// The rotation that, with a translation, takes the points `from` nearest to the points `to` in the least-squares sense
/// (Kabsch 1976). One point a column. Throws std::domain_error where a point is not finite.
template <int D>
Eigen::Matrix<double, D, D> best_rotation(const Eigen::MatrixXd& from, const Eigen::MatrixXd& to);

}  // namespace vlbeam
