#include "mechanics/motion/system/mass_condition.hpp"

#include <limits>

#include "core/geometry/dense.hpp"

namespace vlbeam {
namespace {

// Of the residual M a - Q an acceleration this large leaves M a alone; a power of two is taken out without rounding.
constexpr double beyond_forces = 0x1p100;

}  // namespace

template <int D>
double mass_condition(BeamSystem<D>& system, const Eigen::VectorXd& y) {
  const Eigen::Index n = system.coordinates();
  const Eigen::MatrixXd directions = system.supports().directions(n);
  const Eigen::VectorXd q = y.head(n), at_rest = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd momenta(n, directions.cols());
  Eigen::VectorXd a(n), r(n);
  for (Eigen::Index k = 0; k < directions.cols(); ++k) {
    a = beyond_forces * directions.col(k);
    system.second_order()->residual(q, at_rest, a, 0, r);
    momenta.col(k) = r / beyond_forces;
  }
  Eigen::MatrixXd mass = directions.transpose() * momenta;
  const Eigen::VectorXd scale = mass.diagonal().cwiseSqrt().cwiseInverse();
  mass = scale.asDiagonal() * mass * scale.asDiagonal();
  const Eigen::VectorXd values = eigenvalues(mass);
  const double smallest = values[0], largest = values[values.size() - 1];
  return smallest > 0 ? largest / smallest : std::numeric_limits<double>::infinity();
}

template double mass_condition(BeamSystem<2>&, const Eigen::VectorXd&);
template double mass_condition(BeamSystem<3>&, const Eigen::VectorXd&);

}  // namespace vlbeam
