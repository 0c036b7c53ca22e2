#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "core/element/active.hpp"
#include "core/pack.hpp"
#include "mechanics/frames/frame_table.hpp"
#include "mechanics/frames/triad.hpp"

namespace vlbeam {

template <int N>
SineCosine<Active<N>> sine_cosine(const Active<N>& x) {
  const auto of = sine_cosine(x.value());
  SineCosine<Active<N>> result{Active<N>(of.sine), Active<N>(of.cosine)};
  result.sine.derivatives() = of.cosine * x.derivatives();
  result.cosine.derivatives() = -of.sine * x.derivatives();
  return result;
}

template <int N>
Active<N> angle_of(const Active<N>& y, const Active<N>& x) {
  Active<N> result(angle_of(y.value(), x.value()));
  const double size = x.value() * x.value() + y.value() * y.value();
  result.derivatives() = (y.derivatives() * x.value() - x.derivatives() * y.value()) / size;
  return result;
}

/// A number of the same kind as `Real`, but without derivatives.
template <class Real>
using Plain = std::conditional_t<std::is_same_v<Real, Pack>, Pack, double>;

/// Lanes beyond where the series hold are computed by themselves: as a number's, the digits of a lane are its own.
inline SineCosine<Pack> sine_cosine(const Pack& x) {
  SineCosine<Pack> result = small_angle::series(x);
  for (int i = 0; i < Pack::width; ++i) {
    if (std::abs(x[i]) < small_angle::sine_below) continue;
    const auto of = sine_cosine(x[i]);
    result.sine.set(i, of.sine);
    result.cosine.set(i, of.cosine);
  }
  return result;
}

inline Pack angle_of(const Pack& y, const Pack& x) {
  Pack result = small_angle::angle_series(Pack(y / x));
  for (int i = 0; i < Pack::width; ++i) {
    if (!(std::abs(y[i]) < small_angle::tangent_below * x[i])) result.set(i, portable::atan2(y[i], x[i]));
  }
  return result;
}

/// Where an element's ends are and how they are turned, as far as it matters: r_B - r_A, the slopes, the directions of
/// the sections' y axes across these. `turned` is the angle between the latter, to within half a turn.
template <class Real>
struct FrameEnds {
  Vec<Real, 3> chord, s_a, s_b, d_a, d_b;
  Plain<Real> turned = 0;
};

/// What an element does against a change of its ends: conjugate to the chord [N], to the slopes [N m], while the
/// sections have no spin about the tangents, and to these spins [N m].
template <class Real>
struct FrameForce {
  Vec<Real, 3> chord = Vec<Real, 3>::Zero(), s_a = chord, s_b = chord;
  Real spin_a = Real(0), spin_b = Real(0);
  Real inner = Real(0);  ///< to the inner angle [N m]
};

/// An element that bends about two axes and twists. A frame goes from the middle of the element, where it is the mean
/// of the directions at the ends, brought there by smallest rotations, to u by the smallest rotation of the tangent,
/// and there turns by (u - 1/2) times the twist Delta between the ends, and by 4 u (1 - u) times an inner angle. With
/// the curvature vector k = r_x x r_xx/|r_x|^n, n = 3 (green) or 2 (engineering), and m, t the tangents in the middle
/// and at u, the strains are k.f_y, k.f_z and
///   tau = (Delta + 4 (1 - 2 u) phi)/(l |r_x|^(n-2)) - m.k/(1 + m.t),
/// whose last term is what the smallest rotation twists by itself. Nothing depends on what angles are counted from.
///
/// All is computed in components along e_1, the direction of end A brought to the middle, e_2 = m x e_1 and e_3 = m.
/// With c = r_x x r_xx and q = 1/(|r_x| + r_x.m) the strains before the frame turns about the tangent are
///   k.f_1 = (c_1 - c_3 q r_x1)/|r_x|^n,  k.f_2 = (c_2 - c_3 q r_x2)/|r_x|^n,  -m.k/(1 + m.t) = (-c_3 + c_3 q
///   r_x3)/|r_x|^n,
/// so that with a vector n any sum of them is (n.c - c_3 q n.r_x)/|r_x|^n. `Real` may be a Pack.
template <class Real>
class FrameElement {
 public:
  using Vector = Vec<Real, 3>;
  using Table = FrameTableOf<Plain<Real>>;

