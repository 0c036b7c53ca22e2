#include "stretch.hpp"

#include "dual.hpp"

namespace judge {
namespace {

using Plain = Dual<double, 5>;    // of the potential energy, by r'_x, r'_y, r''_x, r''_y, h
using Along = Dual<double, 1>;    // of anything, along the motion
using Moving = Dual<Along, 6>;    // of the kinetic energy, by rate_x, rate_y, flow, r'_x, r'_y, h
using Weight = Dual<double, 3>;   // of the potential energy of gravity, by r_x, r_y, h
using Inertia = Dual<double, 3>;  // of the kinetic energy, by rate_x, rate_y, flow

template <class D>
D variable(double value, int i) {
  D x(value);
  x.d[i] = 1;
  return x;
}

Moving variable(double value, double rate, int i) {
  Moving x;
  x.v.v = value;
  x.v.d[0] = rate;
  x.d[i].v = 1;
  return x;
}

}  // namespace

Stretch::Stretch(const Section& section, int degree, int points)
    : section_(section), modes_(make_modes(degree, points)) {
  all_.resize(degree + 1, 4);
  at0_.resize(points, 4);
  at1_.resize(points, 4);
  at2_.resize(points, 2);
  on0_.resize(points, 6);
  on1_.resize(points, 2);
  on2_.resize(points, 2);
  sums_.resize(degree + 1, 6);
}

/// The end functions have the coefficients r and sigma = h s. This is a change of coordinates, differentiated by the
/// product rule here and in evaluate().
void Stretch::load(const Ends& q, const Ends& rate, const BubblesIn& c, const BubblesIn& c_rate) {
  const double h = (q[9] - q[8]) / 2, dh = (rate[9] - rate[8]) / 2;
  for (int k = 0; k < 2; ++k) {
    all_(0, k) = q[k];
    all_(1, k) = h * q[2 + k];
    all_(2, k) = q[4 + k];
    all_(3, k) = h * q[6 + k];
    all_(0, 2 + k) = rate[k];
    all_(1, 2 + k) = h * rate[2 + k] + dh * q[2 + k];
    all_(2, 2 + k) = rate[4 + k];
    all_(3, 2 + k) = h * rate[6 + k] + dh * q[6 + k];
  }
  all_.bottomLeftCorner(bubbles(), 2) = c;
  all_.bottomRightCorner(bubbles(), 2) = c_rate;
}

/// At one point: d/dt dT/d(rate) - dT/d(place) + dV/d(place), but for what is proportional to accelerations; and that.
void Stretch::differentiate(int g, const Place& at, const Eigen::Vector2d& gravity) {
  const double w = modes_.weight[g], after = (1 + modes_.xi[g]) / 2, before = 1 - after;

  const Moving T = kinetic_density(section_, variable(at.rate[0], 0, 0), variable(at.rate[1], 0, 1),
                                   variable(at.flow, 0, 2), variable(at.d[0], at.drate[0], 3),
                                   variable(at.d[1], at.drate[1], 4), variable(at.h, at.h_rate, 5));
  const Plain dx = variable<Plain>(at.d[0], 0), dy = variable<Plain>(at.d[1], 1), h = variable<Plain>(at.h, 4);
  Plain U = axial_density(section_, dx, dy, h);
  if (section_.EI != 0) {
    U += bending_density(section_, dx, dy, variable<Plain>(at.dd[0], 2), variable<Plain>(at.dd[1], 3), h);
  }
  const Weight G = gravity_density(section_, gravity[0], gravity[1], variable<Weight>(at0_(g, 0), 0),
                                   variable<Weight>(at0_(g, 1), 1), variable<Weight>(at.h, 2));
  // T is a quadratic form of rates and flow: its gradient at flow 1 is a column of the mass.
  const Inertia M = kinetic_density(section_, variable<Inertia>(0, 0), variable<Inertia>(0, 1), variable<Inertia>(1, 2),
                                    Inertia(at.d[0]), Inertia(at.d[1]), Inertia(at.h));
  for (int k = 0; k < 2; ++k) {
    on0_(g, k) = w * (-T.d[k].d[0] - G.d[k]);
    on0_(g, 2 + k) = w * before * M.d[k];
    on0_(g, 4 + k) = w * after * M.d[k];
    on1_(g, k) = w * (T.d[3 + k].v - U.d[k]);
    on2_(g, k) = -w * U.d[2 + k];
  }
  const double on_flow = -w * T.d[2].d[0], on_h = w * (T.d[5].v - U.d[4] - G.d[2]);
  on_a_ += before * on_flow - on_h / 2;
  on_b_ += after * on_flow + on_h / 2;
  m_aa_ += w * before * before * M.d[2];
  m_ab_ += w * before * after * M.d[2];
  m_bb_ += w * after * after * M.d[2];
}

void Stretch::evaluate(const Ends& q, const Ends& rate, const BubblesIn& c, const BubblesIn& c_rate,
                       const Eigen::Vector2d& gravity) {
  load(q, rate, c, c_rate);
  at0_.rightCols<2>().noalias() = modes_.value * all_.rightCols<2>();
  at1_.noalias() = modes_.slope * all_;
  at2_.noalias() = modes_.bend * all_.leftCols<2>();
  at0_.leftCols<2>().setZero();  // gravity is linear in r: its derivatives need no place
  const double h = (q[9] - q[8]) / 2, dh = (rate[9] - rate[8]) / 2;
  on_a_ = on_b_ = m_aa_ = m_ab_ = m_bb_ = 0;
  const bool heavy = gravity != Eigen::Vector2d::Zero();
  if (heavy) at0_.leftCols<2>().noalias() = modes_.value * all_.leftCols<2>();
  for (int g = 0; g < modes_.xi.size(); ++g) {
    const double after = (1 + modes_.xi[g]) / 2;
    differentiate(g,
                  {{at0_(g, 2), at0_(g, 3)},
                   {at1_(g, 2), at1_(g, 3)},
                   {at1_(g, 0), at1_(g, 1)},
                   {at2_(g, 0), at2_(g, 1)},
                   (1 - after) * rate[8] + after * rate[9],
                   h,
                   dh},
                  gravity);
  }
  sums_.noalias() = modes_.value.transpose() * on0_;
  sums_.leftCols<2>().noalias() += modes_.slope.transpose() * on1_;
  sums_.leftCols<2>().noalias() += modes_.bend.transpose() * on2_;

  // In the coordinates r_A, sigma_A, r_B, sigma_B, a, b. Bubbles have a mass of rho A h each and no coupling with the
  // ends.
  bubble_mass_ = section_.rhoA * h;
  const int n = bubbles();
  EndsMatrix mass = EndsMatrix::Zero();
  Ends force;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 2; ++k) {
      for (int j = 0; j < 4; ++j) mass(2 * i + k, 2 * j + k) = bubble_mass_ * modes_.ends_gram(i, j);
      mass(2 * i + k, 8) = mass(8, 2 * i + k) = sums_(i, 2 + k);
      mass(2 * i + k, 9) = mass(9, 2 * i + k) = sums_(i, 4 + k);
      force[2 * i + k] = sums_(i, k);
    }
  }
  double aa = 0, ab = 0, bb = 0, fa = 0, fb = 0;
  for (int k = 0; k < 2; ++k) {
    const auto on_c = sums_.col(k).tail(n), with_a = sums_.col(2 + k).tail(n), with_b = sums_.col(4 + k).tail(n);
    aa += with_a.dot(with_a);
    ab += with_a.dot(with_b);
    bb += with_b.dot(with_b);
    fa += with_a.dot(on_c);
    fb += with_b.dot(on_c);
  }
  mass(8, 8) = m_aa_ - aa / bubble_mass_;
  mass(9, 9) = m_bb_ - bb / bubble_mass_;
  mass(8, 9) = mass(9, 8) = m_ab_ - ab / bubble_mass_;
  force[8] = on_a_ - fa / bubble_mass_;
  force[9] = on_b_ - fb / bubble_mass_;

  // sigma = h s: its acceleration is h s'' + (b'' - a'')/2 s + 2 h' s'.
  Ends rest = Ends::Zero();
  EndsMatrix J = EndsMatrix::Identity();
  for (const int i : {2, 3, 6, 7}) {
    J(i, i) = h;
    J(i, 8) = -q[i] / 2;
    J(i, 9) = q[i] / 2;
    rest[i] = 2 * dh * rate[i];
  }
  force_.noalias() = J.transpose() * (force - mass * rest);
  mass_.noalias() = J.transpose() * mass * J;
}

