#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "mechanics/statics/static_search.hpp"

namespace vlbeam {

/// Releases the only joint that nothing guides: moves it along the beam, downhill, until nothing needs to hold it.
template <int D>
class JointRelease {
 public:
  explicit JointRelease(StaticSearch<D>& search)
      : search_(search), system_(search.system), equations_(search.equations), counters_(search.counters) {}

  void release(Eigen::VectorXd& q, const std::function<bool(const Equilibrium&)>& on_point) {
    const double unit = system_.model().length_control.standard_length, longest = StaticSearch<D>::longest_slide * unit;
    const double neutral = StaticSearch<D>::slack * system_.model().section.stiffness.EA / search_.length;
    double step = longest;
    int way = 0, retaken = 0;
    for (int n = 0; n < most_slides; ++n) {
      const double force = search_.holding_force(q, 1);
      const auto slide = slide_at(q);
      if (!slide) not_released(q, "the tangent is singular");
      const double newton_step = -force / slide->stiffness;
      // the path may lead up to a largest force, and beyond it down again
      if (way == 0) way = (force < 0) == (slide->stiffness > -neutral || hangs()) ? 1 : -1;
      if (std::abs(newton_step) <= longest && settle(q, 2 * longest)) {
        if (search_.control_length(q)) {
          ++counters_.steps;
          on_point(search_.point(q, 1));
          return;
        }
        // a stiff rope may be slack where an element was merged: it is taken up again while the joint is held
        equations_.hold_joints(true);
        if (++retaken > most_retaken || !(search_.newton(q, 1) || search_.newton_with_forces(q, 1))) {
          not_released(q, "length control leaves no equilibrium");
        }
        continue;
      }
      const double room = search_.room(search_.slider, q, way);
      if (room <= shortest_slide * unit) {
        not_released(q, search_.next_is_end(search_.slider, way) ? "it comes to the end of the beam"
                                                                 : "without length control it runs into a node");
      }
      step = std::min(1.5 * step, longest);
      Eigen::VectorXd next;
      double size = 0;
      for (;; step /= 2) {
        if (step < shortest_slide * unit) not_released(q, "there is no equilibrium next to the last one");
        size = std::min(step, room);
        next = q + way * size * slide->q;
        if (search_.newton(next, 1) || search_.newton_with_forces(next, 1)) {
          const double change = search_.holding_force(next, 1) - force, expected = way * size * slide->stiffness;
          const double scale = std::max(std::abs(expected), std::abs(force));
          // beyond the zero of the force
          if (std::abs(change - expected) <= scale && (force + change) * force > 0) break;
        }
        ++counters_.rejected;
      }
      ++counters_.steps;
      q = next;
      if (!search_.control_length(q)) not_released(q, "length control leaves no equilibrium");
      if (!on_point(search_.point(q, 1))) return;
    }
    not_released(q, "it has slid too often");
  }

 private:
  static constexpr double shortest_slide = 1e-6;  // of a joint that is released, over L_std
  static constexpr int most_slides = 100000, most_retaken = 10;

  /// How the state changes with x of a joint at its equilibria, and what that does to the force that holds it.
  struct Slide {
    Eigen::VectorXd q;     ///< by x
    double stiffness = 0;  ///< of x [N/m]: negative where the energy falls along it
  };

  /// A unit force on a joint that is free moves it by one over its stiffness. Where that is zero, and not by luck of
  /// rounding next to it, a little inertia stands in for it.
  std::optional<Slide> slide_at(const Eigen::VectorXd& q) {
    equations_.hold_joints(false);
    const bool factored = search_.linearize(q, 1) || search_.linearize(q, 1, search_.soft());
    Eigen::VectorXd moved = Eigen::VectorXd::Unit(q.size(), equations_.mark(search_.slider));
    if (factored) equations_.solve(moved);
    equations_.hold_joints(true);
    const double x = moved[equations_.mark(search_.slider)];
    if (!factored || !std::isfinite(moved.sum()) || x == 0) return std::nullopt;
    return Slide{moved / x, 1 / x};
  }

  /// Newton's iteration for all unknowns, x included: whether it leads to a place within `reach` [m].
  bool settle(Eigen::VectorXd& q, double reach) {
    Eigen::VectorXd tried = q;
    equations_.hold_joints(false);
    const Eigen::Index x = equations_.mark(search_.slider);
    if (search_.newton(tried, 1) && std::abs(tried[x] - q[x]) <= reach &&
        search_.until_node(search_.slider, tried, 1) > 0 && search_.until_node(search_.slider, tried, -1) > 0) {
      q = tried;
      return true;
    }
    equations_.hold_joints(true);
    return false;
  }

  /// Nothing but the ring holds the beam, which then goes down.
  bool hangs() const {
    const auto free = [](const Support<D>& support) { return (support.free_position > 0).all(); };
    return search_.in_ring(search_.slider) && free(system_.model().start) && free(system_.model().end);
  }

  [[noreturn]] void not_released(const Eigen::VectorXd& q, const std::string& why) {
    const double force = search_.holding_force(q, 1);
    const std::string where = why + " at x = " + in_digits(q[equations_.mark(search_.slider)], 4) + " m";
    search_.not_balanced(
        search_.slider, force, where,
        "the joint that slides is not released: " + where + ", where holding it takes " + in_digits(force, 4) + " N");
  }

  StaticSearch<D>& search_;
  BeamSystem<D>& system_;
  StaticEquations<D>& equations_;
  SolverCounters& counters_;
};

}  // namespace vlbeam
