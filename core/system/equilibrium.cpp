#include "core/system/equilibrium.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "core/system/free_directions.hpp"
#include "core/system/implicit_beam.hpp"

namespace vlbeam {
namespace {

constexpr int most_iterations = 30;
constexpr int most_halvings = 10;
constexpr int most_relaxations = 3000;
constexpr double largest_correction = 0.5;   // of the beam's length, and of slopes
constexpr double largest_relaxation = 0.05;  // the same, of one step of a relaxation
constexpr double by_rounding = 1e-7;         // corrections that no longer fall end the iteration from here on
constexpr double zero_pivot = 1e-13;         // over its block's diagonal
constexpr double slack = 1e-10;              // over the axial stiffness: of a beam that holds nothing
constexpr double unheld = 1e-11;             // over the stiffest
constexpr double largest_turn = 0.5;         // of a step from the mean of the path's directions at its ends
constexpr double no_force = 1e-12;           // over EA
constexpr int most_points = 50;              // on an arc-length path, over the steps asked for
constexpr double dominant = 0x1p100;         // of the residual M a - Q an acceleration this large leaves M a alone

std::string text(double value) {
  std::ostringstream stream;
  stream.precision(4);
  stream << value;
  return stream.str();
}

/// Stiffness and mass in the directions that supports leave free.
struct Modes {
  Eigen::MatrixXd directions, stiffness, mass;
};

template <int D>
Modes modes_at(BeamSystem<D>& system, const Eigen::VectorXd& q, double factor) {
  Modes modes{free_directions(system), {}, {}};
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(q.size());
  Eigen::MatrixXd dense;
  const auto in_free = [&](double by_a, double scale) -> Eigen::MatrixXd {
    system.second_order()->tangent(q, rest, rest, factor, 0, by_a, dense);
    const Eigen::MatrixXd matrix = modes.directions.transpose() * dense * modes.directions / scale;
    return (matrix + matrix.transpose()) / 2;
  };
  modes.stiffness = in_free(0, 1);
  modes.mass = in_free(dominant, dominant);
  return modes;
}

/// How the loads move the beam where nothing holds it, or else how it moves where it is held least.
template <int D>
std::string free_direction(BeamSystem<D>& system, const Eigen::VectorXd& q, double factor) {
  const Modes modes = modes_at(system, q, factor);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(modes.stiffness, modes.mass);
  const Eigen::VectorXd sizes = solver.eigenvalues().cwiseAbs(), rest = Eigen::VectorXd::Zero(q.size());
  Eigen::VectorXd pull(q.size());
  system.second_order()->residual(q, rest, rest, factor, pull);
  const Eigen::VectorXd shares = solver.eigenvectors().transpose() * (modes.directions.transpose() * -pull);
  Eigen::Index least = 0;
  sizes.minCoeff(&least);
  Eigen::VectorXd mode = Eigen::VectorXd::Zero(modes.directions.cols());
  for (Eigen::Index i = 0; i < sizes.size(); ++i) {
    if (sizes[i] <= unheld * sizes.maxCoeff()) mode += shares[i] * solver.eigenvectors().col(i);
  }
  const bool held = mode.norm() <= unheld * shares.norm();
  mode = modes.directions * (held ? solver.eigenvectors().col(least).eval() : mode);
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
    for (int c = 0; c < D; ++c) out += (c > 0 ? ", " : "(") + text(std::abs(v[c]) < 1e-6 ? 0 : v[c]);
    return out + ")";
  };
  if (spread < 1e-3 * largest) return "nothing holds it along " + vector(mean.normalized());
  return "it is held least where node " + std::to_string(node) + " moves along " +
         vector(position<D>(mode.data(), node).normalized()) + (largest > 0 ? "" : " and slopes turn");
}

template <int D>
class Path {
 public:
  Path(BeamSystem<D>& system, const EquilibriumOptions& options, SolverCounters& counters)
      : system_(system),
        implicit_(system),
        options_(options),
        counters_(counters),
        rest_(Eigen::VectorXd::Zero(system.coordinates())),
        r_(rest_),
        length_(system.mesh().length()) {}

