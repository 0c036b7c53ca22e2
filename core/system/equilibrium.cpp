#include "core/system/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "core/geometry/dense.hpp"
#include "core/geometry/elementary.hpp"
#include "core/system/static_equations.hpp"
#include "core/system/steady_flow.hpp"

namespace vlbeam {
namespace {

constexpr int most_corrections = 30;
constexpr int most_halvings = 10;
constexpr int most_relaxations = 3000;
constexpr double largest_correction = 0.5;   // of the beam's length, and of slopes
constexpr double largest_relaxation = 0.05;  // the same, of one step of a relaxation
constexpr double by_rounding = 1e-7;         // corrections that no longer fall end the iteration from here on
constexpr double zero_pivot = 1e-13;         // over its block's diagonal
constexpr double slack = 1e-10;              // over the axial stiffness: of a beam that holds nothing
constexpr double flutters = 1e-6;            // the lesser part of a motion's rate over its size
constexpr double unheld = 1e-11;             // over the stiffest
constexpr double largest_turn = 0.5;         // of a step from the mean of the path's directions at its ends
constexpr double no_force = 1e-12;           // over EA
constexpr double force_by_rounding = 2e-15;  // over EA
constexpr int most_points = 50;              // on an arc-length path, over the steps asked for
constexpr double dominant = 0x1p100;         // times the mass matrix, leaves it alone
constexpr int most_events = 9;               // of length control at one instant
constexpr double longest_slide = 0.25;       // of a joint that is released, over L_std
constexpr double shortest_slide = 1e-6;      // the same
constexpr double small_move = 1e-7;          // of supports, over the beam's length
constexpr double slender_enough = 1e8;       // EA L^2/EI of a beam that bends without stretching
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

/// How the loads move the beam where nothing holds it, or else how it moves where it is held least.
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
    if (const auto free = free_joints(); !free.empty()) which_ = free.front();
    residual(q, 0);
    // without what is softer than that, the tangent still has no negative pivot
    holds_at_start_ = linearize(q, 0, -soft()) && equations_.negative_pivots(0) == 0;
    const bool at_rest = r_.norm() <= no_force * system_.model().section.stiffness.EA;
    if (at_rest && !on_point(point(q, 0))) return;
    const bool grown = options_.arc_length ? follow_arc(q, on_point) : follow_load(q, on_point);
    if (!grown || !options_.release) return;
    const std::vector<std::size_t> free = free_joints();
    if (free.size() == 1) release(q, on_point);
    if (free.size() > 1) release_together(q, on_point);
  }

 private:
  Eigen::VectorXd state_of(const Eigen::VectorXd& q) const {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(system_.size());
    y.head(system_.coordinates()) = q.head(system_.coordinates());
    return y;
  }