  FrameElement(const Table& table, const FrameSection& section, const FrameEnds<Real>& ends)
      : table_(table), section_(section) {
    using std::sqrt;
    const Vector middle = sum(table.middle, ends.chord, ends.s_a, ends.s_b);
    per_stretch_m_ = Real(1) / sqrt(middle.dot(middle));
    e_3_ = middle * per_stretch_m_;
    const auto stretch = [](const Vector& s) -> Real { return sqrt(s.dot(s)); };
    a_.stretch = stretch(ends.s_a);
    b_.stretch = stretch(ends.s_b);
    a_.near = Real(1) / (a_.stretch + e_3_.dot(ends.s_a));
    e_1_ = ends.d_a - (ends.s_a + e_3_ * a_.stretch) * Real(e_3_.dot(ends.d_a) * a_.near);
    e_2_ = e_3_.cross(e_1_);
    chord_ = inside(ends.chord);
    a_.s = inside(ends.s_a);
    b_.s = inside(ends.s_b);
    b_.near = Real(1) / (b_.stretch + b_.s[2]);
    const Vector d = inside(ends.d_b);
    const Real share = d[2] * b_.near, along = d[0] - b_.s[0] * share, across = d[1] - b_.s[1] * share;
    const auto expected = sine_cosine(ends.turned);
    twist_ = angle_of(Real(across * expected.cosine - along * expected.sine),
                      Real(along * expected.cosine + across * expected.sine)) +
             ends.turned;
    for (std::size_t g = 0; g < 2; ++g) points_[g] = look(table.points[g]);
  }

  const Real& twist() const { return twist_; }
  /// At a point of the table.
  FrameStrain<Real> strain(std::size_t g, const Real& inner) const {
    return strain(g, inner, sine_cosine(Real(inner * table_.points[g].bump())));
  }
  /// The inner angle of the least energy, found from 0 [rad].
  Real inner() const;
  /// [J], of bending and of torsion.
  std::array<Real, 2> energy(const Real& inner) const;
  FrameForce<Real> force(const Real& inner) const;
  /// The derivative of a strain: of y, z and torsion at the first point of the table, then at the second.
  FrameForce<Real> derivative(std::size_t strain, const Real& inner) const;
  /// At a point of the table, from the rest shape [1/m].
  FrameStrain<double> from_rest(std::size_t g, double inner) const {
    const FrameStrain<double> at = strain(g, inner), &rest = table_.points[g].rest;
    return {at.y - rest.y, at.z - rest.z, at.torsion - rest.torsion};
  }

 private:
  template <class>
  friend class FrameStiffness;

  struct End {
    Real stretch, near;  ///< |s|, 1/(|s| + s.m)
    Vector s;

    /// What the angle of the end in the middle changes by with s, and with the middle's tangent.
    Vector by_slope() const { return around(s) * Real(near / stretch); }
    Vector by_middle() const { return around(s) * near; }
  };
  struct Seen {
    Vector r_x, r_xx, c;
    Real per_stretch, over, near;  ///< 1/|r_x|, 1/|r_x|^n, q
    Real per_length;               ///< of torsion, by the twist [1/m]
    Real sine, cosine;             ///< of u times the twist
    Real y, z, torsion, by_inner;  ///< without the inner angle
    Real own;                      ///< what of torsion is the smallest rotation's
  };
  /// What a point does: n, and what follows of it; M_y, M_z and the torque, times the weight.
  struct Pull {
    FrameStrain<Real> strain, moment;
    SineCosine<Real> turn;  ///< of the frame about the tangent, all in all
    Vector n, on_x, on_xx;
    Real spin;
  };

  template <class Scale>
  static Vector sum(const std::array<Scale, 3>& s, const Vector& chord, const Vector& s_a, const Vector& s_b) {
    return chord * Real(s[0]) + s_a * Real(s[1]) + s_b * Real(s[2]);
  }
  /// e_3 x v
  static Vector around(const Vector& v) { return {-v[1], v[0], Real(0)}; }
  Vector inside(const Vector& v) const { return {e_1_.dot(v), e_2_.dot(v), e_3_.dot(v)}; }
  Vector outside(const Vector& v) const { return e_1_ * v[0] + e_2_ * v[1] + e_3_ * v[2]; }
  bool green() const { return section_.law == StrainLaw::green; }

