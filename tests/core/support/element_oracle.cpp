#include "tests/core/support/element_oracle.hpp"

#include "core/geometry/rational_cubic.hpp"
#include "tests/core/support/dual.hpp"

namespace vlbeam::test {
namespace {

using First = Dual<double>;
using Second = Dual<First>;

/// The definitions, for any scalar type.
template <class Real, int D>
struct Definitions {
  using Vector = Vec<Real, D>;
  using Column = ElementColumn<Real, D>;
  const ElementOracle<D>& o;

  /// Weights on the current interval. `transported`: Bernstein coefficients of the stored cubic W(x) from its values
  /// and derivatives at the two ends.
  Weights<Real> weights(const Real& x_a, const Real& x_b) const {
    const auto& w = o.stored.w;
    if (o.transport == WeightTransport::frozen) return {Real(w[0]), Real(w[1]), Real(w[2]), Real(w[3])};
    const double c1 = 3 * (w[1] - w[0]), c2 = 3 * (w[2] - 2 * w[1] + w[0]), c3 = w[3] - 3 * w[2] + 3 * w[1] - w[0];
    auto value = [&](const Real& s) { return w[0] + s * (c1 + s * (c2 + s * Real(c3))); };
    auto derivative = [&](const Real& s) { return c1 + s * (2 * c2 + s * Real(3 * c3)); };
    const Real a = (x_a - o.stored.x_a) / Real(o.stored.x_b - o.stored.x_a);
    const Real b = (x_b - o.stored.x_a) / Real(o.stored.x_b - o.stored.x_a);
    const Real third = (b - a) / Real(3);
    return {value(a), value(a) + third * derivative(a), value(b) - third * derivative(b), value(b)};
  }

  std::array<Vector, 4> point(const Column& at, const Real& x) const {
    const auto q = coordinates<Real, D>(at);
    const Real l = q.x_b - q.x_a;
    auto r = RationalCubic<Real, D>::from_nodal(q.e, l, weights(q.x_a, q.x_b)).evaluate(Real((x - q.x_a) / l));
    r[1] = r[1] / l;
    r[2] = r[2] / Real(l * l);
    r[3] = r[3] / Real(l * l * l);
    return r;
  }

  Real strain(const Vector& r_x) const {
    using std::sqrt;
    const Real g = r_x.dot(r_x);
    return o.section.stiffness.green() ? Real((g - Real(1)) / Real(2)) : Real(sqrt(g) - Real(1));
  }

  /// kappa^2, by Lagrange's identity |a x b|^2 = a.a b.b - (a.b)^2.
  Real curvature_squared(const Vector& r_x, const Vector& r_xx) const {
    const Real g = r_x.dot(r_x), h = r_x.dot(r_xx);
    const Real area = g * r_xx.dot(r_xx) - h * h;
    return o.section.stiffness.green() ? Real(area / (g * g * g)) : Real(area / (g * g));
  }

  /// Signed in the plane, regularized in space.
  Real curvature(const Vector& r_x, const Vector& r_xx) const {
    using std::sqrt;
    const double regularization = o.section.curvature_regularization;
    if constexpr (D == 3) return sqrt(curvature_squared(r_x, r_xx) + Real(regularization * regularization));
    const Real g = r_x.dot(r_x), area = r_x[0] * r_xx[1] - r_x[1] * r_xx[0];
    return o.section.stiffness.green() ? Real(area / (g * sqrt(g))) : Real(area / g);
  }

  Real energy_density(const std::array<Vector, 4>& r) const {
    const Real eps = strain(r[1]);
    const auto& k = o.section.stiffness;
    return Real(k.EA / 2) * eps * eps + Real(k.EI / 2) * curvature_squared(r[1], r[2]);
  }