void Stretch::bubble_accelerations(const Ends& accelerations, Eigen::Ref<Bubbles> out) const {
  const int n = bubbles();
  for (int k = 0; k < 2; ++k) {
    out.col(k) = (sums_.col(k).tail(n) - sums_.col(2 + k).tail(n) * accelerations[8] -
                  sums_.col(4 + k).tail(n) * accelerations[9]) /
                 bubble_mass_;
  }
}

Energies Stretch::energies(const Ends& q, const Ends& rate, const BubblesIn& c, const BubblesIn& c_rate,
                           const Eigen::Vector2d& gravity) const {
  Stretch copy = *this;
  copy.load(q, rate, c, c_rate);
  const Eigen::MatrixXd r = modes_.value * copy.all_, d = modes_.slope * copy.all_, dd = modes_.bend * copy.all_;
  const double h = (q[9] - q[8]) / 2;
  Energies sum;
  for (int g = 0; g < modes_.xi.size(); ++g) {
    const double w = modes_.weight[g], after = (1 + modes_.xi[g]) / 2;
    const double flow = (1 - after) * rate[8] + after * rate[9];
    sum.kinetic += w * kinetic_density(section_, r(g, 2), r(g, 3), flow, d(g, 0), d(g, 1), h);
    sum.axial += w * axial_density(section_, d(g, 0), d(g, 1), h);
    sum.bending += w * bending_density(section_, d(g, 0), d(g, 1), dd(g, 0), dd(g, 1), h);
    sum.gravity += w * gravity_density(section_, gravity[0], gravity[1], r(g, 0), r(g, 1), h);
  }
  return sum;
}

Bubbles Stretch::fit(const Ends& q, const Eigen::Matrix<double, Eigen::Dynamic, 2>& curve) const {
  Stretch copy = *this;
  const Bubbles none = Bubbles::Zero(bubbles(), 2);
  copy.load(q, Ends::Zero(), none, none);
  const Eigen::MatrixXd off = curve - modes_.value * copy.all_.leftCols<2>();
  return modes_.value.rightCols(bubbles()).transpose() * (modes_.weight.asDiagonal() * off);
}

}  // namespace judge