  Seen look(const typename Table::Point& point) const {
    using std::sqrt;
    Seen at;
    at.r_x = sum(point.s_x, chord_, a_.s, b_.s);
    at.r_xx = sum(point.s_xx, chord_, a_.s, b_.s);
    at.c = at.r_x.cross(at.r_xx);
    const Real stretch = sqrt(at.r_x.dot(at.r_x));
    at.per_stretch = Real(1) / stretch;
    at.over = at.per_stretch * at.per_stretch;
    if (green()) at.over *= at.per_stretch;
    at.near = Real(1) / (stretch + at.r_x[2]);
    const Real share = at.c[2] * at.near;
    const Real y = (at.c[0] - share * at.r_x[0]) * at.over, z = (at.c[1] - share * at.r_x[1]) * at.over;
    const auto turn = sine_cosine(Real(twist_ * point.u));
    at.sine = turn.sine;
    at.cosine = turn.cosine;
    at.y = y * at.cosine + z * at.sine;
    at.z = z * at.cosine - y * at.sine;
    at.per_length = Real(Plain<Real>(1) / table_.length);
    if (green()) at.per_length *= at.per_stretch;
    at.own = -share * stretch * at.over;
    at.torsion = twist_ * at.per_length + at.own;
    at.by_inner = at.per_length * Real(4 * (1 - 2 * point.u));
    return at;
  }
  FrameStrain<Real> strain(std::size_t g, const Real& inner, const SineCosine<Real>& of) const {
    const Seen& at = points_[g];
    return {at.y * of.cosine + at.z * of.sine, at.z * of.cosine - at.y * of.sine, at.torsion + at.by_inner * inner};
  }
  /// The gradient of n.c - c_3 q n.r_x, by r_x and by r_xx.
  static std::array<Vector, 2> gradient(const Seen& at, const Vector& n) {
    const Real along = n.dot(at.r_x), share = along * at.near, rise = at.c[2] * at.near;
    Vector by_x = at.r_xx.cross(n) + around(at.r_xx) * share - n * rise + at.r_x * Real(rise * share * at.per_stretch);
    by_x[2] += rise * share;
    return {by_x, n.cross(at.r_x) - around(at.r_x) * share};
  }
  /// Of the moments that the section answers strains with; of any other ones.
  Pull pull(std::size_t g, const Real& inner, const SineCosine<Real>& of) const;
  Pull pull(std::size_t g, const FrameStrain<Real>& strain, const SineCosine<Real>& of,
            const FrameStrain<Real>& moment) const;
  /// Adds what a point does; takes what acts on the tangent in the middle, and all out of the components inside.
  void add(std::size_t g, const Pull& here, FrameForce<Real>& force, Vector& on_middle) const;
  FrameForce<Real> outside(FrameForce<Real> force, Vector on_middle) const;