  void follow(const std::function<bool(const Equilibrium&)>& on_point) {
    Eigen::VectorXd q = system_.initial_state().head(rest_.size());
    residual(q, 0);
    const auto& section = system_.model().section;
    // without what is softer than that, the tangent still has no negative pivot
    const double soft = slack * section.stiffness.EA / (section.rhoA * length_ * length_);
    holds_at_start_ = linearize(q, 0, -soft) && implicit_.negative_pivots(0) == 0;
    const bool at_rest = r_.norm() <= no_force * section.stiffness.EA;
    if (at_rest && !on_point(point(q, 0))) return;
    if (options_.arc_length) {
      follow_arc(q, on_point);
    } else {
      for (int step = 1; step <= options_.steps; ++step) {
        const double from = static_cast<double>(step - 1) / options_.steps,
                     to = static_cast<double>(step) / options_.steps;
        if (!advance(q, from, to, most_halvings, step == 1)) {
          throw ComputationFailed("no equilibrium near the last one at load factor " + text(to) + ": " +
                                      free_direction(system_, q, to) + "; past a limit point \"arc-length\" goes on",
                                  from);
        }
        ++counters_.steps;
        if (!on_point(point(q, to))) return;
      }
    }
  }

 private:
  Equilibrium point(const Eigen::VectorXd& q, double factor) {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(system_.size());
    y.head(q.size()) = q;
    const bool factored = implicit_.linearize(q, rest_, rest_, factor, 0, 0);
    return {factor, y, factored ? implicit_.negative_pivots(zero_pivot) : 0};
  }

  /// Of positions over the beam's length, and of slopes: the largest.
  double size(const Eigen::VectorXd& change) const {
    double largest = 0;
    for (int k = 0; k <= system_.mesh().last(); ++k) {
      largest = std::max({largest, position<D>(change.data(), k).norm() / length_, slope<D>(change.data(), k).norm()});
    }
    return std::isfinite(change.sum()) ? largest : std::numeric_limits<double>::infinity();
  }

  void impose(Eigen::VectorXd& q, double factor) const {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(system_.size());
    y.head(q.size()) = q;
    system_.impose(y, factor);
    q = y.head(q.size());
  }

  void residual(const Eigen::VectorXd& q, double factor) {
    ++counters_.rhs_evaluations;
    implicit_.residual(q, rest_, rest_, factor, r_);
  }

  bool linearize(const Eigen::VectorXd& q, double factor, double by_a = 0) {
    ++counters_.newton.tangents;
    return implicit_.linearize(q, rest_, rest_, factor, 0, by_a);
  }

  /// Ends once a correction is as small as wanted, or as rounding lets it be.
  bool is_last(double correction, double previous) const {
    return correction <= options_.tolerance || (correction < by_rounding && correction > previous / 2);
  }

  bool newton(Eigen::VectorXd& q, double factor) {
    impose(q, factor);
    double previous = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_iterations; ++i) {
      ++counters_.newton.iterations;
      residual(q, factor);
      if (!linearize(q, factor)) return false;
      implicit_.solve(r_);
      const double correction = size(r_);
      if (!(correction <= largest_correction)) return false;
      q -= r_;
      if (is_last(correction, previous)) return true;
      previous = correction;
    }
    return false;
  }

  bool advance(Eigen::VectorXd& q, double from, double to, int halvings, bool first) {
    Eigen::VectorXd tried = q;
    const bool found = newton(tried, to) && (first || follows(q, from, tried, to));
    if (first && !(found && holds_at_start_) && relax(q, to)) return true;
    if (found) {
      q = tried;
      return true;
    }
    ++counters_.rejected;
    if (halvings == 0) return false;
    const double middle = (from + to) / 2;
    return advance(q, from, middle, halvings - 1, first) && advance(q, middle, to, halvings - 1, false);
  }

