#pragma once

#include <Eigen/LU>
#include <Eigen/SVD>
#include <stdexcept>

namespace vlbeam {

/// The rotation that, with a translation, takes the points `from` nearest to the points `to` in the least-squares sense
/// (Kabsch 1976). One point a column. Throws std::domain_error where a point is not finite.
template <int D>
Eigen::Matrix<double, D, D> best_rotation(const Eigen::MatrixXd& from, const Eigen::MatrixXd& to) {
  const Eigen::MatrixXd a = from.colwise() - from.rowwise().mean(), b = to.colwise() - to.rowwise().mean();
  const Eigen::MatrixXd products = b * a.transpose();
  if (!products.allFinite()) {  // the decomposition would never end
    throw std::domain_error("a shape is not finite: the motion has broken down");
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::VectorXd signs = Eigen::VectorXd::Ones(D);
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) signs[D - 1] = -1;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace vlbeam
