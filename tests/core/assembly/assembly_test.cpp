// Several beams and bodies: against rigid-body equations of motion written down here, and against one beam that is
// whole.
#include "mechanics/assembly/assembly.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "mechanics/assembly/assembly_equations.hpp"

namespace vlbeam::test {
namespace {

constexpr double g = 9.81;

/// Classical Runge-Kutta steps of y' = f(y).
template <std::size_t N, class F>
std::array<double, N> integrated(std::array<double, N> y, double until, int steps, const F& f) {
  const double h = until / steps;
  const auto moved = [](const std::array<double, N>& at, double by, const std::array<double, N>& rate) {
    std::array<double, N> sum = at;
    for (std::size_t i = 0; i < N; ++i) sum[i] += by * rate[i];
    return sum;
  };
  for (int i = 0; i < steps; ++i) {
    const auto a = f(y), b = f(moved(y, h / 2, a)), c = f(moved(y, h / 2, b)), d = f(moved(y, h, c));
    for (std::size_t k = 0; k < N; ++k) y[k] += h / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
  }
  return y;
}

template <int D>
Eigen::VectorXd run(AssemblySystem<D>& system, double until, double step, double rho = 1) {
  Eigen::VectorXd y = system.initial_state();
  IntegrationOptions options;
  system.corrects = step == 0;  // by an explicit method
  options.type = step == 0 ? IntegrationMethod::dopri5 : IntegrationMethod::generalized_alpha;
  options.tolerances.rtol = options.tolerances.atol = 1e-11;
  options.generalized_alpha.step = step;
  options.generalized_alpha.rho_inf = rho;
  options.generalized_alpha.newton_tolerance = 1e-10;
  SolverCounters counters;
  double t = 0;
  EXPECT_TRUE(integrate(system, y, t, until, {}, options, counters));
  return y;
}

template <int D>
LinkEnd<D> of_body(std::size_t member, const Vec<double, D>& place) {
  return {LinkEnd<D>::Of::body, member, false, 0, place};
}
template <int D>
LinkEnd<D> of_ground(const Vec<double, D>& place) {
  return {LinkEnd<D>::Of::ground, LinkEnd<D>::no_member, false, 0, place};
}

/// Bodies alone, with their links.
template <int D>
struct Bodies {
  std::vector<std::unique_ptr<BodySystem<D>>> bodies;
  std::unique_ptr<AssemblySystem<D>> system;

  Bodies(const std::vector<BodyModel<D>>& models, const std::vector<Link<D>>& links) {
    typename AssemblySystem<D>::Members members;
    for (const auto& model : models) {
      bodies.push_back(std::make_unique<BodySystem<D>>(model));
      members.push_back(std::make_unique<BodyMember<D>>(*bodies.back()));
    }
    system = std::make_unique<AssemblySystem<D>>(std::move(members), links);
    system->settle();
  }
};

/// Two rods, the first pinned to the ground, at angles p and q from hanging: Lagrange's equations.
struct DoublePendulum {
  double m1 = 1.3, l1 = 0.8, j1 = 0.09, m2 = 0.7, l2 = 1.1, j2 = 0.11;