  /// The point x of the element between ends on the rest curve.
  std::array<Vector, 4> rest_point(const Column& q, const Real& x) const {
    const auto& c = *o.rest;
    auto at = [&](const Real& s) -> Vector {
      Vector sum = c[3].template cast<Real>();
      for (std::size_t i = 3; i-- > 0;) sum = Vector(sum * s) + c[i].template cast<Real>();
      return sum;
    };
    auto slope = [&](const Real& s) -> Vector {
      return c[1].template cast<Real>() + c[2].template cast<Real>() * Real(Real(2) * s) +
             c[3].template cast<Real>() * Real(Real(3) * s * s);
    };
    Column rest = q;
    rest.template segment<D>(0) = at(q[4 * D]);
    rest.template segment<D>(D) = slope(q[4 * D]);
    rest.template segment<D>(2 * D) = at(q[4 * D + 1]);
    rest.template segment<D>(3 * D) = slope(q[4 * D + 1]);
    return point(rest, x);
  }

  /// Of the point x of an element whose derivatives there are `r`.
  Real energy_density(const std::array<Vector, 4>& r, const Column& q, const Real& x) const {
    if (!o.rest) return energy_density(r);
    const auto rest = rest_point(q, x);
    const Real eps = strain(r[1]) - strain(rest[1]), kappa = curvature(r[1], r[2]) - curvature(rest[1], rest[2]);
    return Real(o.section.stiffness.EA / 2) * eps * eps + Real(o.section.stiffness.EI / 2) * kappa * kappa;
  }

  /// Calls visit(x, weight, definitions of what is felt there) at the quadrature points.
  template <class Visit>
  void at_points(const Column& q, const Visit& visit) const {
    for (const auto& [u, weight, feels] : o.rule) {
      ElementOracle<D> felt = o;
      felt.section = o.section.as_felt(feels);
      visit(material_point(q, u), Real(length(q) * Real(weight)), Definitions{felt});
    }
  }

  static Real length(const Column& q) { return q[4 * D + 1] - q[4 * D]; }
  static Real material_point(const Column& q, double u) { return q[4 * D] * Real(1 - u) + q[4 * D + 1] * Real(u); }

