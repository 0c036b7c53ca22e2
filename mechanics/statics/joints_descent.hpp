#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "mechanics/statics/static_search.hpp"

namespace vlbeam {

/// Lets several joints that nothing guides slide downhill together, to where none of them has to be held: by the
/// potential energy as a function of their material coordinates x alone, the rest of the beam in equilibrium. Its
/// gradient is the forces that hold them, its second derivatives the inverse of how x gives way to forces. For ropes: a
/// path on which the holding forces fade in proportion may lead away from the only stable place there is.
template <int D>
class JointsDescent {
 public:
  explicit JointsDescent(StaticSearch<D>& search)
      : search_(search), equations_(search.equations), joints_(search.free_joints()) {}

  /// From an equilibrium of held joints to one where they are free. False where it finds none; joints are then held,
  /// and the mesh may be another one.
  bool release(Eigen::VectorXd& q) {
    const double unit = search_.system.model().length_control.standard_length;
    const double longest = StaticSearch<D>::longest_slide * unit;
    double reach = first_slide * unit;
    for (int n = 0; n < most_slides; ++n) {
      const Eigen::VectorXd slope = gradient(q);
      const Valley valley = valley_at(q);
      if (!valley.known) return false;
      if (valley.convex && valley.down(slope, infinite).cwiseAbs().maxCoeff() <= reach && settle(q, 2 * reach)) {
        if (search_.control_length(q)) return true;
        equations_.hold_joints(true);
        return false;
      }
      Eigen::VectorXd next;
      for (;; reach /= 2) {
        if (reach < shortest_slide * unit) return false;
        const Eigen::VectorXd way = in_room(q, valley.down(slope, reach));
        if (!(way.cwiseAbs().maxCoeff() >= shortest_slide * unit)) return false;
        next = q + valley.moves * way;
        if (!search_.newton(next, 1) && !search_.newton_with_forces(next, 1)) continue;
        if ((gradient(next) - slope - valley.stiffness * way).norm() <= surprise * slope.norm()) break;
      }
      reach = std::min(2 * reach, longest);
      q = next;
      ++search_.counters.steps;
      if (!search_.control_length(q)) return false;
    }
    return false;
  }

 private:
  static constexpr double first_slide = 1e-4, shortest_slide = 1e-12;  // over L_std
  static constexpr double surprise = 0.5;  // of the slope, that the end of a step may differ by from what is expected
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  static constexpr int most_slides = 10000;

  /// The energy about the joints' places, by second order.
  struct Valley {
    bool known = false, convex = false;
    Eigen::MatrixXd moves;      ///< of all unknowns by x
    Eigen::MatrixXd stiffness;  ///< of the slope by x [N/m]
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> curvature;

    /// Newton's step where that leads down, else as far up or down: in each main direction at most `reach` [m]. A taut
    /// rope is stiff in some and slides freely in others, and is to give way in those first.
    Eigen::VectorXd down(const Eigen::VectorXd& slope, double reach) const {
      const Eigen::ArrayXd along = (curvature.eigenvectors().transpose() * slope).array();
      const Eigen::ArrayXd step =
          -along / curvature.eigenvalues().array().abs().max(std::numeric_limits<double>::min());
      return curvature.eigenvectors() * step.max(-reach).min(reach).matrix();
    }
  };

  Eigen::Index count() const { return static_cast<Eigen::Index>(joints_.size()); }

  /// As far of it as there is room.
  Eigen::VectorXd in_room(const Eigen::VectorXd& q, Eigen::VectorXd way) const {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const double step = way[static_cast<Eigen::Index>(i)];
      const double room = std::max(0.0, search_.room(joints_[i], q, step < 0 ? -1 : 1));
      if (std::abs(step) > room) way *= room / std::abs(step);
    }
    return way;
  }

  /// Of the energy by x [N].
  Eigen::VectorXd gradient(const Eigen::VectorXd& q) const {
    const std::vector<double> forces = search_.holding_forces(q, 1);
    Eigen::VectorXd slope(count());
    for (std::size_t i = 0; i < joints_.size(); ++i) slope[static_cast<Eigen::Index>(i)] = forces[joints_[i]];
    return slope;
  }

  Valley valley_at(const Eigen::VectorXd& q) {
    Valley valley;
    equations_.hold_joints(false);
    const bool factored = search_.linearize(q, 1) || search_.linearize(q, 1, search_.soft());
    Eigen::MatrixXd by_force(q.size(), count()), gives(count(), count());
    for (Eigen::Index j = 0; factored && j < count(); ++j) {
      Eigen::VectorXd moved = Eigen::VectorXd::Unit(q.size(), equations_.mark(joints_[static_cast<std::size_t>(j)]));
      equations_.solve(moved);
      by_force.col(j) = moved;
      for (Eigen::Index i = 0; i < count(); ++i) {
        gives(i, j) = moved[equations_.mark(joints_[static_cast<std::size_t>(i)])];
      }
    }
    equations_.hold_joints(true);
    if (!factored || !by_force.allFinite()) return valley;
    const Eigen::FullPivLU<Eigen::MatrixXd> inverse(gives);
    if (!inverse.isInvertible()) return valley;
    valley.stiffness = inverse.inverse();
    valley.moves = by_force * valley.stiffness;
    valley.curvature.compute((valley.stiffness + valley.stiffness.transpose()) / 2);
    valley.convex = valley.curvature.eigenvalues().minCoeff() > 0;
    valley.known = valley.stiffness.allFinite();
    return valley;
  }

  /// Newton's iteration for all unknowns: whether it leads to places within `most` [m].
  bool settle(Eigen::VectorXd& q, double most) {
    Eigen::VectorXd tried = q;
    equations_.hold_joints(false);
    bool found = search_.newton(tried, 1);
    for (const std::size_t i : joints_) {
      const Eigen::Index x = equations_.mark(i);
      found = found && std::abs(tried[x] - q[x]) <= most && search_.until_node(i, tried, 1) > 0 &&
              search_.until_node(i, tried, -1) > 0;
    }
    equations_.hold_joints(!found);
    if (found) q = tried;
    return found;
  }

  StaticSearch<D>& search_;
  StaticEquations<D>& equations_;
  std::vector<std::size_t> joints_;
};

}  // namespace vlbeam
