#include "mechanics/statics/static_modes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/geometry/dense.hpp"
#include "core/geometry/elementary.hpp"
#include "mechanics/motion/system/room.hpp"
#include "mechanics/statics/equilibrium.hpp"
#include "mechanics/statics/linear_motion.hpp"

namespace vlbeam {
namespace {

constexpr double flutters = 1e-6;     // the lesser part of a motion's rate over its size
constexpr double unheld = 1e-11;      // over the stiffest
constexpr double dominant = 0x1p100;  // times the mass matrix, leaves it alone

/// Stiffness and mass in the directions that supports leave free.
struct Modes {
  Eigen::MatrixXd directions, stiffness, mass;
  Eigen::MatrixXd unsymmetric;  ///< the stiffness as it is: under forces that follow the beam it has no potential
};

template <int D>
Modes modes_at(StaticEquations<D>& equations, const Eigen::VectorXd& u, double factor) {
  Modes modes{equations.directions(u), {}, {}, {}};
  const auto in_free = [&](double by_a, double scale) -> Eigen::MatrixXd {
    return modes.directions.transpose() * equations.dense(u, factor, by_a) * modes.directions / scale;
  };
  modes.unsymmetric = in_free(0, 1);
  modes.stiffness = (modes.unsymmetric + modes.unsymmetric.transpose()) / 2;
  modes.mass = in_free(dominant, dominant);
  modes.mass = ((modes.mass + modes.mass.transpose()) / 2).eval();
  return modes;
}

/// Under forces that follow the beam: they have no potential, and the stiffness is not symmetric.
std::vector<double> frequencies_without_potential(const Modes& modes, int count, double factor) {
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(modes.mass.rows(), modes.mass.cols());
  std::vector<double> found;
  for (const std::complex<double>& rate : eigenvalues({modes.mass, none, modes.unsymmetric})) {
    const double size = portable::abs(rate);
    if (static_cast<int>(found.size()) == count) break;
    if (std::min(std::abs(rate.real()), std::abs(rate.imag())) > flutters * size) {
      throw ComputationFailed("natural frequencies: the beam flutters under a force that follows it", factor);
    }
    if (rate.imag() > flutters * size) found.push_back(size / (2 * std::numbers::pi));
    if (rate.real() > flutters * size) found.push_back(-size / (2 * std::numbers::pi));
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace

template <int D>
std::string free_direction(const BeamSystem<D>& system, StaticEquations<D>& equations, const Eigen::VectorXd& u,
                           double factor) {
  const Modes modes = modes_at(equations, u, factor);
  const Eigenpairs pairs = generalized_eigenpairs(modes.stiffness, modes.mass);
  const Eigen::VectorXd sizes = pairs.values.cwiseAbs();
  Eigen::VectorXd pull;
  equations.residual(u, factor, pull);
  pull.conservativeResize(modes.directions.rows());
  const Eigen::VectorXd shares = pairs.vectors.transpose() * (modes.directions.transpose() * -pull);
  Eigen::Index least = 0;
  sizes.minCoeff(&least);
  Eigen::VectorXd mode = Eigen::VectorXd::Zero(modes.directions.cols());
  for (Eigen::Index i = 0; i < sizes.size(); ++i) {
    if (sizes[i] <= unheld * sizes.maxCoeff()) mode += shares[i] * pairs.vectors.col(i);
  }
  const bool held = mode.norm() <= unheld * shares.norm();
  mode = modes.directions * (held ? pairs.vectors.col(least).eval() : mode);
  const int last = system.mesh().last();
  Vec<double, D> mean = Vec<double, D>::Zero();
  double spread = 0, largest = -1;
  int node = 0;
  for (int k = 0; k <= last; ++k) {
    const Vec<double, D> move = position<D>(mode.data(), k);
    mean += move / (last + 1);
    if (move.norm() > largest) {
      largest = move.norm();
      node = k;
    }
  }
  for (int k = 0; k <= last; ++k) spread = std::max(spread, (position<D>(mode.data(), k) - mean).norm());
  const auto vector = [](const Vec<double, D>& v) {
    std::string out;
    for (int c = 0; c < D; ++c) out += (c > 0 ? ", " : "(") + in_digits(std::abs(v[c]) < 1e-6 ? 0 : v[c], 4);
    return out + ")";
  };
  if (spread < 1e-3 * largest) return "nothing holds it along " + vector(mean.normalized());
  return "it is held least where node " + std::to_string(node) + " moves along " +
         vector(position<D>(mode.data(), node).normalized()) + (largest > 0 ? "" : " and slopes turn");
}

template <int D>
std::vector<double> natural_frequencies(BeamSystem<D>& system, const Equilibrium& at, int count) {
  StaticEquations<D> equations(system);
  equations.hold_joints(at.joint_held);
  Eigen::VectorXd u(system.coordinates() + at.multipliers.size());
  u << at.y.head(system.coordinates()), at.multipliers;
  const Modes modes = modes_at<D>(equations, u, at.factor);
  const bool follow =
      std::ranges::any_of(system.model().loads.points, [](const auto& load) { return bool{load.follower}; });
  const bool rooms = std::ranges::any_of(system.model().rooms, [](const auto& room) { return room->follows(); });
  if (follow || rooms) {
    return frequencies_without_potential(modes, count, at.factor);
  }
  const Eigen::VectorXd squares = generalized_eigenvalues(modes.stiffness, modes.mass);
  std::vector<double> frequencies;
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(count, squares.size()); ++i) {
    frequencies.push_back(std::copysign(std::sqrt(std::abs(squares[i])), squares[i]) / (2 * std::numbers::pi));
  }
  return frequencies;
}

template std::string free_direction(const BeamSystem<2>&, StaticEquations<2>&, const Eigen::VectorXd&, double);
template std::string free_direction(const BeamSystem<3>&, StaticEquations<3>&, const Eigen::VectorXd&, double);
template std::vector<double> natural_frequencies(BeamSystem<2>&, const Equilibrium&, int);
template std::vector<double> natural_frequencies(BeamSystem<3>&, const Equilibrium&, int);

}  // namespace vlbeam