  std::array<double, 4> operator()(const std::array<double, 4>& y) const {
    const auto [p, q, p1, q1] = y;
    const double a = j1 + m1 * l1 * l1 / 4 + m2 * l1 * l1, b = m2 * l1 * l2 / 2, c = j2 + m2 * l2 * l2 / 4;
    const double co = std::cos(p - q), si = std::sin(p - q);
    const double f = -b * si * q1 * q1 - (m1 / 2 + m2) * g * l1 * std::sin(p);
    const double h = b * si * p1 * p1 - m2 * g * l2 / 2 * std::sin(q);
    const double det = a * c - b * b * co * co;
    return {p1, q1, (c * f - b * co * h) / det, (a * h - b * co * f) / det};
  }
};

/// The frame in which the pendulum swings: columns are its downward direction, and the way in which angles grow.
template <int D>
Eigen::Matrix<double, D, 2> swinging_plane() {
  Eigen::Matrix<double, D, 2> plane;
  if constexpr (D == 2) {
    plane << 0, 1, -1, 0;
  } else {
    plane << 0, 0.6, 0, 0.8, -1, 0;
  }
  return plane;
}

template <int D>
double angle_off(double step) {
  const DoublePendulum law;
  const std::array<double, 4> start{0.9, -0.4, 0.3, -1.2};
  const auto plane = swinging_plane<D>();
  const Vec<double, D> down = plane.col(0), side = plane.col(1);
  Vec<double, 3> normal = Vec<double, 3>::UnitZ();
  if constexpr (D == 3) normal = down.cross(side);
  const auto along = [&](double angle) -> Vec<double, D> { return std::cos(angle) * down + std::sin(angle) * side; };
  const auto across = [&](double angle) -> Vec<double, D> { return std::cos(angle) * side - std::sin(angle) * down; };
  const auto body = [&](double m, double j, double angle, double rate) {
    BodyModel<D> model;
    model.mass = m;
    model.inertia = D == 2 ? Vec<double, 3>(0, 0, j) : Vec<double, 3>(0.02, j, j);
    model.axes.col(0) = along(angle);
    model.axes.col(1) = across(angle);
    if constexpr (D == 3) model.axes.col(2) = normal;
    model.spin = rate * normal;
    model.gravity = g * down;
    return model;
  };
  const double p = start[0], q = start[1];
  BodyModel<D> first = body(law.m1, law.j1, p, start[2]), second = body(law.m2, law.j2, q, start[3]);
  first.center = law.l1 / 2 * along(p);
  first.velocity = law.l1 / 2 * start[2] * across(p);
  second.center = law.l1 * along(p) + law.l2 / 2 * along(q);
  second.velocity = law.l1 * start[2] * across(p) + law.l2 / 2 * start[3] * across(q);
  const Vec<double, D> x = Vec<double, D>::Unit(0);
  Bodies<D> pendulum({first, second},
                     {pin_link<D>("top", of_ground<D>(Vec<double, D>::Zero()), of_body<D>(0, -law.l1 / 2 * x)),
                      pin_link<D>("knee", of_body<D>(0, law.l1 / 2 * x), of_body<D>(1, -law.l2 / 2 * x))});
  const double until = 1.5;
  const Eigen::VectorXd y = run(*pendulum.system, until, step);
  const auto right = integrated(start, until, 20000, law);
  double off = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec<double, D> axis = pendulum.bodies[i]->axes(pendulum.system->state_of(y, i).data()).col(0);
    off = std::max(off, (axis - along(right[i])).norm());
  }
  return off;
}

TEST(Assembly, DoublePendulumOfBodiesFollowsLagrange) {
  const double coarse = angle_off<2>(2e-3), fine = angle_off<2>(1e-3);
  EXPECT_LT(fine, 2e-5);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1) << "the order of the method";
}

TEST(Assembly, InATiltedPlaneInSpaceItIsTheSame) { EXPECT_NEAR(angle_off<3>(1e-3), angle_off<2>(1e-3), 1e-7); }

TEST(Assembly, ExplicitMethodsHoldLinksToo) {
  EXPECT_LT(angle_off<2>(0), 1e-9);
  EXPECT_LT(angle_off<3>(0), 1e-9);
}

