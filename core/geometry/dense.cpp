#include "core/geometry/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <stdexcept>

#include "core/geometry/rotation.hpp"

namespace vlbeam {

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigenpairs generalized_eigenpairs(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, M);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd generalized_eigenvalues(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(K, M, Eigen::EigenvaluesOnly).eigenvalues();
}

template <int Rows, int Columns>
Eigen::Matrix<double, Columns, 1> least_squares(const Eigen::Matrix<double, Rows, Columns>& A,
                                                const Eigen::Matrix<double, Rows, 1>& b, double threshold) {
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(threshold);
  return svd.solve(b);
}

template Eigen::Vector3d least_squares(const Eigen::Matrix<double, 2, 3>&, const Eigen::Vector2d&, double);
template Eigen::Vector3d least_squares(const Eigen::Matrix3d&, const Eigen::Vector3d&, double);

Eigen::VectorXd solve_pivoting(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return Eigen::FullPivLU<Eigen::MatrixXd>(A).solve(b);
}

Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return Eigen::LDLT<Eigen::MatrixXd>(A).solve(b);
}

Eigen::MatrixXd orthogonal_factor(const Eigen::MatrixXd& A) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(A).householderQ();
}

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

template Eigen::Matrix2d best_rotation<2>(const Eigen::MatrixXd&, const Eigen::MatrixXd&);
template Eigen::Matrix3d best_rotation<3>(const Eigen::MatrixXd&, const Eigen::MatrixXd&);

}  // namespace vlbeam
