#pragma once

#include "tests/core/support/element_equations.hpp"
#include "tests/core/support/element_family.hpp"
#include "tests/core/support/element_oracle.hpp"

namespace vlbeam::test {

/// Fixture of the element tests: every member of the family in random states, beside its oracle. Stiffness, mass and
/// speeds are of order one, so that no term hides behind another.
template <class Dimension>
class ElementUnderTest : public ::testing::Test {
 protected:
  static constexpr int dim = Dimension::value;
  using Column = ElementColumn<double, dim>;

  /// Runs `check` for every element of the family in `states` random states.
  template <class Check>
  void for_each_element(int states, const Check& check) {
    for (const auto& kind : element_family) {
      SCOPED_TRACE(kind.name());
      for (int k = 0; k < states; ++k) {
        draw(kind);
        check(kind);
      }
    }
  }

  void draw(const ElementKindUnderTest& kind) {
    q_ = random_element<dim>(random_);
    rate_ = random_.vector<element_size<dim>>();
    oracle_ = {};
    oracle_.section = {1.3, {2.1, 0.7, kind.law}, 0, 0};
    oracle_.transport = kind.transport;
    oracle_.rule = beam_rule(5, kind.axial);
    oracle_.gravity = random_.vector<dim>();
    oracle_.stored.w = kind.rational ? random_.weights(3) : unit_weights;
    oracle_.stored.x_a = q_[4 * dim] + random_.uniform(-0.2, 0.05);
    oracle_.stored.x_b = q_[4 * dim + 1] + random_.uniform(-0.05, 0.2);
  }

  double length() const { return q_[4 * dim + 1] - q_[4 * dim]; }
  double x_at(double u) const { return oracle_.material_point(q_, u); }

  MovingEquations<double, dim> equations(Formulation formulation, const Column& q, const Column& rate,
                                         bool bending = true) const {
    BeamSection section = oracle_.section;
    if (!bending) section.stiffness.EI = 0;
    return element_equations<dim>(coordinates<double, dim>(q), coordinates<double, dim>(rate), oracle_.stored,
                                  oracle_.rule, {section, formulation, oracle_.transport, oracle_.gravity});
  }
  DenseEquations<dim> dense_equations(Formulation formulation, const Column& q, const Column& rate) const {
    return dense(equations(formulation, q, rate));
  }
  DenseEquations<dim> dense_equations(Formulation formulation) const { return dense_equations(formulation, q_, rate_); }

  PointMotion<double, dim> point(double u) const {
    const MovingKinematics<double, dim> kinematics(coordinates<double, dim>(q_), coordinates<double, dim>(rate_),
                                                   oracle_.transport, oracle_.stored);
    return kinematics.at(u, rational_shape(kinematics.weights(), u));
  }

  Random random_{2};
  ElementOracle<dim> oracle_;
  Column q_, rate_;
};

}  // namespace vlbeam::test