  const Table& table_;
  const FrameSection& section_;
  Vector e_1_, e_2_, e_3_, chord_;
  Real per_stretch_m_, twist_;
  End a_, b_;
  std::array<Seen, 2> points_;
};

namespace newton {

/// Of a step of Newton's iteration in one unknown: down where the energy is not convex, too.
inline double divided(double pull, double slope, double stiff) {
  return pull / (slope + stiff > 0 ? slope + stiff : stiff);
}
template <int N>
Active<N> divided(const Active<N>& pull, const Active<N>& slope, const Active<N>& stiff) {
  return pull / (slope + stiff > Active<N>(0) ? slope + stiff : stiff);
}
inline Pack divided(const Pack& pull, const Pack& slope, const Pack& stiff) {
  Pack below = slope + stiff;
  for (int i = 0; i < Pack::width; ++i) below.set(i, below[i] > 0 ? below[i] : stiff[i]);
  return pull / below;
}

constexpr double small = 1e-9;  ///< the next step would be below rounding

/// Takes the step; whether another one is due. `done` is where none is.
inline bool go_on(double& x, double step, double& /*done*/) {
  x -= step;
  return !(std::abs(step) < small);
}
template <int N>
bool go_on(Active<N>& x, const Active<N>& step, Active<N>& /*done*/) {
  x -= step;
  return !(std::abs(step.value()) < small);
}
inline bool go_on(Pack& x, const Pack& step, Pack& done) {
  bool more = false;
  for (int i = 0; i < Pack::width; ++i) {
    if (done[i] != 0) continue;
    x.set(i, x[i] - step[i]);
    if (std::abs(step[i]) < small) {
      done.set(i, 1);
    } else {
      more = true;
    }
  }
  return more;
}

}  // namespace newton

template <class Real>
Real FrameElement<Real>::inner() const {
  constexpr int most = 30;
  const Real EI_y(section_.EI_y), EI_z(section_.EI_z), GIp(section_.GIp);
  Real stiff(0);
  for (std::size_t g = 0; g < 2; ++g) {
    stiff += Real(table_.points[g].weight) * GIp * points_[g].by_inner * points_[g].by_inner;
  }
  Real angle(0), done(0);
  for (int i = 0; i < most; ++i) {
    Real pull(0), slope(0);
    const auto of = sine_cosine(Real(angle * table_.points[0].bump()));  // which is that of the other point
    for (std::size_t g = 0; g < 2; ++g) {
      const auto& point = table_.points[g];
      const FrameStrain<Real> strain = this->strain(g, angle, of);
      const Real w(point.weight), bump(point.bump()), by = points_[g].by_inner;
      const Real y = EI_y * (strain.y - point.rest.y), z = EI_z * (strain.z - point.rest.z);
      pull += w * ((y * strain.z - z * strain.y) * bump + GIp * (strain.torsion - point.rest.torsion) * by);
      slope +=
          w * (bump * bump) * (EI_y * strain.z * strain.z + EI_z * strain.y * strain.y - y * strain.y - z * strain.z);
    }
    if (!newton::go_on(angle, newton::divided(pull, slope, stiff), done)) break;
  }
  return angle;
}

template <class Real>
std::array<Real, 2> FrameElement<Real>::energy(const Real& inner) const {
  std::array<Real, 2> sum{Real(0), Real(0)};
  for (std::size_t g = 0; g < 2; ++g) {
    const auto& point = table_.points[g];
    const FrameStrain<Real> strain = this->strain(g, inner);
    const Real y = strain.y - Real(point.rest.y), z = strain.z - Real(point.rest.z);
    const Real torsion = strain.torsion - Real(point.rest.torsion);
    sum[0] += Real(0.5 * point.weight) * (Real(section_.EI_y) * y * y + Real(section_.EI_z) * z * z);
    sum[1] += Real(0.5 * point.weight * section_.GIp) * torsion * torsion;
  }
  return sum;
}

template <class Real>
typename FrameElement<Real>::Pull FrameElement<Real>::pull(std::size_t g, const Real& inner,
                                                           const SineCosine<Real>& of) const {
  const auto& point = table_.points[g];
  const FrameStrain<Real> strain = this->strain(g, inner, of);
  const Real w(point.weight);
  const Real y = w * Real(section_.EI_y) * (strain.y - Real(point.rest.y));
  const Real z = w * Real(section_.EI_z) * (strain.z - Real(point.rest.z));
  const Real torque = w * Real(section_.GIp) * (strain.torsion - Real(point.rest.torsion));
  return pull(g, strain, of, {y, z, torque});
}

template <class Real>
typename FrameElement<Real>::Pull FrameElement<Real>::pull(std::size_t g, const FrameStrain<Real>& strain,
                                                           const SineCosine<Real>& of,
                                                           const FrameStrain<Real>& moment) const {
  const Seen& at = points_[g];
  const double n = curvature_power(section_.law);
  Pull result;
  result.strain = strain;
  result.turn = {at.sine * of.cosine + at.cosine * of.sine, at.cosine * of.cosine - at.sine * of.sine};
  const auto& [sine, cosine] = result.turn;
  const auto& [y, z, torque] = moment;
  result.moment = moment;
  result.n = {y * cosine - z * sine, y * sine + z * cosine, -torque};
  result.spin = y * strain.z - z * strain.y;
  const auto by = gradient(at, result.n);
  const Real per_square = at.per_stretch * at.per_stretch;
  // the sum of the strains times what acts on them, which |r_x| divides n times
  Real shrinks = Real(n) * (y * strain.y + z * strain.z + torque * at.own);
  if (green()) shrinks += torque * (strain.torsion - at.own);  // torsion by the stretch
  result.on_x = by[0] * at.over - at.r_x * Real(shrinks * per_square);
  result.on_xx = by[1] * at.over;
  return result;
}

template <class Real>
void FrameElement<Real>::add(std::size_t g, const Pull& here, FrameForce<Real>& force, Vector& on_middle) const {
  const auto& point = table_.points[g];
  const Seen& at = points_[g];
  const Real torque = here.moment.torsion * at.per_length;
  force.spin_a += here.spin * Real(1 - point.u) - torque;
  force.spin_b += here.spin * Real(point.u) + torque;
  force.inner += at.by_inner * here.moment.torsion + here.spin * Real(point.bump());
  force.chord += here.on_x * Real(point.s_x[0]) + here.on_xx * Real(point.s_xx[0]);
  force.s_a += here.on_x * Real(point.s_x[1]) + here.on_xx * Real(point.s_xx[1]);
  force.s_b += here.on_x * Real(point.s_x[2]) + here.on_xx * Real(point.s_xx[2]);
  for (int i = 0; i < 2; ++i) {
    on_middle[i] +=
        at.r_x[i] * here.on_x[2] - at.r_x[2] * here.on_x[i] + at.r_xx[i] * here.on_xx[2] - at.r_xx[2] * here.on_xx[i];
  }
}

template <class Real>
FrameForce<Real> FrameElement<Real>::outside(FrameForce<Real> force, Vector on_middle) const {
  on_middle += a_.by_middle() * force.spin_a + b_.by_middle() * force.spin_b;
  on_middle *= per_stretch_m_;
  force.chord = outside(force.chord + on_middle * Real(table_.middle[0]));
  force.s_a = outside(force.s_a + a_.by_slope() * force.spin_a + on_middle * Real(table_.middle[1]));
  force.s_b = outside(force.s_b + b_.by_slope() * force.spin_b + on_middle * Real(table_.middle[2]));
  return force;
}

/// What follows a strain's change back to what it changes with.
template <class Real>
FrameForce<Real> FrameElement<Real>::force(const Real& inner) const {
  FrameForce<Real> force;
  Vector on_middle = Vector::Zero();  // on the tangent there, which turns all that is inside the other way
  const auto of = sine_cosine(Real(inner * table_.points[0].bump()));
  for (std::size_t g = 0; g < 2; ++g) add(g, pull(g, inner, of), force, on_middle);
  return outside(force, on_middle);
}

template <class Real>
FrameForce<Real> FrameElement<Real>::derivative(std::size_t strain, const Real& inner) const {
  FrameForce<Real> force;
  Vector on_middle = Vector::Zero();
  const auto of = sine_cosine(Real(inner * table_.points[0].bump()));
  const std::size_t g = strain / 3;
  const auto one = [&](std::size_t i) { return Real(strain % 3 == i ? 1 : 0); };
  add(g, pull(g, this->strain(g, inner, of), of, {one(0), one(1), one(2)}), force, on_middle);
  return outside(force, on_middle);
}

/// Where an end of an element is and how it is turned by its angle.
struct FrameNode {
  const TriadReference* reference;
  Vec<double, 3> r, s;
  Vec<double, 3> direction;      ///< of the section's y axis
  Vec<double, 3> spin_by_slope;  ///< A

