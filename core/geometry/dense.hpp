#pragma once

#include <Eigen/Core>

namespace vlbeam {

// Decompositions of matrices whose size is known at run time only, small or rare. Each takes the compiler seconds, so
// that they are compiled here alone.

/// Of a symmetric matrix, in ascending order.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& symmetric);

/// K x = lambda M x, both symmetric, M positive definite: lambda in ascending order, and a column x, x.M x = 1, for
/// each.
struct Eigenpairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
Eigenpairs generalized_eigenpairs(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);
Eigen::VectorXd generalized_eigenvalues(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);

/// The least x of those with the least |A x - b|; singular values below `threshold` times the largest count as none.
template <int Rows, int Columns>
Eigen::Matrix<double, Columns, 1> least_squares(const Eigen::Matrix<double, Rows, Columns>& A,
                                                const Eigen::Matrix<double, Rows, 1>& b, double threshold);

/// A^-1 b by full pivoting; of a singular A, some x with A x = b where there is one.
Eigen::VectorXd solve_pivoting(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// A^-1 b of a symmetric, positive semidefinite A.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// The square orthogonal matrix Q of A = Q R: behind as many columns as A has it is orthogonal to them.
Eigen::MatrixXd orthogonal_factor(const Eigen::MatrixXd& A);

}  // namespace vlbeam
