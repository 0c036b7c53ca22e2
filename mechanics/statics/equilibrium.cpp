#include "mechanics/statics/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "mechanics/statics/joint_release.hpp"
#include "mechanics/statics/joints_descent.hpp"
#include "mechanics/statics/static_modes.hpp"
#include "mechanics/statics/static_search.hpp"

namespace vlbeam {
namespace {

constexpr int most_halvings = 10;
constexpr double largest_turn = 0.5;    // of a step from the mean of the path's directions at its ends
constexpr double no_force = 1e-12;      // over EA
constexpr int most_points = 50;         // on an arc-length path, over the steps asked for
constexpr double small_move = 1e-7;     // of supports, over the beam's length
constexpr double slender_enough = 1e8;  // EA L^2/EI of a beam that bends without stretching

/// Follows equilibria while the loads grow, then while joints are released.
template <int D>
class Path {
 public:
  Path(BeamSystem<D>& system, const EquilibriumOptions& options, SolverCounters& counters)
      : search_(system, options, counters),
        system_(system),
        equations_(search_.equations),
        options_(options),
        counters_(counters) {}

  void follow(const std::function<bool(const Equilibrium&)>& on_point) {
    Eigen::VectorXd q = search_.zero;
    q.head(system_.coordinates()) = system_.initial_state().head(system_.coordinates());
    equations_.choose_conditions(q);
    if (const auto free = search_.free_joints(); !free.empty()) search_.slider = free.front();
    search_.residual(q, 0);
    // without what is softer than that, the tangent still has no negative pivot
    holds_at_start_ = search_.linearize(q, 0, -search_.soft()) && equations_.negative_pivots(0) == 0;
    const bool at_rest = search_.force_of(search_.r) <= no_force * system_.model().section.stiffness.EA;
    if (at_rest && !on_point(search_.point(q, 0))) return;
    const bool grown = options_.arc_length ? follow_arc(q, on_point) : follow_load(q, on_point);
    if (!grown || !options_.release) return;
    const std::vector<std::size_t> free = search_.free_joints();
    if (free.size() == 1) JointRelease<D>(search_).release(q, on_point);
    if (free.size() > 1) release_together(q, on_point);
  }

 private:
  /// Equal steps of the load factor; false where `on_point` ends it.
  bool follow_load(Eigen::VectorXd& q, const std::function<bool(const Equilibrium&)>& on_point) {
    for (int step = 1; step <= options_.steps; ++step) {
      const double from = static_cast<double>(step - 1) / options_.steps,
                   to = static_cast<double>(step) / options_.steps;
      if (!advance(q, from, to, most_halvings, step == 1) && !snaps(q, to)) {
        throw ComputationFailed("no equilibrium near the last one at load factor " + in_digits(to, 4) + ": " +
                                    free_direction(system_, equations_, q, to) +
                                    (system_.model().driven() ? "" : "; past a limit point \"arc-length\" goes on") +
                                    too_slender(),
                                from);
      }
      ++counters_.steps;
      if (!on_point(search_.point(q, to))) return false;
    }
    return true;
  }

  /// Beyond a limit point of what supports move, where no path by arc-length goes on, a beam snaps to where it is
  /// stable.
  bool snaps(Eigen::VectorXd& q, double to) {
    if (!system_.model().driven() || system_.model().guides() || !search_.relax(q, to)) return false;
    system_.follow(q);
    return true;
  }

  /// Newton's iteration converges from where corrections are smaller than EI/(EA L) only.
  std::string too_slender() const {
    const Stiffness& k = system_.model().section.stiffness;
    const double stiff = k.bends() ? k.EA * search_.length * search_.length / k.EI : 0;
    if (!(stiff > 3 * slender_enough)) return "";
    return "; EA L^2/EI is " + in_digits(stiff, 4) +
           ": with EA = " + in_digits(slender_enough * k.EI / (search_.length * search_.length), 4) +
           " N the beam bends as much, to 1e-7 of its length";
  }