TEST(Assembly, ABodyThatNothingHoldsTumblesAsEulerSays) {
  const Vec<double, 3> inertia(0.6, 1.0, 1.3), spin(0.4, 3, 0.2);  // about the unstable axis
  BodyModel<3> model;
  model.mass = 2;
  model.inertia = inertia;
  model.spin = spin;
  model.velocity = {1, -2, 0.5};
  Bodies<3> alone({model}, {});
  const double until = 2;
  // angular velocity in body axes, then the three axes
  std::array<double, 12> start{spin[0], spin[1], spin[2], 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const auto right = integrated(start, until, 20000, [&](const std::array<double, 12>& at) {
    const Vec<double, 3> w(at[0], at[1], at[2]);
    const Vec<double, 3> rate = (inertia.cwiseProduct(w).cross(w)).cwiseQuotient(inertia);
    const Eigen::Matrix3d axes = Eigen::Map<const Eigen::Matrix3d>(at.data() + 3);
    const Vec<double, 3> in_space = axes * w;
    std::array<double, 12> rates{rate[0], rate[1], rate[2]};
    for (int i = 0; i < 3; ++i) {
      Eigen::Map<Vec<double, 3>>(rates.data() + 3 + 3 * i) = in_space.cross(Vec<double, 3>(axes.col(i)));
    }
    return rates;
  });
  const auto off = [&](double step) {
    const Eigen::VectorXd y = run(*alone.system, until, step);
    const Eigen::Matrix3d axes = alone.bodies[0]->axes(alone.system->state_of(y, 0).data());
    EXPECT_LT((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_LT((y.head<3>() - until * model.velocity).norm(), 1e-10);
    return (axes - Eigen::Map<const Eigen::Matrix3d>(right.data() + 3)).norm();
  };
  const double coarse = off(1e-3), fine = off(5e-4);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1) << "the order of the method";
  EXPECT_LT(off(0), 1e-9) << "an explicit method";
}

/// A beam along x, free or with the ends held as given, of `elements`, from `from` to `to`.
BeamModel<2> elastic_model() {
  BeamModel<2> model;
  model.section = {1.3, {2000, 0.7}, 0, 0};
  model.gravity = {0, -g};
  model.length_control.standard_length = 0.25;
  return model;
}
ChainState<2> straight(double from, double to, int elements, double end_speed) {
  ChainState<2> chain;
  const double l = (to - from) / elements;
  for (int k = 0; k <= elements; ++k) {
    const double x = l * k;
    chain.mesh.x.push_back(x);
    if (k > 0) chain.mesh.weights.push_back({unit_weights, x - l, x});
    chain.q.insert(chain.q.end(), {from + x, 0, 1, 0});
    chain.rate.insert(chain.rate.end(), {0, end_speed * (from + x) * (from + x), 0, 2 * end_speed * (from + x)});
  }
  return chain;
}
struct Beams {
  std::vector<std::shared_ptr<LinkForces<2>>> forces;
  std::vector<std::unique_ptr<BeamSystem<2>>> beams;
  std::vector<std::unique_ptr<BodySystem<2>>> bodies;
  std::unique_ptr<AssemblySystem<2>> system;

  void add(BeamModel<2> model, const ChainState<2>& chain) {
    forces.push_back(std::make_shared<LinkForces<2>>());
    model.parts.push_back(std::make_shared<ActingLinks<2>>(forces.back()));
    beams.push_back(std::make_unique<BeamSystem<2>>(model, chain));
  }
  void join(const std::vector<Link<2>>& links) {
    AssemblySystem<2>::Members members;
    for (std::size_t i = 0; i < beams.size(); ++i) {
      members.push_back(std::make_unique<BeamMember<2>>(*beams[i], forces[i]));
    }
    for (const auto& body : bodies) members.push_back(std::make_unique<BodyMember<2>>(*body));
    system = std::make_unique<AssemblySystem<2>>(std::move(members), links);
    system->settle();
  }
  Vec<double, 2> end_of(const Eigen::VectorXd& y, std::size_t beam) const {
    return position<2>(system->state_of(y, beam).data(), beams[beam]->mesh().last());
  }
};
LinkEnd<2> at_end(std::size_t member, bool direction = false) { return {LinkEnd<2>::Of::beam_end, member, direction}; }
LinkEnd<2> at_start(std::size_t member, bool direction = false) {
  return {LinkEnd<2>::Of::beam_start, member, direction};
}
Link<2> clamp_of_beams(std::size_t a, std::size_t b) {
  Link<2> link = pin_link<2>("clamp", at_end(a), at_start(b));
  link.ends.push_back(at_end(a, true));
  link.ends.push_back(at_start(b, true));
  Eigen::Matrix2d quarter;
  quarter << 0, -1, 1, 0;
  keep_across<2>(link, 2, 3, quarter);
  return link;
}

TEST(Assembly, TwoBeamsClampedEndToEndAreOneBeam) {
  const double until = 0.4, step = 1e-3;
  Beams whole;
  BeamModel<2> model = elastic_model();
  model.start = Support<2>::clamp();
  whole.add(model, straight(0, 1, 8, 0.7));
  whole.join({});
  Beams parts;
  parts.add(model, straight(0, 0.5, 4, 0.7));
  model.start = {};
  parts.add(model, straight(0.5, 1, 4, 0.7));
  // a whole beam has one stretch at a node, too
  Link<2> clamp = pin_link<2>("clamp", at_end(0), at_start(1));
  clamp.ends.push_back(at_end(0, true));
  clamp.ends.push_back(at_start(1, true));
  keep_equal<2>(clamp, 2, 3);
  parts.join({clamp});
  const Eigen::VectorXd y = run(*whole.system, until, step), z = run(*parts.system, until, step);
  EXPECT_LT((whole.end_of(y, 0) - parts.end_of(z, 1)).norm(), 1e-9);
  // with the stretch free to jump, as links have it, the mesh tells
  Beams linked;
  linked.add(model, straight(0.5, 1, 4, 0.7));
  model.start = Support<2>::clamp();
  linked.add(model, straight(0, 0.5, 4, 0.7));
  linked.join({clamp_of_beams(1, 0)});
  const Eigen::VectorXd w = run(*linked.system, until, step);
  EXPECT_LT((whole.end_of(y, 0) - linked.end_of(w, 0)).norm(), 1e-4);
  EXPECT_LT(linked.system->observe(w, until, own_points).energy.total() -
                linked.system->observe(linked.system->initial_state(), 0, own_points).energy.total(),
            1e-3);
}

TEST(Assembly, AFreeAssemblyKeepsItsMomenta) {
  Beams free;
  BeamModel<2> model = elastic_model();
  model.gravity.setZero();
  free.add(model, straight(0, 1, 4, 0.7));
  ChainState<2> second = straight(1, 1.6, 3, 0);
  for (std::size_t i = 1; i < second.rate.size(); i += 4) second.rate[i] = 0.7;
  free.add(model, second);
  BodyModel<2> body;
  body.mass = 0.4;
  body.inertia = {0, 0, 0.02};
  body.center = {1.6, -0.2};
  body.velocity = {0, 0.7};
  free.bodies.push_back(std::make_unique<BodySystem<2>>(body));
  Link<2> bungee{"bungee", {at_start(0), of_body<2>(2, {0, -0.1})}, {}, LinkSpring{30, 0, 1.2, true}};
  free.join({clamp_of_beams(0, 1), pin_link<2>("hook", at_end(1), of_body<2>(2, {0, 0.2})), bungee});
  const Eigen::VectorXd start = free.system->initial_state();
  const auto before = free.system->observe(start, 0, own_points);
  const double until = 0.2;
  const Eigen::VectorXd y = run(*free.system, until, 5e-4);
  const auto after = free.system->observe(y, until, own_points);
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-11);
  const Eigen::VectorXd z = run(*free.system, until, 0);  // an explicit method keeps the others, too
  const auto best = free.system->observe(z, until, own_points);
  EXPECT_LT((best.momentum - before.momentum).norm(), 5e-12);
  EXPECT_NEAR(best.angular_momentum[2], before.angular_momentum[2], 1e-10 * std::abs(before.angular_momentum[2]));
  EXPECT_NEAR(best.energy.total(), before.energy.total(), 1e-9 * before.energy.kinetic);
}

TEST(Assembly, TangentIsTheDerivativeOfTheResidual) {
  Beams all;
  BeamModel<2> model = elastic_model();
  all.add(model, straight(0, 1, 3, 0.7));
  ChainState<2> second = straight(1, 1.6, 2, 0);
  all.add(model, second);
  BodyModel<2> body;
  body.inertia = {0, 0, 0.3};
  body.center = {1.6, -0.2};
  all.bodies.push_back(std::make_unique<BodySystem<2>>(body));
  Link<2> spring{"spring", {at_start(0), of_body<2>(2, {0.1, -0.1})}, {}, LinkSpring{30, 2, 0.5, false}};
  all.join({clamp_of_beams(0, 1), pin_link<2>("hook", at_end(1), of_body<2>(2, {0, 0.2})), spring,
            distance_link<2>("rod", at_start(0), of_body<2>(2, {0.3, 0}), 1.9)});
  AssemblyEquations<2> equations(*all.system);
  Eigen::VectorXd q, v;
  equations.expand(all.system->initial_state(), q, v);
  Eigen::VectorXd a = Eigen::VectorXd::Random(q.size());
  v.head(q.size() - equations.multipliers()) += 0.3 * Eigen::VectorXd::Random(q.size() - equations.multipliers());
  const TangentWeights by{1, 40, 1600};
  ASSERT_TRUE(equations.linearize(q, v, a, 0, by));
  const Eigen::Index own = q.size() - equations.multipliers();
  Eigen::VectorXd direction = Eigen::VectorXd::Random(q.size()), r, s;
  const auto at = [&](double size, Eigen::VectorXd& result) {
    Eigen::VectorXd there = q, rate = v, second_rate = a + by.a * size * direction;
    there.head(own) += size * direction.head(own);
    rate.head(own) += by.v * size * direction.head(own);
    equations.residual(there, rate, second_rate, 0, result);
  };
  const double size = 1e-6;
  at(size, r);
  at(-size, s);
  Eigen::VectorXd found = (r - s) / (2 * size);
  equations.solve(found);
  EXPECT_LT((found - direction).norm(), 1e-5 * direction.norm());
}

TEST(Assembly, ALinkThatOthersMakeSuperfluousIsNamed) {
  BodyModel<2> body;
  body.inertia = {0, 0, 0.3};
  Bodies<2> held({body}, {pin_link<2>("first", of_ground<2>({0, 0}), of_body<2>(0, {0, 0})),
                          pin_link<2>("again", of_ground<2>({0, 0}), of_body<2>(0, {0, 0}))});
  EXPECT_EQ(held.system->settle().size(), 1U);
  const Eigen::VectorXd y = run(*held.system, 0.1, 1e-3);
  EXPECT_LT(y.head<2>().norm(), 1e-12);
}

}  // namespace
}  // namespace vlbeam::test
