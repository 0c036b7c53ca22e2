#pragma once

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>

#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

/// M a = F with some accelerations a_s given: the others follow from M a = F - M a_s, and what holds a_s is M a - F.
/// Only the elements at a support or at a joint that is held couple a_s to anything.
template <int D>
class PrescribedMotion {
 public:
  using Vector = Vec<double, D>;
  using JointElements = typename CurrentBeam<D>::JointElements;
  using EndInertia = std::array<FixedInertia, 2>;  ///< of the first and the last element, without joints

  /// Takes the inertia of the given accelerations from the forces. `at_joints` holds the elements at the joints; q and
  /// its rates are as the supports have them.
  PrescribedMotion(const CurrentBeam<D>& beam, const EndInertia& ends, const JointElements& at_joints, const double* q,
                   const double* rate, double* force, double t)
      : beam_(&beam), ends_(&ends) {
    add_supports(at_joints, q, rate, force, t);
    add_joints(at_joints, force, t);
    for (const Side& side : sides_) {
      const auto parts = beam_->vectors_of(force, side.element);
      for (std::size_t k = 0; k < side.driven; ++k) {
        const std::size_t row = side.held + k;
        for (std::size_t i = 0; i < 4; ++i) {
          Eigen::Map<Vector>(parts[i]) -= side.mass[i][row] * side.parts[k].acceleration;
        }
        for (std::size_t j = 0; j < 2; ++j) {
          if (side.marks[j] >= 0) force[side.marks[j]] -= side.by_joint[j][row].dot(side.parts[k].acceleration);
        }
      }
    }
  }

  /// Completes the accelerations `a`.
  void complete(double* a) const {
    for (const Side& side : sides_) {
      if (!side.of_node) continue;
      const auto parts = beam_->vectors_of(a, side.element);
      for (std::size_t k = 0; k < side.driven; ++k) {
        Eigen::Map<Vector>(parts[side.held + k]) += side.parts[k].acceleration;
      }
    }
  }

  /// `force` acts on what is inside an element, with shares `s` of its positions and slopes, and its opposite on these.
  void add_force(int element, const Vector& force, const std::array<double, 4>& s) {
    for (Side& side : sides_) {
      if (side.element != element) continue;
      for (std::size_t k = 0; k < side.driven; ++k) side.parts[k].force -= s[side.held + k] * force;
    }
  }

  /// Power of the supports at the accelerations `a` [W].
  double power(double* a) const {
    double sum = 0;
    for (const Side& side : sides_) {
      const auto parts = beam_->vectors_of(a, side.element);
      for (std::size_t k = 0; k < side.driven; ++k) {
        const std::size_t row = side.held + k;
        Vector reaction = -side.parts[k].force + side.lumped * Eigen::Map<const Vector>(parts[row]);
        for (std::size_t j = 0; j < 2; ++j) {
          if (side.marks[j] >= 0) reaction += side.by_joint[j][row] * a[side.marks[j]];
        }
        for (std::size_t i = 0; i < 4; ++i) reaction += side.mass[row][i] * Eigen::Map<const Vector>(parts[i]);
        sum += reaction.dot(side.parts[k].rate);
      }
    }
    return sum;
  }

 private:
  /// What is given of a nodal vector, and the force on it.
  struct Part {
    Vector force = Vector::Zero(), rate = Vector::Zero(), acceleration = Vector::Zero();
  };
  /// The element on one side of what is held, by its mass matrix (order r_A, s_A, r_B, s_B) and its coupling to the
  /// material coordinates of joints at its ends.
  struct Side {
    int element = 0;
    std::size_t held = 0;                           ///< row of the point that is held
    bool of_node = true;                            ///< the first of its node: what the node has but once is here
    double lumped = 0;                              ///< mass at the node [kg]
    std::array<std::array<double, 4>, 4> mass{};    ///< [kg m^k]
    std::array<std::array<Vector, 4>, 2> by_joint;  ///< of the joint at A, at B
    std::array<Eigen::Index, 2> marks{-1, -1};      ///< where their x stand, if there are any
    std::size_t driven = 1;                         ///< 2 where the slope is driven, too
    std::array<Part, 2> parts;                      ///< position and slope
  };
  static constexpr std::size_t usual = 6;  // sides: two supports and two joints

  void add_supports(const JointElements& at_joints, const double* q, const double* rate, double* force, double t) {
    for (const HeldNode<D>& held : beam_->supports().at(t)) {
      if (held.end < 0) continue;
      const bool start = held.end == 0;
      Side& side = sides_.emplace_back(side_of(start ? 0 : beam_->mesh().elements() - 1, start ? 0 : 2, at_joints));
      const auto parts = beam_->vectors_of(force, side.element);
      side.parts[0] = {Eigen::Map<const Vector>(parts[side.held]), held.driven.rate, held.driven.acceleration};
      if (!held.turns()) continue;
      const Vector s = slope<D>(q, held.node), s_rate = slope<D>(rate, held.node);
      side.parts[1] = {Eigen::Map<const Vector>(parts[side.held + 1]),
                       DrivenPoint<D>::held(held.support, held.driven.slope_rate(s)),
                       DrivenPoint<D>::held(held.support, held.driven.slope_acceleration(s, s_rate))};
      side.driven = 2;
    }
  }

  void add_joints(const JointElements& at_joints, const double* force, double t) {
    for (const HeldNode<D>& held : beam_->supports().at(t)) {
      if (held.joint < 0 || held.motion == nullptr) continue;
      for (const bool before : {true, false}) {
        Side& side = sides_.emplace_back(side_of(before ? held.node - 1 : held.node, before ? 2 : 0, at_joints));
        side.parts[0] = {Vector::Zero(), held.driven.rate, held.driven.acceleration};
        side.of_node = before;
        if (!before) continue;
        side.parts[0].force = position<D>(force, held.node);
        side.lumped = beam_->joint(static_cast<std::size_t>(held.joint)).law.mass;
      }
    }
  }

  Side side_of(int element, std::size_t held, const JointElements& at_joints) const {
    Side result;
    result.element = element;
    result.held = held;
    const auto& parts = beam_->moving_parts();
    const auto moving =
        std::find_if(parts.begin(), parts.end(), [&](const MovingPart& part) { return part.element == element; });
    if (moving != parts.end()) {
      const auto& eq = at_joints[static_cast<std::size_t>(moving - parts.begin())];
      result.mass = eq.mass;
      result.by_joint = {eq.mass_a, eq.mass_b};
      const auto mark = [&](int joint) {
        return joint < 0 ? Eigen::Index{-1} : beam_->places()[static_cast<std::size_t>(joint)].mark;
      };
      result.marks = {mark(moving->a), mark(moving->b)};
    } else {
      result.mass = (*ends_)[held == 0 ? 0 : 1].mass;
      for (auto& row : result.mass) {
        for (double& entry : row) entry *= beam_->model().section.rhoA;
      }
      add_point_masses(beam_->model().masses.points, beam_->mesh(), element, result.mass);
    }
    return result;
  }

  const CurrentBeam<D>* beam_;
  const EndInertia* ends_;
  boost::container::small_vector<Side, usual> sides_;
};

}  // namespace vlbeam
