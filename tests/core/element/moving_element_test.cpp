#include "core/element/moving_element.hpp"

#include <gtest/gtest.h>

#include "core/element/fixed_element.hpp"
#include "tests/core/support/element_under_test.hpp"

namespace vlbeam::test {
namespace {

constexpr std::array<double, 4> within{0, 0.3, 0.75, 1};

template <class Dimension>
class MovingElement : public ElementUnderTest<Dimension> {};
TYPED_TEST_SUITE(MovingElement, Dimensions, DimensionNames);

using Kind = ElementKindUnderTest;

TYPED_TEST(MovingElement, PositionAndItsDerivativesAreTheCurves) {
  this->for_each_element(2, [this](const Kind&) {
    for (const double u : within) {
      const auto at = this->point(u);
      const auto exact = this->oracle_.point(this->q_, this->x_at(u));
      EXPECT_LE(relative_difference(at.r, exact[0]), rounding);
      EXPECT_LE(relative_difference(at.r_x, exact[1]), rounding);
      EXPECT_LE(relative_difference(at.r_xx, exact[2]), rounding);
      EXPECT_LE(relative_difference(at.r_xxx, exact[3]), rounding);
    }
  });
}

TYPED_TEST(MovingElement, ShapeMatrixIsTheDerivativeByTheCoordinates) {
  constexpr int D = TypeParam::value;
  this->for_each_element(2, [this](const Kind&) {
    for (const double u : within) {
      const auto at = this->point(u);
      auto derivative = [&](int i) {
        return this->oracle_.point_rate(this->q_, ElementColumn<double, D>::Unit(i), this->x_at(u));
      };
      for (int i = 0; i < 4; ++i) {
        const auto by_node = derivative(i * D);  // by the first component of that nodal vector
        const auto k = static_cast<std::size_t>(i);
        EXPECT_NEAR(at.s[k], by_node[0][0], rounding);
        EXPECT_NEAR(at.s_x[k], by_node[1][0], rounding * (1 + by_node[1].norm()));
        EXPECT_NEAR(at.s_xx[k], by_node[2][0], rounding * (1 + by_node[2].norm()));
      }
      const auto by_a = derivative(4 * D), by_b = derivative(4 * D + 1);
      const Vec<double, D> y_a[3] = {at.y_a, at.y_a_x, at.y_a_xx}, y_b[3] = {at.y_b, at.y_b_x, at.y_b_xx};
      const double scale = at.r.norm() + at.r_x.norm() + at.r_xx.norm() + at.r_xxx.norm();
      for (std::size_t n = 0; n < 3; ++n) {
        EXPECT_LE((y_a[n] - by_a[n]).norm(), rounding * scale) << "x derivative " << n << " at u = " << u;
        EXPECT_LE((y_b[n] - by_b[n]).norm(), rounding * scale) << "x derivative " << n << " at u = " << u;
      }
    }
  });
}

TYPED_TEST(MovingElement, VelocityIsTheRateAtTheMaterialPoint) {
  this->for_each_element(2, [this](const Kind&) {
    for (const double u : within) {
      const auto at = this->point(u);
      const auto exact = this->oracle_.point_rate(this->q_, this->rate_, this->x_at(u));
      EXPECT_LE(relative_difference(at.v, exact[0]), rounding);
      EXPECT_LE(relative_difference(at.v_x, exact[1]), rounding);
      EXPECT_LE(relative_difference(at.v_xx, exact[2]), rounding);
    }
  });
}

TYPED_TEST(MovingElement, RemainderIsTheAccelerationWithoutCoordinateAccelerations) {
  this->for_each_element(2, [this](const Kind&) {
    for (const double u : within) {
      const auto exact = this->oracle_.remainder(this->q_, this->rate_, this->x_at(u));
      EXPECT_LE(relative_difference(this->point(u).remainder, exact), rounding);
    }
  });
}

TYPED_TEST(MovingElement, VariationalEquationsAreLagrangesOfTheDiscreteLagrangian) {
  this->for_each_element(4, [this](const Kind& kind) {
    for (const int count : {3, 5}) {
      this->oracle_.rule = beam_rule(count, kind.axial);
      const auto eq = this->dense_equations(Formulation::variational);
      const auto exact = this->oracle_.variational(this->q_, this->rate_);
      EXPECT_LE(relative_difference(eq.mass, exact.mass), rounding);
      EXPECT_LE(relative_difference(eq.force, exact.force), rounding);
    }
  });
}

TYPED_TEST(MovingElement, VirtualWorkEquationsAreThoseAtFixedMaterialPoints) {
  this->for_each_element(4, [this](const Kind&) {
    const auto eq = this->dense_equations(Formulation::virtual_work);
    const auto exact = this->oracle_.virtual_work(this->q_, this->rate_);
    EXPECT_LE(relative_difference(eq.mass, exact.mass), rounding);
    EXPECT_LE(relative_difference(eq.force, exact.force), rounding);
  });
}

TYPED_TEST(MovingElement, DampingForcesAreTheGradientOfTheDissipationFunction) {
  this->for_each_element(4, [this](const Kind& kind) {
    const double allowed = kind.axial == AxialStrain::lobatto ? 4 * rounding : rounding;  // 2.7e-12 at worst
    for (const double regularization : {0.0, 0.4}) {
      if (TypeParam::value == 2 && regularization != 0) continue;  // the plane has a signed curvature
      for (const Formulation formulation : formulations) {
        const auto elastic = this->dense_equations(formulation);
        this->oracle_.section.damping = 0.6;
        this->oracle_.section.curvature_regularization = regularization;
        const auto damped = this->equations(formulation, this->q_, this->rate_);
        const auto viscous = this->oracle_.viscous_force(this->q_, this->rate_);
        this->oracle_.section.damping = 0;
        EXPECT_LE(relative_difference(dense(damped).force - elastic.force, viscous), allowed);
        EXPECT_GT(damped.dissipation, 0);
        EXPECT_NEAR(damped.dissipation, -viscous.dot(this->rate_), allowed * damped.dissipation);
      }
    }
  });
}

TYPED_TEST(MovingElement, MassIsSymmetricAndSumsToTheTotalMass) {
  this->for_each_element(1, [this](const Kind&) {
    const auto eq = this->equations(Formulation::variational, this->q_, this->rate_);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) EXPECT_EQ(eq.mass[i][j], eq.mass[j][i]);
    }
    const double total = this->oracle_.section.rhoA * this->length();
    EXPECT_NEAR(eq.mass[0][0] + eq.mass[0][2] + eq.mass[2][0] + eq.mass[2][2], total, rounding * total);
  });
}