  /// Joints that nothing guides.
  std::vector<std::size_t> free_joints() const {
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < system_.places().size(); ++i) {
      if (!system_.guides(i)) free.push_back(i);
    }
    return free;
  }

  /// While joints are released together, what else is called the load factor is the share of their forces that is gone.
  double load(double factor) const { return releasing_ ? 1 : factor; }

  Equilibrium point(const Eigen::VectorXd& q, double factor) {
    Equilibrium at{load(factor), state_of(q), 0};
    if (linearize(q, factor)) at.negative_pivots = equations_.negative_pivots(zero_pivot);
    at.multipliers = q.tail(q.size() - system_.coordinates());
    at.joint_held = releasing_ ? factor < 1 : equations_.holds_joints();
    at.holding = holding_forces(q, factor);
    for (std::size_t i = 0; i < at.holding.size() && !at.joint_held; ++i) {
      if (!equations_.holds(i)) at.holding[i] = 0;
    }
    if (at.joint_held) at.holding_force = at.holding[which_];
    return at;
  }

  /// On the joints' material coordinates [N].
  std::vector<double> holding_forces(const Eigen::VectorXd& q, double factor) const {
    Eigen::VectorXd r;
    equations_.reactions(q, load(factor), r);
    std::vector<double> forces;
    for (std::size_t i = 0; i < system_.places().size(); ++i) forces.push_back(r[equations_.mark(i)]);
    return forces;
  }
  double holding_force(const Eigen::VectorXd& q, double factor) const { return holding_forces(q, factor)[which_]; }

  /// Of positions over the beam's length, and of slopes: the largest.
  double size(const Eigen::VectorXd& change) const {
    double largest = 0;
    for (int k = 0; k <= system_.mesh().last(); ++k) {
      largest = std::max({largest, position<D>(change.data(), k).norm() / length_, slope<D>(change.data(), k).norm()});
    }
    for (const JointPlace& place : system_.places()) {
      largest = std::max(largest, std::abs(change[place.mark]) / length_);
      if (place.behind >= 0) largest = std::max(largest, change.template segment<D>(place.behind).norm());
    }
    return std::isfinite(change.sum()) ? largest : std::numeric_limits<double>::infinity();
  }

  void impose(Eigen::VectorXd& q, double factor) const {
    Eigen::VectorXd y = state_of(q);
    system_.impose(y, load(factor));
    q.head(system_.coordinates()) = y.head(system_.coordinates());
  }

  void residual(const Eigen::VectorXd& q, double factor) {
    ++counters_.rhs_evaluations;
    equations_.residual(q, load(factor), r_);
    if (!releasing_) return;
    for (const std::size_t i : free_joints()) r_[equations_.mark(i)] -= (1 - factor) * held_by_[i];
  }

  /// What counts as holding nothing, over inertia [1/s^2].
  double soft() const {
    const auto& section = system_.model().section;
    return slack * section.stiffness.EA / (section.rhoA * length_ * length_);
  }

  bool linearize(const Eigen::VectorXd& q, double factor, double by_a = 0) {
    ++counters_.newton.tangents;
    return equations_.linearize(q, load(factor), by_a);
  }

  /// Ends once a correction is as small as wanted, or as rounding lets it be.
  bool is_last(double correction, double previous) const {
    return correction <= options_.tolerance || (correction < by_rounding && correction > previous / 2);
  }

  bool newton(Eigen::VectorXd& q, double factor) {
    impose(q, factor);
    double previous = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_corrections; ++i) {
      ++counters_.newton.iterations;
      residual(q, factor);
      const bool at_rest = r_.norm() <= force_by_rounding * system_.model().section.stiffness.EA;
      if (!linearize(q, factor)) return at_rest && !tangled(q);
      equations_.solve(r_);
      const double correction = size(r_);
      if (at_rest && !(correction <= by_rounding)) return !tangled(q);  // rounding, where nothing holds the beam
      if (!(correction <= largest_correction)) return false;
      q -= r_;
      if (is_last(correction, previous)) return !tangled(q);
      previous = correction;
    }
    return false;
  }

  /// Whether a joint has run through another node, or left the beam.
  bool tangled(const Eigen::VectorXd& q) const {
    const ChainView<D> beam = system_.view(q.data(), q.data());
    for (std::size_t i = 0; i < system_.places().size(); ++i) {
      const JointPlace& place = system_.places()[i];
      if (beam.mark_of(place.node - 1) >= q[place.mark] || q[place.mark] >= beam.mark_of(place.node + 1)) return true;
      if (equations_.holds(i)) continue;
      for (const int way : {-1, 1}) {
        if (next_is_end(i, way) && until_node(i, q, way) <= 0) return true;
      }
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
                                    "; past a limit point \"arc-length\" goes on" + too_slender(),
                                from);
      }
      ++counters_.steps;
      if (!on_point(point(q, to))) return false;
    }
    return true;
  }

  /// Newton's iteration converges from where corrections are smaller than EI/(EA L) only.
  std::string too_slender() const {
    const Stiffness& k = system_.model().section.stiffness;
    const double stiff = k.bends() ? k.EA * length_ * length_ / k.EI : 0;
    if (!(stiff > 3 * slender_enough)) return "";
    return "; EA L^2/EI is " + brief(stiff) + ": with EA = " + brief(slender_enough * k.EI / (length_ * length_)) +
           " N the beam bends as much, to 1e-7 of its length";
  }

  bool advance(Eigen::VectorXd& q, double from, double to, int halvings, bool first) {
    Eigen::VectorXd tried = q;
    const bool found = newton(tried, to) && (first || follows(q, from, tried, to));
    if (first && !(found && holds_at_start_) && relax(q, to)) return true;
    if (found) {
      q = tried;
      if (system_.model().guides() && !control_length(q, to)) {
        throw ComputationFailed("length control leaves no equilibrium at load factor " + brief(to), from);
      }
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
    const double unit = system_.model().length_control.standard_length;
    for (const JointPlace& place : system_.places()) {
      if (releasing_) sum += a[place.mark] * b[place.mark] / (unit * unit);
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
      if (!linearize(q, factor)) path_ends(q, "the tangent is singular", factor);
      const Eigen::VectorXd by_factor = response(q, factor);
      const double norm = std::sqrt(inner(by_factor, by_factor) + 1);
      const double turn = inner(by_factor, along.q) + along.factor < 0 ? -1 : 1;
      along = {turn / norm * by_factor, turn / norm};
      if (n == 0) step = most = first_arc(along, norm);
      Eigen::VectorXd next = q;
      double next_factor = factor;
      int halvings = 0, iterations = 0;
      while (!correct(q, factor, along, step, next, next_factor, iterations)) {
        ++counters_.rejected;
        step /= 2;
        if (++halvings > 20) path_ends(q, "the path ends", factor);
      }
      ++counters_.steps;
      if (next_factor >= 1) {  // the last point is at 1
        const double share = (1 - factor) / (next_factor - factor);
        Eigen::VectorXd last = q + share * (next - q);
        if (newton(last, 1)) {
          q = last;
          if (releasing_ && !control_length(q, 1)) path_ends(q, "length control leaves no equilibrium", 1);
          return on_point(point(q, 1));
        }
      }
      q = next;
      factor = next_factor;
      if (releasing_) {
        const std::size_t events = counters_.newton.iterations;
        if (!control_length(q, factor)) path_ends(q, "length control leaves no equilibrium", factor);
        if (counters_.newton.iterations != events) along.q = zero_;  // of another mesh
      }
      if (!on_point(point(q, factor))) return false;
      if (iterations <= 4) step = std::min(1.5 * step, most);
      if (iterations > 7) step /= 1.5;
    }
    throw ComputationFailed("the load factor is " + brief(factor) + " after " + std::to_string(points) +
                                " points of the path: it may never be 1",
                            factor);
  }

  [[noreturn]] void path_ends(const Eigen::VectorXd& q, const std::string& why, double factor) {
    if (!releasing_) throw ComputationFailed(why + " at load factor " + brief(factor), factor);
    std::string places;
    for (const std::size_t i : free_joints()) {
      places += (places.empty() ? "x = " : ", ") + brief(q[equations_.mark(i)]);
    }
    throw ComputationFailed("the joints that slide are not released together: " + why + " where they are at " + places +
                                " m and " + brief(1 - factor) + " of the forces that held them are left",
                            1);
  }

  /// Length of the first step along a path whose direction has this size by the load factor.
  double first_arc(const Tangent& along, double size) const {
    double step = size / options_.steps;
    const double longest = longest_slide * system_.model().length_control.standard_length;
    for (const std::size_t i : free_joints()) {
      const double slides = std::abs(along.q[equations_.mark(i)]);
      if (releasing_ && slides > 0) step = std::min(step, longest / slides);
    }
    return step;
  }

  /// All joints that nothing guides, along the path that fading forces on them make.
  void release_together(Eigen::VectorXd& q, const std::function<bool(const Equilibrium&)>& on_point) {
    equations_.keep_conditions(true);  // of the slopes, as they are once joints are free
    if (!newton(q, 1)) path_ends(q, "there is no equilibrium with equal stretches at the joints", 0);
    held_by_ = holding_forces(q, 1);
    releasing_ = true;
    equations_.hold_joints(false);
    follow_arc(q, on_point);
  }

  /// Newton's iteration in the plane across the path, from `step` along it.
  bool correct(const Eigen::VectorXd& q, double factor, const Tangent& along, double step, Eigen::VectorXd& next,
               double& next_factor, int& iterations) {
    next = q + step * along.q;
    next_factor = factor + step * along.factor;
    double previous = std::numeric_limits<double>::infinity();
    for (iterations = 1; iterations <= most_corrections; ++iterations) {
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
      if (is_last(length, previous)) return !tangled(next);
      previous = length;
    }
    return false;
  }

  /// How the state changes with x of a joint at its equilibria, and what that does to the force that holds it.
  struct Slide {
    Eigen::VectorXd q;     ///< by x
    double stiffness = 0;  ///< of x [N/m]: negative where the energy falls along it
  };

  /// A unit force on a joint that is free moves it by one over its stiffness. Where that is zero, and not by luck of
  /// rounding next to it, a little inertia stands in for it.
  std::optional<Slide> slide_at(const Eigen::VectorXd& q) {
    equations_.hold_joints(false);
    const bool factored = linearize(q, 1) || linearize(q, 1, soft());
    Eigen::VectorXd moved = Eigen::VectorXd::Unit(q.size(), equations_.mark(which_));
    if (factored) equations_.solve(moved);
    equations_.hold_joints(true);
    const double x = moved[equations_.mark(which_)];
    if (!factored || !std::isfinite(moved.sum()) || x == 0) return std::nullopt;
    return Slide{moved / x, 1 / x};
  }

  /// Newton's iteration for all unknowns, x included: whether it leads to a place within `reach` [m].
  bool settle(Eigen::VectorXd& q, double reach) {
    Eigen::VectorXd tried = q;
    equations_.hold_joints(false);
    const Eigen::Index x = equations_.mark(which_);
    if (newton(tried, 1) && std::abs(tried[x] - q[x]) <= reach && until_node(which_, tried, 1) > 0 &&
        until_node(which_, tried, -1) > 0) {
      q = tried;
      return true;
    }
    equations_.hold_joints(true);
    return false;
  }

  bool next_is_end(std::size_t which, int way) const {
    const int node = system_.places()[which].node;
    return way > 0 ? node + 1 == system_.mesh().last() : node == 1;
  }

  /// How far a joint is from the next node that way [m].
  double reach(std::size_t which, const Eigen::VectorXd& q, int way) const {
    const JointPlace& place = system_.places()[which];
    return way * (system_.view(q.data(), q.data()).mark_of(place.node + way) - q[place.mark]);
  }

  /// How far a joint may slide that way until it runs into a node, or out of the beam.
  double until_node(std::size_t which, const Eigen::VectorXd& q, int way) const {
    const auto& model = system_.model();
    double distance = end_distance * model.length_control.standard_length;
    const bool leaves = next_is_end(which, way) && (way > 0 ? model.end_releases : model.start_releases);
    if (leaves) distance = std::max(distance, (1 + 1e-9) * system_.joint(which).separation_distance);
    return reach(which, q, way) - distance;
  }

  /// The same, or until length control is due.
  double room(const Eigen::VectorXd& q, int way) const {
    const auto& control = system_.model().length_control;
    if (!control.enabled || next_is_end(which_, way)) return until_node(which_, q, way);
    return control.trigger_length() * (1 + 1e-12) - reach(which_, q, -way);
  }

  /// Length control that is due, and the equilibrium on its mesh; false where there is none.
  bool control_length(Eigen::VectorXd& q, double factor = 1) {
    for (int events = 0; events < most_events; ++events) {
      Eigen::VectorXd y = state_of(q);
      const Guards guards = system_.guards(y, load(factor));
      const auto due = std::find_if(guards.begin(), guards.end(), [](const Guard& guard) { return guard.value > 0; });
      if (due == guards.end()) return true;
      system_.handle_event(static_cast<int>(due - guards.begin()), y, load(factor));
      const Eigen::VectorXd multipliers = q.tail(equations_.conditions());
      zero_ = Eigen::VectorXd::Zero(equations_.size());  // there may be another number of nodes
      q = zero_;
      q.head(system_.coordinates()) = y.head(system_.coordinates());
      q.tail(multipliers.size()) = multipliers;
      if (!newton(q, factor)) return false;
    }
    return true;
  }

  [[noreturn]] void not_released(const Eigen::VectorXd& q, const std::string& why) {
    throw ComputationFailed("the joint that slides is not released: " + why +
                                " at x = " + brief(q[equations_.mark(which_)]) + " m, where holding it takes " +
                                brief(holding_force(q, 1)) + " N",
                            1);
  }

  void release(Eigen::VectorXd& q, const std::function<bool(const Equilibrium&)>& on_point) {
    const double unit = system_.model().length_control.standard_length, longest = longest_slide * unit;
    const double neutral = slack * system_.model().section.stiffness.EA / length_;
    double step = longest;
    int way = 0;
    for (int n = 0; n < most_slides; ++n) {
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
        equations_.hold_joints(true);
        not_released(q, "length control leaves no equilibrium");
      }
      const double room = this->room(q, way);
      if (room <= shortest_slide * unit) {
        not_released(q, next_is_end(which_, way) ? "it comes to the end of the beam"
                                                 : "without length control it runs into a node");
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
  std::size_t which_ = 0;        ///< of the joints: the first that nothing guides
  bool releasing_ = false;       ///< several at once
  std::vector<double> held_by_;  ///< what then held the joints at first [N]
};

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
void trace_equilibria(BeamSystem<D>& system, const EquilibriumOptions& options,
                      const std::function<bool(const Equilibrium&)>& on_point, SolverCounters& counters) {
  Path<D>(system, options, counters).follow(on_point);
}

template <int D>
std::vector<double> natural_frequencies(BeamSystem<D>& system, const Equilibrium& at, int count) {
  StaticEquations<D> equations(system);
  equations.hold_joints(at.joint_held);
  Eigen::VectorXd u(system.coordinates() + at.multipliers.size());
  u << at.y.head(system.coordinates()), at.multipliers;
  const Modes modes = modes_at<D>(equations, u, at.factor);
  if (std::ranges::any_of(system.model().loads.points, [](const auto& load) { return bool{load.follower}; })) {
    return frequencies_without_potential(modes, count, at.factor);
  }
  const Eigen::VectorXd squares = generalized_eigenvalues(modes.stiffness, modes.mass);
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
