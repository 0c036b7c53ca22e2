#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace vlbeam {

/// A small motion about an equilibrium or a steady flow, M x'' + C x' + K x = 0, of the free coordinates. C is
/// gyroscopic where matter flows without damping.
struct LinearMotion {
  Eigen::MatrixXd M, C, K;
};

/// Eigenvalues lambda of lambda^2 M + lambda C + K [1/s], those of least modulus first and to the highest accuracy.
/// Throws ComputationFailed where K is singular.
std::vector<std::complex<double>> eigenvalues(const LinearMotion& motion);
/// Frequencies [Hz], increasing: Im(lambda)/(2 pi) of the eigenvalues that oscillate.
std::vector<double> frequencies(const std::vector<std::complex<double>>& eigenvalues);
/// The largest real part [1/s]: positive where the motion diverges or flutters.
double growth_rate(const std::vector<std::complex<double>>& eigenvalues);

}  // namespace vlbeam