TYPED_TEST(MovingElement, WithFixedEndsItIsTheFixedElement) {
  constexpr int D = TypeParam::value;
  this->for_each_element(1, [this](const Kind& kind) {
    if (kind.law != StrainLaw::green) return;
    auto& oracle = this->oracle_;
    this->rate_.template tail<2>().setZero();
    oracle.section.damping = 0.6;
    oracle.stored.x_a = this->q_[4 * D];
    oracle.stored.x_b = this->q_[4 * D + 1];
    const auto inertia = fixed_inertia(this->length(), oracle.stored.w, oracle.rule);
    const auto force = fixed_force<double, D>(fixed_basis(this->length(), oracle.stored.w, oracle.rule),
                                              coordinates<double, D>(this->q_).e, coordinates<double, D>(this->rate_).e,
                                              oracle.section);
    const Vec<double, D> expected[4] = {-force.r_b, force.s_a, force.r_b, force.s_b};
    for (const Formulation formulation : formulations) {
      const auto eq = this->equations(formulation, this->q_, this->rate_);
      for (std::size_t i = 0; i < 4; ++i) {
        const Vec<double, D> weight = oracle.section.rhoA * inertia.load[i] * oracle.gravity;
        EXPECT_LE((eq.force[i] - expected[i] - weight).norm(), rounding);
        for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(eq.mass[i][j], oracle.section.rhoA * inertia.mass[i][j], 1e-14);
      }
      EXPECT_NEAR(eq.dissipation, force.dissipation, rounding * force.dissipation);
    }
  });
}

TYPED_TEST(MovingElement, ShiftOfBothMaterialCoordinatesChangesNothing) {
  for (const Formulation formulation : formulations) {
    this->for_each_element(1, [&](const Kind&) {
      const auto eq = this->dense_equations(formulation);
      this->q_.template tail<2>().array() += 2.5;
      this->oracle_.stored.x_a += 2.5;
      this->oracle_.stored.x_b += 2.5;
      const auto shifted = this->dense_equations(formulation);
      EXPECT_LE(relative_difference(shifted.mass, eq.mass), rounding);
      EXPECT_LE(relative_difference(shifted.force, eq.force), rounding);
    });
  }
}

TYPED_TEST(MovingElement, CommonFactorOfTheWeightsChangesNothing) {
  for (const Formulation formulation : formulations) {
    this->for_each_element(1, [&](const Kind&) {
      const auto eq = this->dense_equations(formulation);
      for (double& w : this->oracle_.stored.w) w *= 2.7;
      const auto scaled = this->dense_equations(formulation);
      EXPECT_LE(relative_difference(scaled.mass, eq.mass), rounding);
      EXPECT_LE(relative_difference(scaled.force, eq.force), rounding);
    });
  }
}

TYPED_TEST(MovingElement, ForcesTurnWithTheBody) {
  constexpr int D = TypeParam::value;
  this->for_each_element(1, [this](const Kind&) {
    const Eigen::Matrix<double, D, D> Q = this->random_.template rotation<D>();
    const Vec<double, D> shift = this->random_.template vector<D>();
    auto turned = [&](const ElementColumn<double, D>& a) {
      auto b = a;
      for (int i = 0; i < 4; ++i) b.template segment<D>(i * D) = Q * a.template segment<D>(i * D);
      return b;
    };
    auto moved = turned(this->q_);
    moved.template segment<D>(0) += shift;
    moved.template segment<D>(2 * D) += shift;
    this->oracle_.gravity.setZero();
    for (const Formulation formulation : formulations) {
      const auto eq = this->dense_equations(formulation);
      const auto eq_moved = this->dense_equations(formulation, moved, turned(this->rate_));
      EXPECT_LE(relative_difference(eq_moved.force, turned(eq.force)), rounding);
    }
  });
}

