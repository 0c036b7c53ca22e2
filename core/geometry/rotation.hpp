#pragma once

#include <Eigen/LU>
#include <Eigen/SVD>

namespace vlbeam {

/// The rotation that, with a translation, takes the points `from` nearest to the points `to` in the least-squares sense
/// (Kabsch 1976). One point a column.
template <int D>
Eigen::Matrix<double, D, D> best_rotation(const Eigen::MatrixXd& from, const Eigen::MatrixXd& to) {
  const Eigen::MatrixXd a = from.colwise() - from.rowwise().mean(), b = to.colwise() - to.rowwise().mean();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(b * a.transpose(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::VectorXd signs = Eigen::VectorXd::Ones(D);
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) signs[D - 1] = -1;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace vlbeam
