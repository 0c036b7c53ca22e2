// One stretch of beam between two marks: Lagrange's equations of its energies, all derivatives by automatic
// differentiation.
#pragma once

#include <Eigen/Core>

#include "energy.hpp"
#include "modes.hpp"

namespace judge {

struct Energies {
  double kinetic = 0, axial = 0, bending = 0, gravity = 0;
  double total() const { return kinetic + axial + bending + gravity; }
};

/// What a stretch has in common with its neighbours: r_A, s_A, r_B, s_B (s = dr/dx), a, b.
using Ends = Eigen::Matrix<double, 10, 1>;
using EndsMatrix = Eigen::Matrix<double, 10, 10>;
/// Coefficients of the bubbles, a column a component.
using Bubbles = Eigen::Matrix<double, Eigen::Dynamic, 2>;
using BubblesIn = Eigen::Ref<const Bubbles>;

class Stretch {
 public:
  Stretch(const Section& section, int degree, int points);

  int degree() const { return modes_.degree; }
  int bubbles() const { return modes_.bubbles(); }
  const Section& section() const { return section_; }

  /// Mass matrix and force of the ends, with the bubbles eliminated: mass * (their accelerations) = force.
  void evaluate(const Ends& q, const Ends& rate, const BubblesIn& c, const BubblesIn& c_rate,
                const Eigen::Vector2d& gravity);
  const EndsMatrix& mass() const { return mass_; }
  const Ends& force() const { return force_; }
  /// Accelerations of the bubbles that belong to those of the ends, of what was evaluated last.
  void bubble_accelerations(const Ends& accelerations, Eigen::Ref<Bubbles> out) const;

  Energies energies(const Ends& q, const Ends& rate, const BubblesIn& c, const BubblesIn& c_rate,
                    const Eigen::Vector2d& gravity) const;
  /// Bubbles that bring the stretch nearest to a curve, in the mean square.
  Bubbles fit(const Ends& q, const Eigen::Matrix<double, Eigen::Dynamic, 2>& curve) const;
  const Modes& modes() const { return modes_; }

 private:
  struct Place {  ///< what is known at one point
    double rate[2], drate[2], d[2], dd[2], flow, h, h_rate;
  };
  void differentiate(int g, const Place& at, const Eigen::Vector2d& gravity);
  void load(const Ends& q, const Ends& rate, const BubblesIn& c, const BubblesIn& c_rate);

  Section section_;
  Modes modes_;
  Eigen::Matrix<double, Eigen::Dynamic, 4> all_, at0_, at1_;  // coefficients; columns are r_x, r_y and their rates
  Eigen::Matrix<double, Eigen::Dynamic, 2> at2_;
  Eigen::Matrix<double, Eigen::Dynamic, 6> on0_;  // generalized forces on values, and coupling with a and b
  Eigen::Matrix<double, Eigen::Dynamic, 2> on1_, on2_;
  Eigen::Matrix<double, Eigen::Dynamic, 6> sums_;
  double on_a_ = 0, on_b_ = 0, m_aa_ = 0, m_ab_ = 0, m_bb_ = 0;
  double bubble_mass_ = 0;
  EndsMatrix mass_;
  Ends force_;
};

}  // namespace judge