  Real elastic_energy(const Column& q) const {
    Real sum(0);
    at_points(q, [&](const Real& x, const Real& weight, const auto& here) {
      sum += weight * here.energy_density(point(q, x), q, x);
    });
    return sum;
  }
};

/// The point x of an element in motion, as functions of time: rates are at the fixed material point.
template <class Real, int D>
std::array<Vec<Dual<Real>, D>, 4> moving_point(const ElementOracle<D>& o, const ElementColumn<Real, D>& q,
                                               const ElementColumn<Real, D>& rate, const Real& x) {
  return Definitions<Dual<Real>, D>{o}.point(in_motion(q, rate), Dual<Real>(x, Real(0)));
}

template <class Real, int D>
Real lagrangian(const ElementOracle<D>& o, const ElementColumn<Real, D>& q, const ElementColumn<Real, D>& rate) {
  using Define = Definitions<Real, D>;
  const Vec<Real, D> g = o.gravity.template cast<Real>();
  Real sum = -Define{o}.elastic_energy(q);
  Define{o}.at_points(q, [&](const Real& x, const Real& weight, const auto& here) {
    const auto moving = moving_point<Real, D>(o, q, rate, x);
    const Vec<Real, D> r = value_of(moving[0]), v = rate_of(moving[0]);
    sum += weight * Real(here.o.section.rhoA) * (v.dot(v) / Real(2) + g.dot(r));
  });
  return sum;
}

}  // namespace

template <int D>
auto ElementOracle<D>::point(const Column& q, double x) const -> std::array<Vector, 4> {
  return Definitions<double, D>{*this}.point(q, x);
}

template <int D>
auto ElementOracle<D>::point_rate(const Column& q, const Column& rate, double x) const -> std::array<Vector, 4> {
  const auto moving = moving_point<double, D>(*this, q, rate, x);
  return {rate_of(moving[0]), rate_of(moving[1]), rate_of(moving[2]), rate_of(moving[3])};
}

template <int D>
auto ElementOracle<D>::remainder(const Column& q, const Column& rate, double x) const -> Vector {
  const ElementColumn<First, D> moving = in_motion(q, rate), constant = rate.template cast<First>();
  return rate_of(rate_of(moving_point<First, D>(*this, moving, constant, First(x))[0]));
}

template <int D>
double ElementOracle<D>::elastic_energy(const Column& q) const {
  return Definitions<double, D>{*this}.elastic_energy(q);
}

template <int D>
auto ElementOracle<D>::elastic_force(const Column& q) const -> Column {
  return -gradient(
      [this](const ElementColumn<First, D>& at) { return Definitions<First, D>{*this}.elastic_energy(at); }, q);
}

template <int D>
DenseEquations<D> ElementOracle<D>::variational(const Column& q, const Column& rate) const {
  auto unit = [](int i) -> Column { return Column::Unit(i); };
  const Column still = Column::Zero();
  // second derivative of L along two directions of (q, q')
  auto second = [&](const Column& q1, const Column& v1, const Column& q2, const Column& v2) {
    ElementColumn<Second, D> q_moving, v_moving;
    for (int i = 0; i < element_size<D>; ++i) {
      q_moving[i] = {First(q[i], q1[i]), First(q2[i])};
      v_moving[i] = {First(rate[i], v1[i]), First(v2[i])};
    }
    return lagrangian<Second, D>(*this, q_moving, v_moving).rate.rate;
  };
  const Column by_position = gradient(
      [&](const ElementColumn<First, D>& at) { return lagrangian<First, D>(*this, at, rate.template cast<First>()); },
      q);
  DenseEquations<D> eq;
  for (int i = 0; i < element_size<D>; ++i) {
    for (int j = 0; j <= i; ++j) eq.mass(i, j) = eq.mass(j, i) = second(still, unit(i), still, unit(j));
    eq.force[i] = by_position[i] - second(still, unit(i), rate, still);
  }
  return eq;
}

template <int D>
DenseEquations<D> ElementOracle<D>::virtual_work(const Column& q, const Column& rate) const {
  DenseEquations<D> eq;
  eq.mass.setZero();
  eq.force.setZero();
  for (const auto& [u, weight, feels] : rule) {
    ElementOracle felt = *this;
    felt.section = section.as_felt(feels);
    const double x = material_point(q, u), wl = weight * Definitions<double, D>::length(q);
    Eigen::Matrix<double, D, element_size<D>> N;
    Column by_energy;
    for (int i = 0; i < element_size<D>; ++i) {
      const auto varied = moving_point<double, D>(*this, q, Column::Unit(i), x);
      N.col(i) = rate_of(varied[0]);
      const ElementColumn<First, D> q_varied = in_motion<double, element_size<D>>(q, Column::Unit(i));
      by_energy[i] = Definitions<First, D>{felt}.energy_density(varied, q_varied, First(x, 0)).rate;
    }
    eq.mass += wl * felt.section.rhoA * N.transpose() * N;
    eq.force += wl * (felt.section.rhoA * N.transpose() * (gravity - remainder(q, rate, x)) - by_energy);
  }
  return eq;
}

template <int D>
auto ElementOracle<D>::viscous_force(const Column& q, const Column& rate) const -> Column {
  auto dissipation_function = [&](const ElementColumn<First, D>& at) {
    const Definitions<Second, D> define{*this};
    First sum(0);
    for (const auto& [u, weight, feels] : rule) {
      const Stiffness k = section.as_felt(feels).stiffness;
      const auto moving = moving_point<First, D>(*this, q.template cast<First>(), at, First(material_point(q, u)));
      const First strain_rate = define.strain(moving[1]).rate;
      const Second k2 = define.curvature_squared(moving[1], moving[2]);
      const First product = k2.rate / First(2);  // kappa kappa'
      const double regularization = section.curvature_regularization;
      const First curvature_rate2 = product * product / (k2.value + First(regularization * regularization));
      sum += First(weight * Definitions<double, D>::length(q) * section.damping / 2) *
             (First(k.EA) * strain_rate * strain_rate + First(k.EI) * curvature_rate2);
    }
    return sum;
  };
  return -gradient(dissipation_function, rate);
}

template struct ElementOracle<2>;
template struct ElementOracle<3>;

}  // namespace vlbeam::test
