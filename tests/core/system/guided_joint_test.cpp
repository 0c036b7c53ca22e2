// Joints whose material coordinate is a function of time: the forms of their equations, and a free motion given back.
#include <gtest/gtest.h>

#include <boost/math/interpolators/quintic_hermite.hpp>

#include "mechanics/motion/system/implicit_beam.hpp"
#include "scene/build.hpp"
#include "tests/core/support/chain_models.hpp"
#include "tests/core/support/differences.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

template <class Dimension>
class GuidedEquations : public ::testing::Test {
 protected:
  static constexpr int dim = Dimension::value;

  /// A damped chain in motion with three joints, of which the first and the last are guided.
  void make(const ChainShape& shape) {
    model_ = model_of<dim>(shape, random_);
    model_.section.damping = 0.01;
    model_.start = Support<dim>::pin();
    chain_ = random_chain<dim>(shape, random_);
    position<dim>(chain_.rate.data(), 0).setZero();
    for (const std::size_t i : {0, 2}) model_.joints[i].x = guide_of(chain_, i, random_.uniform(-3, 3));
    model_.joints[0].law.friction = AxialFriction{0.2, 0.5};
  }

  Random random_{19};
  BeamModel<dim> model_;
  ChainState<dim> chain_;
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(GuidedEquations, Dimensions);

const ChainShape polynomial{.elements = 9, .joint = 2, .more = {{3}, {6}}};
const ChainShape rational{
    .elements = 9, .joint = 2, .rational = true, .transport = WeightTransport::transported, .more = {{3}, {6}}};

TYPED_TEST(GuidedEquations, ExplicitAndImplicitFormsAreTheSame) {
  for (const ChainShape& shape : {polynomial, rational}) {
    for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
      this->make(shape);
      this->model_.constraints = constraints;
      BeamSystem<TestFixture::dim> system(this->model_, this->chain_);
      const double t = 0.01;
      Eigen::VectorXd y = system.initial_state(), dydt(y.size());
      system.impose(y, t);
      system.rhs(y, dydt, t);
      const Eigen::Index n = system.coordinates();
      const JointPlace& place = system.places()[2];
      EXPECT_NEAR(dydt[place.mark], this->model_.joints[2].x(t).rate, 1e-15);
      EXPECT_NEAR(dydt[n + place.mark], this->model_.joints[2].x(t).acceleration, 1e-12);

      auto& implicit = *system.second_order();
      Eigen::VectorXd q, v;
      implicit.expand(y, q, v);
      Eigen::VectorXd a(q.size()), r(q.size());
      implicit.acceleration(q, v, t, a);
      implicit.residual(q, v, a, t, r);
      EXPECT_LE(r.norm(), 1e-10 * (1 + a.norm()));
      const double power = this->model_.balance().of(dydt).supports;
      EXPECT_GT(std::abs(power), 1e-3);
      EXPECT_NEAR(implicit.supplied_power(q, v, a, t).supports, power, 1e-10 * (1 + a.norm()));
    }
  }
}

TYPED_TEST(GuidedEquations, JacobianIsTheDerivativeOfTheRightHandSide) {
  for (const ChainShape& shape : {polynomial, rational}) {
    this->make(shape);
    BeamSystem<TestFixture::dim> system(this->model_, this->chain_);
    const Eigen::VectorXd y = system.initial_state();
    const Eigen::Index size = y.size();
    const double t = 0.01;
    const auto f = [&](const Eigen::VectorXd& at, double time) {
      Eigen::VectorXd dydt(size);
      system.rhs(at, dydt, time);
      return dydt;
    };
    Eigen::MatrixXd dfdy(size, size);
    Eigen::VectorXd dfdt(size);
    system.jacobian(y, t, dfdy, dfdt);
    const Eigen::VectorXd d = Eigen::VectorXd::NullaryExpr(size, [&] { return this->random_.uniform(-0.3, 0.3); });
    const Eigen::VectorXd expected = slope_of([&](double s) { return f(y + s * d, t); });
    EXPECT_LE((dfdy * d - expected).norm(), 1e-6 * expected.norm());
    const Eigen::VectorXd in_time = slope_of([&](double s) { return f(y, t + 1e-3 * s); }) * 1e3;
    EXPECT_LE((dfdt - in_time).norm(), 1e-5 * (1 + in_time.norm()));
  }
}

/// What a free mass does is interpolated with its velocities and accelerations, to the sixth order of 1e-4 s, and given
/// to another one as its way: the beam does the same, and the guide has nothing to do.
TEST(GuidedJoint, GivenTheMotionOfAFreeOneTheBeamDoesAsBefore) {
  SlidingJointSpec mass;
  mass.mass = 0.5;
  mass.position = 0.7;
  mass.velocity = 0.4;
  Scene scene = rope({mass});
  scene.gravity_ramp = 0.05;
  static constexpr double end = 0.06, interval = 1e-4;
  std::vector<double> times, x, rate, acceleration;
  const auto run = [&](const BeamModel<2>& model, bool record) {
    BeamSystem<2> system(model, build_chain<2>(scene));
    Eigen::VectorXd y = system.initial_state(), dydt(y.size());
    double largest = 0, guiding = 0;
    system.on_sample = [&](const Eigen::VectorXd& at, double t) {
      const Eigen::Index mark = system.places()[0].mark;
      if (!record) {
        guiding = std::max(guiding, std::abs(system.forces(at, t).guiding[0]));
        return;
      }
      system.rhs(at, dydt, t);
      times.push_back(t);
      x.push_back(at[mark]);
      rate.push_back(dydt[mark]);
      acceleration.push_back(dydt[system.coordinates() + mark]);
      largest = std::max(largest, std::abs(at[mark] - 0.7));
    };
    IntegrationOptions options;
    options.type = IntegrationMethod::fehlberg78;
    options.tolerances = {1e-12, 1e-12};
    SolverCounters counters;
    double t = 0;
    std::vector<double> samples;
    for (int i = 0; i * interval <= end + interval / 2; ++i) samples.push_back(std::min(i * interval, end));
    integrate(system, y, t, end, samples, options, counters);
    EXPECT_TRUE(!record || largest > 0.02) << "it moves";
    return std::pair{Eigen::VectorXd(y.head(2 * system.coordinates())), guiding};
  };
  BeamModel<2> model = build_model<2>(scene);
  const Eigen::VectorXd free = run(model, true).first;
  using boost::math::interpolators::quintic_hermite;
  const auto spline = std::make_shared<quintic_hermite<std::vector<double>>>(std::move(times), std::move(x),
                                                                             std::move(rate), std::move(acceleration));
  model.joints[0].x = [spline](double t) {
    t = std::clamp(t, 0.0, end);
    return Prescribed{(*spline)(t), spline->prime(t), spline->double_prime(t)};
  };
  const auto [guided, force] = run(model, false);
  EXPECT_LE((guided - free).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LE(force, 1e-5 * 0.5 * 9.81);
}

}  // namespace
}  // namespace vlbeam::test