  /// Whether a step stays on the path: it goes as the path does at its ends on average, rather than across a gap.
  bool follows(const Eigen::VectorXd& q, double from, const Eigen::VectorXd& next, double to) {
    const auto direction = [&](const Eigen::VectorXd& at, double factor) -> Eigen::VectorXd {
      return linearize(at, factor) ? response(at, factor) : rest_;
    };
    const Eigen::VectorXd before = direction(q, from), behind = direction(next, to);
    const Eigen::VectorXd off = (next - q) / (to - from) - (before + behind) / 2;
    const double most = largest_turn * (std::sqrt(inner(before, before)) + std::sqrt(inner(behind, behind)));
    return std::sqrt(inner(off, off)) <= most;
  }

  bool stable_at(const Eigen::VectorXd& q, double factor) {
    return linearize(q, factor) && implicit_.negative_pivots(zero_pivot) == 0;
  }

  /// Down the potential energy, as an overdamped beam would go, until Newton's iteration finds a stable equilibrium.
  bool relax(Eigen::VectorXd& q, double factor) {
    Eigen::VectorXd at = q;
    impose(at, factor);
    const auto& section = system_.model().section;
    double mu = section.stiffness.EA / (section.rhoA * length_ * length_);  // [1/s^2], of the beam's axial waves
    const double largest = 1e12 * mu;
    for (int i = 0; i < most_relaxations && mu < largest; ++i) {
      residual(at, factor);
      if (!linearize(at, factor, mu) || implicit_.negative_pivots(zero_pivot) > 0) {
        mu *= 4;
        continue;
      }
      implicit_.solve(r_);
      const double step = size(r_);
      if (!(step <= 2 * largest_relaxation)) {
        mu *= 4;
        continue;
      }
      at -= r_;
      if (step <= std::numeric_limits<double>::epsilon()) return false;  // on a ridge of the energy
      if (step < largest_relaxation) mu /= 2;
      if (step > 1e-3 * largest_relaxation && i % 20 != 0) continue;
      Eigen::VectorXd tried = at;
      if (newton(tried, factor) && stable_at(tried, factor)) {
        q = tried;
        return true;
      }
    }
    return false;
  }

  /// Positions over the beam's length and slopes, both per node, and the load factor: what makes a length of a path.
  double inner(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
    double sum = 0;
    const int nodes = system_.mesh().last() + 1;
    for (int k = 0; k < nodes; ++k) {
      sum += position<D>(a.data(), k).dot(position<D>(b.data(), k)) / (length_ * length_) +
             slope<D>(a.data(), k).dot(slope<D>(b.data(), k));
    }
    return sum / nodes;
  }

  struct Tangent {
    Eigen::VectorXd q;
    double factor = 0;
  };

  /// dq/df with the tangent that is factored, as r changes linearly with f.
  Eigen::VectorXd response(const Eigen::VectorXd& q, double factor) {
    residual(q, factor + 1);
    Eigen::VectorXd more = r_;
    residual(q, factor);
    more -= r_;
    implicit_.solve(more);
    return -more;
  }

