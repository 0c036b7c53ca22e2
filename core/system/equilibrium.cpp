#include "core/system/equilibrium.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "core/system/static_equations.hpp"

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
constexpr double dominant = 0x1p100;         // times the mass matrix, leaves it alone
constexpr int most_events = 9;               // of length control at one instant
constexpr double longest_slide = 0.25;       // of a joint that is released, over L_std
constexpr double shortest_slide = 1e-6;      // the same
constexpr double small_move = 1e-7;          // of supports, over the beam's length
constexpr double end_distance = 1e-3;        // from an end of the beam at which a joint is too near, over L_std
constexpr int most_slides = 100000;

std::string brief(double value) {
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
Modes modes_at(StaticEquations<D>& equations, const Eigen::VectorXd& u, double factor) {
  Modes modes{equations.directions(u), {}, {}};
  const auto in_free = [&](double by_a, double scale) -> Eigen::MatrixXd {
    const Eigen::MatrixXd matrix =
        modes.directions.transpose() * equations.dense(u, factor, by_a) * modes.directions / scale;
    return (matrix + matrix.transpose()) / 2;
  };
  modes.stiffness = in_free(0, 1);
  modes.mass = in_free(dominant, dominant);
  return modes;
}

/// How the loads move the beam where nothing holds it, or else how it moves where it is held least.
template <int D>
std::string free_direction(const BeamSystem<D>& system, StaticEquations<D>& equations, const Eigen::VectorXd& u,
                           double factor) {
  const Modes modes = modes_at(equations, u, factor);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(modes.stiffness, modes.mass);
  const Eigen::VectorXd sizes = solver.eigenvalues().cwiseAbs();
  Eigen::VectorXd pull;
  equations.residual(u, factor, pull);
  pull.conservativeResize(modes.directions.rows());
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
    for (int c = 0; c < D; ++c) out += (c > 0 ? ", " : "(") + brief(std::abs(v[c]) < 1e-6 ? 0 : v[c]);
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
      : system_(system), equations_(system), options_(options), counters_(counters), length_(system.mesh().length()) {
    equations_.keep_conditions(options.conditions_at_held);
    r_ = zero_ = Eigen::VectorXd::Zero(equations_.size());
  }

  void follow(const std::function<bool(const Equilibrium&)>& on_point) {
    Eigen::VectorXd q = zero_;
    q.head(system_.coordinates()) = system_.initial_state().head(system_.coordinates());
    equations_.choose_conditions(q);
    residual(q, 0);
    const auto& section = system_.model().section;
    // without what is softer than that, the tangent still has no negative pivot
    const double soft = slack * section.stiffness.EA / (section.rhoA * length_ * length_);
    holds_at_start_ = linearize(q, 0, -soft) && equations_.negative_pivots(0) == 0;
    const bool at_rest = r_.norm() <= no_force * section.stiffness.EA;
    if (at_rest && !on_point(point(q, 0))) return;
    const bool grown = options_.arc_length ? follow_arc(q, on_point) : follow_load(q, on_point);
    if (grown && options_.release && system_.has_joint()) release(q, on_point);
  }

 private:
  Eigen::VectorXd state_of(const Eigen::VectorXd& q) const {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(system_.size());
    y.head(system_.coordinates()) = q.head(system_.coordinates());
    return y;
  }

  Equilibrium point(const Eigen::VectorXd& q, double factor) {
    Equilibrium at{factor, state_of(q), 0};
    if (linearize(q, factor)) at.negative_pivots = equations_.negative_pivots(zero_pivot);
    at.multipliers = q.tail(q.size() - system_.coordinates());
    at.joint_held = equations_.holds_joint();
    if (at.joint_held) at.holding_force = holding_force(q, factor);
    return at;
  }

  /// On the joint's material coordinate [N].
  double holding_force(const Eigen::VectorXd& q, double factor) {
    Eigen::VectorXd r;
    equations_.reactions(q, factor, r);
    return r[equations_.mark()];
  }

  /// Of positions over the beam's length, and of slopes: the largest.
  double size(const Eigen::VectorXd& change) const {
    double largest = 0;
    for (int k = 0; k <= system_.mesh().last(); ++k) {
      largest = std::max({largest, position<D>(change.data(), k).norm() / length_, slope<D>(change.data(), k).norm()});
    }
    if (system_.has_joint()) largest = std::max(largest, std::abs(change[equations_.mark()]) / length_);
    if (system_.kinked()) largest = std::max(largest, change.template segment<D>(equations_.mark() + 1).norm());
    return std::isfinite(change.sum()) ? largest : std::numeric_limits<double>::infinity();
  }

  void impose(Eigen::VectorXd& q, double factor) const {
    Eigen::VectorXd y = state_of(q);
    system_.impose(y, factor);
    q.head(system_.coordinates()) = y.head(system_.coordinates());
  }

  void residual(const Eigen::VectorXd& q, double factor) {
    ++counters_.rhs_evaluations;
    equations_.residual(q, factor, r_);
  }

  bool linearize(const Eigen::VectorXd& q, double factor, double by_a = 0) {
    ++counters_.newton.tangents;
    return equations_.linearize(q, factor, by_a);
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
      equations_.solve(r_);
      const double correction = size(r_);
      if (!(correction <= largest_correction)) return false;
      q -= r_;
      if (is_last(correction, previous)) return true;
      previous = correction;
    }
    return false;
  }

  /// Equal steps of the load factor; false where `on_point` ends it.
  bool follow_load(Eigen::VectorXd& q, const std::function<bool(const Equilibrium&)>& on_point) {
    for (int step = 1; step <= options_.steps; ++step) {
      const double from = static_cast<double>(step - 1) / options_.steps,
                   to = static_cast<double>(step) / options_.steps;
      if (!advance(q, from, to, most_halvings, step == 1)) {
        throw ComputationFailed("no equilibrium near the last one at load factor " + brief(to) + ": " +
                                    free_direction(system_, equations_, q, to) +
                                    "; past a limit point \"arc-length\" goes on",
                                from);
      }
      ++counters_.steps;
      if (!on_point(point(q, to))) return false;
    }
    return true;
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
    const Eigen::VectorXd step = next - q;
    if (inner(step, step) <= by_rounding * by_rounding) return true;
    const auto direction = [&](const Eigen::VectorXd& at, double factor) -> Eigen::VectorXd {
      return linearize(at, factor) ? response(at, factor) : zero_;
    };
    const Eigen::VectorXd before = direction(q, from), behind = direction(next, to);
    const Eigen::VectorXd off = step / (to - from) - (before + behind) / 2;
    const double most = largest_turn * (std::sqrt(inner(before, before)) + std::sqrt(inner(behind, behind)));
    return std::sqrt(inner(off, off)) <= most;
  }

  bool stable_at(const Eigen::VectorXd& q, double factor) {
    return linearize(q, factor) && equations_.negative_pivots(zero_pivot) == 0;
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
      if (!linearize(at, factor, mu) || equations_.negative_pivots(zero_pivot) > 0) {
        mu *= 4;
        continue;
      }
      equations_.solve(r_);
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

  /// dq/df with the tangent that is factored: r changes linearly with f, and so do places that supports move.
  Eigen::VectorXd response(const Eigen::VectorXd& q, double factor) {
    residual(q, factor + 1);
    Eigen::VectorXd more = r_;
    residual(q, factor);
    more -= r_;
    if (!system_.model().driven()) {
      equations_.solve(more);
      return -more;
    }
    Eigen::VectorXd moved = q, from = q;
    impose(moved, factor + 1);
    impose(from, factor);
    moved -= from;
    const double size = this->size(moved), h = size > 0 ? small_move / size : 1;
    const Eigen::VectorXd here = r_;
    residual(q + h * moved, factor);
    more += (r_ - here) / h;
    r_ = here;
    equations_.solve(more);
    return moved - more;
  }

  /// False where `on_point` ends it.
  bool follow_arc(Eigen::VectorXd& q, const std::function<bool(const Equilibrium&)>& on_point) {
    double factor = 0;
    if (!newton(q, 0)) {
      throw ComputationFailed("no equilibrium without loads: " + free_direction(system_, equations_, q, 0) +
                                  "; take \"control\": \"load\", which starts from a relaxed state",
                              0);
    }
    Tangent along{zero_, 1};
    double step = 0, most = 0;
    const int points = most_points * options_.steps;
    for (int n = 0; n < points; ++n) {
      if (!linearize(q, factor))
        throw ComputationFailed("the tangent is singular at load factor " + brief(factor), factor);
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
        if (++halvings > 20) throw ComputationFailed("the path ends at load factor " + brief(factor), factor);
      }
      ++counters_.steps;
      if (next_factor >= 1) {  // the last point is at 1
        const double share = (1 - factor) / (next_factor - factor);
        Eigen::VectorXd last = q + share * (next - q);
        if (newton(last, 1)) {
          q = last;
          return on_point(point(last, 1));
        }
      }
      q = next;
      factor = next_factor;
      if (!on_point(point(q, factor))) return false;
      if (iterations <= 4) step = std::min(1.5 * step, most);
      if (iterations > 7) step /= 1.5;
    }
    throw ComputationFailed("the load factor is " + brief(factor) + " after " + std::to_string(points) +
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
      equations_.solve(r_);
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

  /// How the state changes with x of a joint at its equilibria, and what that does to the force that holds it.
  struct Slide {
    Eigen::VectorXd q;     ///< by x
    double stiffness = 0;  ///< of x [N/m]: negative where the energy falls along it
  };

  /// A unit force on a joint that is free moves it by one over its stiffness.
  std::optional<Slide> slide_at(const Eigen::VectorXd& q) {
    equations_.hold_joint(false);
    const bool factored = linearize(q, 1);
    Eigen::VectorXd moved = Eigen::VectorXd::Unit(q.size(), equations_.mark());
    if (factored) equations_.solve(moved);
    equations_.hold_joint(true);
    const double x = moved[equations_.mark()];
    if (!factored || !std::isfinite(moved.sum()) || x == 0) return std::nullopt;
    return Slide{moved / x, 1 / x};
  }

  /// Newton's iteration for all unknowns, x included: whether it leads to a place within `reach` [m].
  bool settle(Eigen::VectorXd& q, double reach) {
    Eigen::VectorXd tried = q;
    equations_.hold_joint(false);
    const Eigen::Index x = equations_.mark();
    if (newton(tried, 1) && std::abs(tried[x] - q[x]) <= reach && until_node(tried[x], 1) > 0 &&
        until_node(tried[x], -1) > 0) {
      q = tried;
      return true;
    }
    equations_.hold_joint(true);
    return false;
  }

  bool next_is_end(int way) const {
    return way > 0 ? system_.places().front().node + 1 == system_.mesh().last() : system_.places().front().node == 1;
  }

  /// How far the joint at x may slide that way until it runs into a node, or out of the beam.
  double until_node(double x, int way) const {
    const auto& model = system_.model();
    const auto j = static_cast<std::size_t>(system_.places().front().node);
    const double ahead = way > 0 ? system_.mesh().x[j + 1] - x : x - system_.mesh().x[j - 1];
    double distance = end_distance * model.length_control.standard_length;
    const bool leaves = next_is_end(way) && (way > 0 ? model.end_releases : model.start_releases);
    if (leaves) distance = std::max(distance, (1 + 1e-9) * model.joints.front().separation_distance);
    return ahead - distance;
  }

  /// The same, or until length control is due.
  double room(double x, int way) const {
    const auto& control = system_.model().length_control;
    if (!control.enabled || next_is_end(way)) return until_node(x, way);
    const auto j = static_cast<std::size_t>(system_.places().front().node);
    const double behind = way > 0 ? x - system_.mesh().x[j - 1] : system_.mesh().x[j + 1] - x;
    return control.trigger_length() * (1 + 1e-12) - behind;
  }

  /// Length control that is due, and the equilibrium on its mesh; false where there is none.
  bool control_length(Eigen::VectorXd& q) {
    for (int events = 0; events < most_events; ++events) {
      Eigen::VectorXd y = state_of(q);
      const Guards guards = system_.guards(y, 1);
      const auto due = std::find_if(guards.begin(), guards.end(), [](const Guard& guard) { return guard.value > 0; });
      if (due == guards.end()) return true;
      system_.handle_event(static_cast<int>(due - guards.begin()), y, 1);
      q.head(system_.coordinates()) = y.head(system_.coordinates());
      if (!newton(q, 1)) return false;
    }
    return true;
  }

  [[noreturn]] void not_released(const Eigen::VectorXd& q, const std::string& why) {
    throw ComputationFailed("the joint that slides is not released: " + why + " at x = " + brief(q[equations_.mark()]) +
                                " m, where holding it takes " + brief(holding_force(q, 1)) + " N",
                            1);
  }

  void release(Eigen::VectorXd& q, const std::function<bool(const Equilibrium&)>& on_point) {
    const double unit = system_.model().length_control.standard_length, longest = longest_slide * unit;
    const double neutral = slack * system_.model().section.stiffness.EA / length_;
    double step = longest;
    int way = 0;
    for (int n = 0; n < most_slides; ++n) {
      const Eigen::Index x = equations_.mark();
      const double force = holding_force(q, 1);
      const auto slide = slide_at(q);
      if (!slide) not_released(q, "the tangent is singular");
      const double newton_step = -force / slide->stiffness;
      // the path may lead up to a largest force, and beyond it down again
      if (way == 0) way = (force < 0) == (slide->stiffness > -neutral) ? 1 : -1;
      if (std::abs(newton_step) <= longest && settle(q, 2 * longest)) {
        if (control_length(q)) {
          ++counters_.steps;
          on_point(point(q, 1));
          return;
        }
        equations_.hold_joint(true);
        not_released(q, "length control leaves no equilibrium");
      }
      const double room = this->room(q[x], way);
      if (room <= shortest_slide * unit) {
        not_released(
            q, next_is_end(way) ? "it comes to the end of the beam" : "without length control it runs into a node");
      }
      step = std::min(1.5 * step, longest);
      Eigen::VectorXd next;
      double size = 0;
      for (;; step /= 2) {
        if (step < shortest_slide * unit) not_released(q, "there is no equilibrium next to the last one");
        size = std::min(step, room);
        next = q + way * size * slide->q;
        if (newton(next, 1)) {
          const double change = holding_force(next, 1) - force, expected = way * size * slide->stiffness;
          const double scale = std::max(std::abs(expected), std::abs(force));
          // beyond the zero of the force
          if (std::abs(change - expected) <= scale && (force + change) * force > 0) break;
        }
        ++counters_.rejected;
      }
      ++counters_.steps;
      q = next;
      if (!control_length(q)) not_released(q, "length control leaves no equilibrium");
      if (!on_point(point(q, 1))) return;
    }
    not_released(q, "it has slid too often");
  }

  BeamSystem<D>& system_;
  StaticEquations<D> equations_;
  const EquilibriumOptions& options_;
  SolverCounters& counters_;
  Eigen::VectorXd zero_, r_;
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
  StaticEquations<D> equations(system);
  equations.hold_joint(at.joint_held);
  Eigen::VectorXd u(system.coordinates() + at.multipliers.size());
  u << at.y.head(system.coordinates()), at.multipliers;
  const Modes modes = modes_at<D>(equations, u, at.factor);
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