TYPED_TEST(MovingElement, BoostChangesNothingButTheVelocity) {
  constexpr int D = TypeParam::value;
  this->for_each_element(1, [this](const Kind&) {
    const Vec<double, D> boost = this->random_.template vector<D>(10);
    const auto before = this->point(0.3);
    const auto eq = this->dense_equations(Formulation::virtual_work);
    this->rate_.template segment<D>(0) += boost;
    this->rate_.template segment<D>(2 * D) += boost;
    const auto after = this->point(0.3);
    EXPECT_LE((after.v - before.v - boost).norm(), 1e-13 * boost.norm());
    EXPECT_LE((after.v_x - before.v_x).norm(), 1e-13 * boost.norm());
    EXPECT_LE((after.remainder - before.remainder).norm(), rounding * boost.norm());
    EXPECT_LE(relative_difference(this->dense_equations(Formulation::virtual_work).force, eq.force), 1e-11);
  });
}

/// Rates and accelerations of the coordinates while both ends travel along a body at rest: at the rates of x_A and x_B
/// in `mesh_rate`, with accelerations `a` and `b`.
template <int D>
struct Travel {
  ElementColumn<double, D> rate, acceleration;

  Travel(const ElementOracle<D>& body, const ElementColumn<double, D>& q, const ElementColumn<double, D>& mesh_rate,
         double a, double b) {
    rate.template tail<2>() = mesh_rate.template tail<2>();
    acceleration.template tail<2>() << a, b;
    for (int end = 0; end < 2; ++end) {
      const auto r = body.point(q, q[4 * D + end]);
      const double x_rate = rate[4 * D + end], x_acceleration = acceleration[4 * D + end];
      for (int n = 0; n < 2; ++n) {  // position, then slope
        const auto k = static_cast<std::size_t>(n);
        rate.template segment<D>((2 * end + n) * D) = r[k + 1] * x_rate;
        acceleration.template segment<D>((2 * end + n) * D) = r[k + 1] * x_acceleration + r[k + 2] * x_rate * x_rate;
      }
    }
  }
};

TYPED_TEST(MovingElement, NodesTravellingThroughABodyAtRestMakeNoForce) {
  constexpr int D = TypeParam::value;
  this->for_each_element(4, [this](const Kind& kind) {
    const Travel<D> travel(this->oracle_, this->q_, this->rate_, 0.9, -1.4);
    for (const Formulation formulation : formulations) {
      const auto at_rest = this->dense_equations(formulation, this->q_, ElementColumn<double, D>::Zero());
      const auto travelling = this->dense_equations(formulation, this->q_, travel.rate);
      const ElementColumn<double, D> resistance = travelling.mass * travel.acceleration - travelling.force;
      const double force = relative_difference(resistance, -at_rest.force);
      if (kind.rational && kind.transport == WeightTransport::frozen) {
        EXPECT_GT(force, 1e-3) << "frozen unequal weights drag the curve along with the mesh: their known defect";
      } else {
        EXPECT_LE(force, rounding);
      }
    }
  });
}

TYPED_TEST(MovingElement, StraightBeamAtRestIsFreeOfForceAfterAnyRigidMotionAndWhileItsNodesTravel) {
  constexpr int D = TypeParam::value;
  this->for_each_element(4, [this](const Kind& kind) {
    this->oracle_.gravity.setZero();
    // unequal weights hold the unstretched straight line exactly where their cubic W(u) is of second degree
    if (kind.rational) this->oracle_.stored.w = {1, 1.3, 1.2, 0.7};
    const Vec<double, D> tangent = this->random_.template rotation<D>().col(0);
    const Vec<double, D> shift = this->random_.template vector<D>();
    this->q_.template head<4 * D>() << shift, tangent, shift + this->length() * tangent, tangent;
    const Travel<D> travel(this->oracle_, this->q_, this->rate_, 0, 0);
    for (const Formulation formulation : formulations) {
      EXPECT_LE(this->dense_equations(formulation, this->q_, travel.rate).force.norm(), 1e-13);
    }
  });
}

TYPED_TEST(MovingElement, CableIsABeamWithoutBendingStiffness) {
  this->for_each_element(1, [this](const Kind&) {
    this->oracle_.section.stiffness.EI = 0;
    const auto cable = dense(this->equations(Formulation::variational, this->q_, this->rate_, false));
    const auto beam = this->dense_equations(Formulation::variational);
    EXPECT_EQ(cable.mass, beam.mass);
    EXPECT_LE(relative_difference(cable.force, beam.force), 1e-14);
  });
}

}  // namespace
}  // namespace vlbeam::test