  void follow_arc(Eigen::VectorXd q, const std::function<bool(const Equilibrium&)>& on_point) {
    double factor = 0;
    if (!newton(q, 0)) {
      throw ComputationFailed("no equilibrium without loads: " + free_direction(system_, q, 0) +
                                  "; take \"control\": \"load\", which starts from a relaxed state",
                              0);
    }
    Tangent along{rest_, 1};
    double step = 0, most = 0;
    const int points = most_points * options_.steps;
    for (int n = 0; n < points; ++n) {
      if (!linearize(q, factor))
        throw ComputationFailed("the tangent is singular at load factor " + text(factor), factor);
      const Eigen::VectorXd by_factor = response(q, factor);
      const double norm = std::sqrt(inner(by_factor, by_factor) + 1);
      const double turn = inner(by_factor, along.q) + along.factor < 0 ? -1 : 1;
      along = {turn / norm * by_factor, turn / norm};
      if (n == 0) step = most = norm / options_.steps;
      Eigen::VectorXd next = q;
      double next_factor = factor;
      int halvings = 0, iterations = 0;
      while (!correct(q, factor, along, step, next, next_factor, iterations)) {
        ++counters_.rejected;
        step /= 2;
        if (++halvings > 20) throw ComputationFailed("the path ends at load factor " + text(factor), factor);
      }
      ++counters_.steps;
      if (next_factor >= 1) {  // the last point is at 1
        const double share = (1 - factor) / (next_factor - factor);
        Eigen::VectorXd last = q + share * (next - q);
        if (newton(last, 1)) {
          on_point(point(last, 1));
          return;
        }
      }
      q = next;
      factor = next_factor;
      if (!on_point(point(q, factor))) return;
      if (iterations <= 4) step = std::min(1.5 * step, most);
      if (iterations > 7) step /= 1.5;
    }
    throw ComputationFailed("the load factor is " + text(factor) + " after " + std::to_string(points) +
                                " points of the path: it may never be 1",
                            factor);
  }

  /// Newton's iteration in the plane across the path, from `step` along it.
  bool correct(const Eigen::VectorXd& q, double factor, const Tangent& along, double step, Eigen::VectorXd& next,
               double& next_factor, int& iterations) {
    next = q + step * along.q;
    next_factor = factor + step * along.factor;
    double previous = std::numeric_limits<double>::infinity();
    for (iterations = 1; iterations <= most_iterations; ++iterations) {
      ++counters_.newton.iterations;
      if (!linearize(next, next_factor)) return false;
      const Eigen::VectorXd by_factor = response(next, next_factor);
      implicit_.solve(r_);
      const double change = inner(along.q, r_) / (along.factor + inner(along.q, by_factor));
      const Eigen::VectorXd correction = change * by_factor - r_;
      next += correction;
      next_factor += change;
      const double length = std::max(size(correction), std::abs(change));
      if (!(length <= std::max(4 * step, 1e-3))) return false;
      if (is_last(length, previous)) return true;
      previous = length;
    }
    return false;
  }

  BeamSystem<D>& system_;
  ImplicitBeam<D> implicit_;
  const EquilibriumOptions& options_;
  SolverCounters& counters_;
  Eigen::VectorXd rest_, r_;
  double length_;
  bool holds_at_start_ = true;
};

}  // namespace

template <int D>
void trace_equilibria(BeamSystem<D>& system, const EquilibriumOptions& options,
                      const std::function<bool(const Equilibrium&)>& on_point, SolverCounters& counters) {
  Path<D>(system, options, counters).follow(on_point);
}

template <int D>
std::vector<double> natural_frequencies(BeamSystem<D>& system, const Equilibrium& at, int count) {
  const Modes modes = modes_at<D>(system, at.y.head(system.coordinates()), at.factor);
  const Eigen::VectorXd squares =
      Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(modes.stiffness, modes.mass, Eigen::EigenvaluesOnly)
          .eigenvalues();
  std::vector<double> frequencies;
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(count, squares.size()); ++i) {
    frequencies.push_back(std::copysign(std::sqrt(std::abs(squares[i])), squares[i]) / (2 * std::numbers::pi));
  }
  return frequencies;
}

template void trace_equilibria(BeamSystem<2>&, const EquilibriumOptions&,
                               const std::function<bool(const Equilibrium&)>&, SolverCounters&);
template void trace_equilibria(BeamSystem<3>&, const EquilibriumOptions&,
                               const std::function<bool(const Equilibrium&)>&, SolverCounters&);
template std::vector<double> natural_frequencies(BeamSystem<2>&, const Equilibrium&, int);
template std::vector<double> natural_frequencies(BeamSystem<3>&, const Equilibrium&, int);

}  // namespace vlbeam