  bool advance(Eigen::VectorXd& q, double from, double to, int halvings, bool first) {
    Eigen::VectorXd tried = q;
    bool found = search_.newton(tried, to) && (first || follows(q, from, tried, to));
    const bool loose = first && !(found && holds_at_start_);
    if ((loose || !found) && search_.hang(q, to)) return true;
    if (loose && search_.relax(q, to)) {
      system_.follow(q);
      return true;
    }
    if (!found) {
      tried = q;
      found = search_.newton_with_forces(tried, to) && follows(q, from, tried, to);
    }
    if (found) {
      q = tried;
      system_.follow(q);
      if (system_.model().guides() && !search_.control_length(q, to)) {
        throw ComputationFailed("length control leaves no equilibrium at load factor " + in_digits(to, 4), from);
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
    if (inner(step, step) <= StaticSearch<D>::by_rounding * StaticSearch<D>::by_rounding) return true;
    const auto direction = [&](const Eigen::VectorXd& at, double factor) -> Eigen::VectorXd {
      return search_.linearize(at, factor) ? response(at, factor) : search_.zero;
    };
    const Eigen::VectorXd before = direction(q, from), behind = direction(next, to);
    const Eigen::VectorXd off = step / (to - from) - (before + behind) / 2;
    const double most = largest_turn * (std::sqrt(inner(before, before)) + std::sqrt(inner(behind, behind)));
    return std::sqrt(inner(off, off)) <= most;
  }

  /// Positions over the beam's length, slopes and angles, each per node, and the load factor: what makes a length of a
  /// path.
  double inner(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
    double sum = 0;
    const int nodes = system_.mesh().last() + 1;
    for (int k = 0; k < nodes; ++k) {
      sum += position<D>(a.data(), k).dot(position<D>(b.data(), k)) / (search_.length * search_.length) +
             slope<D>(a.data(), k).dot(slope<D>(b.data(), k));
    }
    const Eigen::Index angles = system_.angles(), turning = system_.dofs().turning;
    sum += a.segment(angles, turning).dot(b.segment(angles, turning));
    const double unit = system_.model().length_control.standard_length;
    for (const JointPlace& place : system_.places()) {
      if (search_.releasing) sum += a[place.mark] * b[place.mark] / (unit * unit);
    }
    return sum / nodes;
  }

  struct Tangent {
    Eigen::VectorXd q;
    double factor = 0;
  };

  /// dq/df with the tangent that is factored: r changes linearly with f, and so do places that supports move.
  Eigen::VectorXd response(const Eigen::VectorXd& q, double factor) {
    search_.residual(q, factor + 1);
    Eigen::VectorXd more = search_.r;
    search_.residual(q, factor);
    more -= search_.r;
    if (!system_.model().driven()) {
      equations_.solve(more);
      return -more;
    }
    Eigen::VectorXd moved = q, from = q;
    search_.impose(moved, factor + 1);
    search_.impose(from, factor);
    moved -= from;
    const double size = search_.size(moved), h = size > 0 ? small_move / size : 1;
    const Eigen::VectorXd here = search_.r;
    search_.residual(q + h * moved, factor);
    more += (search_.r - here) / h;
    search_.r = here;
    equations_.solve(more);
    return moved - more;
  }

  /// False where `on_point` ends it.
  bool follow_arc(Eigen::VectorXd& q, const std::function<bool(const Equilibrium&)>& on_point) {
    double factor = 0;
    if (!search_.newton(q, 0)) {
      throw ComputationFailed("no equilibrium without loads: " + free_direction(system_, equations_, q, 0) +
                                  "; take \"control\": \"load\", which starts from a relaxed state",
                              0);
    }
    Tangent along{search_.zero, 1};
    double step = 0, most = 0;
    const int points = most_points * options_.steps;
    for (int n = 0; n < points; ++n) {
      if (!search_.linearize(q, factor)) path_ends(q, "the tangent is singular", factor);
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
        if (search_.newton(last, 1)) {
          q = last;
          system_.follow(q);
          if (search_.releasing && !search_.control_length(q, 1))
            path_ends(q, "length control leaves no equilibrium", 1);
          return on_point(search_.point(q, 1));
        }
      }
      q = next;
      factor = next_factor;
      system_.follow(q);
      if (search_.releasing) {
        const std::size_t events = counters_.newton.iterations;
        if (!search_.control_length(q, factor)) path_ends(q, "length control leaves no equilibrium", factor);
        if (counters_.newton.iterations != events) along.q = search_.zero;  // of another mesh
      }
      if (!on_point(search_.point(q, factor))) return false;
      if (iterations <= 4) step = std::min(1.5 * step, most);
      if (iterations > 7) step /= 1.5;
    }
    if (search_.releasing)
      path_ends(q, "they slide on after " + std::to_string(points) + " points of the path", factor);
    throw ComputationFailed("the load factor is " + in_digits(factor, 4) + " after " + std::to_string(points) +
                                " points of the path: it may never be 1",
                            factor);
  }

  [[noreturn]] void path_ends(const Eigen::VectorXd& q, const std::string& why, double factor) {
    if (!search_.releasing) throw ComputationFailed(why + " at load factor " + in_digits(factor, 4), factor);
    std::string places;
    for (const std::size_t i : search_.free_joints()) {
      places += (places.empty() ? "" : ", ") + in_digits(q[equations_.mark(i)], 4);
    }
    const std::vector<std::size_t> free = search_.free_joints();
    const std::size_t most = *std::ranges::max_element(
        free, {}, [this](std::size_t which) { return std::abs(search_.held_by.empty() ? 0 : search_.held_by[which]); });
    const double force = search_.held_by.empty() ? 0 : (1 - factor) * search_.held_by[most];
    const std::string where = why + " where the joints that slide are at x = " + places + " m";
    search_.not_balanced(most, force, where,
                         "the joints that slide are not released together: " + where + " and " +
                             in_digits(1 - factor, 4) + " of the forces that held them are left");
  }

  /// Length of the first step along a path whose direction has this size by the load factor.
  double first_arc(const Tangent& along, double size) const {
    double step = size / options_.steps;
    const double longest = StaticSearch<D>::longest_slide * system_.model().length_control.standard_length;
    for (const std::size_t i : search_.free_joints()) {
      const double slides = std::abs(along.q[equations_.mark(i)]);
      if (search_.releasing && slides > 0) step = std::min(step, longest / slides);
    }
    return step;
  }

  /// Downhill; where that leads nowhere all is as before.
  bool slide_down(Eigen::VectorXd& q) {
    const ChainState<D> held = system_.chain_of(search_.state_of(q), 1);
    const Eigen::VectorXd at = q;
    if (JointsDescent<D>(search_).release(q)) return true;
    system_.take(held);
    q = at;
    search_.zero = Eigen::VectorXd::Zero(q.size());
    return false;
  }

  /// All joints that nothing guides: those of a rope downhill, others along the path that fading forces on them make.
  void release_together(Eigen::VectorXd& q, const std::function<bool(const Equilibrium&)>& on_point) {
    equations_.keep_conditions(true);  // of the slopes, as they are once joints are free
    if (!search_.newton(q, 1) && !search_.newton_with_forces(q, 1)) {
      path_ends(q, "there is no equilibrium with equal stretches at the joints", 0);
    }
    if (!system_.model().section.stiffness.bends() && slide_down(q)) {
      ++counters_.steps;
      on_point(search_.point(q, 1));
      return;
    }
    search_.held_by = search_.holding_forces(q, 1);
    search_.releasing = true;
    equations_.hold_joints(false);
    follow_arc(q, on_point);
  }

  /// Newton's iteration in the plane across the path, from `step` along it.
  bool correct(const Eigen::VectorXd& q, double factor, const Tangent& along, double step, Eigen::VectorXd& next,
               double& next_factor, int& iterations) {
    next = q + step * along.q;
    next_factor = factor + step * along.factor;
    double previous = std::numeric_limits<double>::infinity();
    for (iterations = 1; iterations <= StaticSearch<D>::most_corrections; ++iterations) {
      ++counters_.newton.iterations;
      if (!search_.linearize(next, next_factor)) return false;
      const Eigen::VectorXd by_factor = response(next, next_factor);
      equations_.solve(search_.r);
      const double change = inner(along.q, search_.r) / (along.factor + inner(along.q, by_factor));
      const Eigen::VectorXd correction = change * by_factor - search_.r;
      next += correction;
      next_factor += change;
      const double length = std::max(search_.size(correction), std::abs(change));
      if (!(length <= std::max(4 * step, 1e-3))) return false;
      if (search_.is_last(length, previous)) return !search_.tangled(next);
      previous = length;
    }
    return false;
  }

  StaticSearch<D> search_;
  BeamSystem<D>& system_;
  StaticEquations<D>& equations_;
  const EquilibriumOptions& options_;
  SolverCounters& counters_;
  bool holds_at_start_ = true;
};

}  // namespace

template <int D>
void trace_equilibria(BeamSystem<D>& system, const EquilibriumOptions& options,
                      const std::function<bool(const Equilibrium&)>& on_point, SolverCounters& counters) {
  Path<D>(system, options, counters).follow(on_point);
}

template void trace_equilibria(BeamSystem<2>&, const EquilibriumOptions&,
                               const std::function<bool(const Equilibrium&)>&, SolverCounters&);
template void trace_equilibria(BeamSystem<3>&, const EquilibriumOptions&,
                               const std::function<bool(const Equilibrium&)>&, SolverCounters&);

}  // namespace vlbeam