  FrameNode(const TriadReference& from, const Vec<double, 3>& place, const Vec<double, 3>& slope, double phi)
      : reference(&from), r(place), s(slope) {
    const double per = 1 / std::sqrt(slope.dot(slope));
    const Vec<double, 3> t = slope * per, across = t.cross(from.t);
    const double near = 1 / (1 + from.t.dot(t));
    spin_by_slope = across * (per * near);
    const Vec<double, 3> d = from.d - (from.t + t) * (t.dot(from.d) * near);
    const auto [sine, cosine] = sine_cosine(phi);
    direction = d * cosine + t.cross(d) * sine;
  }
};

/// Unknowns of an element: r_A, s_A, phi_A, r_B, s_B, phi_B.
using FrameVector = Eigen::Matrix<double, 14, 1>;
using FrameMatrix = Eigen::Matrix<double, 14, 14>;

/// Adds what a torque on the angle of an end adds to the second derivative by its slope, whose unknowns begin at
/// `slope`, because the angle is not counted from where the smallest rotation takes the present direction.
void add_turned_reference(const FrameNode& node, double torque, int slope, FrameMatrix& tangent);

/// `turned` is the twist of the element to within half a turn [rad].
FrameEnds<double> frame_ends(const FrameNode& a, const FrameNode& b, double turned);
/// The gradient of the element's energy, the inner angle being that of the least energy.
FrameVector frame_gradient(const FrameTable& table, const FrameSection& section, const FrameNode& a, const FrameNode& b,
                           double turned);
/// The second derivative of that energy.
FrameMatrix frame_tangent(const FrameTable& table, const FrameSection& section, const FrameNode& a, const FrameNode& b,
                          double turned);

}  // namespace vlbeam
