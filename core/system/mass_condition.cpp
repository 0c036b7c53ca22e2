#include "core/system/mass_condition.hpp"

#include <Eigen/Eigenvalues>
#include <limits>

namespace vlbeam {
namespace {

// Of the residual M a - Q an acceleration this large leaves M a alone; a power of two is taken out without rounding.
constexpr double dominant = 0x1p100;

/// Columns: the directions in which the coordinates may move.
template <int D>
Eigen::MatrixXd free_directions(const BeamSystem<D>& system) {
  const Eigen::Index n = system.coordinates();
  Eigen::MatrixXd directions = Eigen::MatrixXd::Identity(n, n);
  Eigen::ArrayXd free = Eigen::ArrayXd::Ones(n);
  const auto hold = [&](Eigen::Index node, const Support<D>& support) {
    for (const Eigen::Index at : {node, node + D}) {
      directions.template block<D, D>(at, at) = support.frame;
      free.template segment<D>(at) = at == node ? support.free_position : support.free_slope;
    }
  };
  hold(0, system.model().start);
  hold(Eigen::Index{node_size<D>} * system.mesh().last(), system.model().end);
  Eigen::Index kept = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (free[k] > 0) directions.col(kept++) = directions.col(k);
  }
  return directions.leftCols(kept);
}

}  // namespace

template <int D>
double mass_condition(BeamSystem<D>& system, const Eigen::VectorXd& y) {
  const Eigen::Index n = system.coordinates();
  const Eigen::MatrixXd directions = free_directions(system);
  const Eigen::VectorXd q = y.head(n), at_rest = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd momenta(n, directions.cols());
  Eigen::VectorXd a(n), r(n);
  for (Eigen::Index k = 0; k < directions.cols(); ++k) {
    a = dominant * directions.col(k);
    system.second_order()->residual(q, at_rest, a, 0, r);
    momenta.col(k) = r / dominant;
  }
  Eigen::MatrixXd mass = directions.transpose() * momenta;
  const Eigen::VectorXd scale = mass.diagonal().cwiseSqrt().cwiseInverse();
  mass = scale.asDiagonal() * mass * scale.asDiagonal();
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(mass, Eigen::EigenvaluesOnly).eigenvalues();
  const double smallest = values[0], largest = values[values.size() - 1];
  return smallest > 0 ? largest / smallest : std::numeric_limits<double>::infinity();
}

template double mass_condition(BeamSystem<2>&, const Eigen::VectorXd&);
template double mass_condition(BeamSystem<3>&, const Eigen::VectorXd&);

}  // namespace vlbeam
