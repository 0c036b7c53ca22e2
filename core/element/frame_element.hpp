#pragma once

#include <array>
#include <cmath>

#include "core/element/active.hpp"
#include "core/element/frame_table.hpp"
#include "core/element/triad.hpp"

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

/// Where an element's ends are and how they are turned, as far as it matters: r_B - r_A, the slopes, the directions of
/// the sections' y axes across these. `turned` is the angle between the latter, to within half a turn.
template <class Real>
struct FrameEnds {
  Vec<Real, 3> chord, s_a, s_b, d_a, d_b;
  double turned = 0;
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
template <class Real>
class FrameElement {
 public:
  using Vector = Vec<Real, 3>;

  FrameElement(const FrameTable& table, const FrameSection& section, const FrameEnds<Real>& ends)
      : table_(table), section_(section) {
    using std::sqrt;
    middle_ = sum(table.middle, ends);
    stretch_m_ = sqrt(middle_.dot(middle_));
    m_ = middle_ / stretch_m_;
    const auto end = [this](const Vector& s, const Vector& d) {
      End at;
      at.stretch = sqrt(s.dot(s));
      at.t = s / at.stretch;
      at.d = carried<Real>(at.t, m_, d);
      at.twists = at.t.cross(m_) / Real((Real(1) + at.t.dot(m_)));
      return at;
    };
    a_ = end(ends.s_a, ends.d_a);
    b_ = end(ends.s_b, ends.d_b);
    const auto expected = sine_cosine(ends.turned);
    const Real along = a_.d.dot(b_.d), across = m_.dot(a_.d.cross(b_.d));
    twist_ = angle_of(Real(across * expected.cosine - along * expected.sine),
                      Real(along * expected.cosine + across * expected.sine)) +
             ends.turned;
    for (std::size_t g = 0; g < 2; ++g) points_[g] = look(table.points[g], ends);
  }

  const Real& twist() const { return twist_; }
  /// At a point of the table.
  FrameStrain<Real> strain(std::size_t g, const Real& inner) const {
    const Seen& at = points_[g];
    const auto& point = table_.points[g];
    const auto [s, c] = sine_cosine(Real(inner * point.bump()));
    return {at.y * c + at.z * s, at.z * c - at.y * s, at.torsion + at.by_inner * inner};
  }
  /// The inner angle of the least energy, found from 0 [rad].
  Real inner() const;
  /// [J], of bending and of torsion.
  std::array<Real, 2> energy(const Real& inner) const;
  FrameForce<Real> force(const Real& inner) const;

 private:
  struct End {
    Real stretch;
    Vector t, d;    ///< d is in the middle of the element
    Vector twists;  ///< t x m/(1 + t.m): the smallest rotation to the middle spins by minus that times what turns
  };
  struct Seen {
    Vector r_x, r_xx, t, k, f_y, f_z;
    Real stretch, over, below;          ///< |r_x|, 1/|r_x|^n, 1 + m.t
    Real per_length;                    ///< of torsion, by the twist [1/m]
    Real y, z, torsion, by_inner, arm;  ///< without the inner angle; m.k
  };

  static double value_of(double x) { return x; }
  template <class Other>
  static double value_of(const Other& x) {
    return x.value();
  }
  static Vector sum(const std::array<double, 3>& s, const FrameEnds<Real>& ends) {
    return ends.chord * Real(s[0]) + ends.s_a * Real(s[1]) + ends.s_b * Real(s[2]);
  }
  bool green() const { return section_.law == StrainLaw::green; }

  Seen look(const FrameTable::Point& point, const FrameEnds<Real>& ends) const {
    using std::sqrt;
    Seen at;
    at.r_x = sum(point.s_x, ends);
    at.r_xx = sum(point.s_xx, ends);
    const Real g = at.r_x.dot(at.r_x);
    at.stretch = sqrt(g);
    at.t = at.r_x / at.stretch;
    at.over = green() ? Real(Real(1) / (g * at.stretch)) : Real(Real(1) / g);
    at.k = at.r_x.cross(at.r_xx) * at.over;
    at.below = Real(1) + m_.dot(at.t);
    const auto [sine, cosine] = sine_cosine(Real(twist_ * point.u));
    const Vector f = a_.d * cosine + m_.cross(a_.d) * sine;
    at.f_y = carried<Real>(m_, at.t, f);
    at.f_z = at.t.cross(at.f_y);
    at.y = at.k.dot(at.f_y);
    at.z = at.k.dot(at.f_z);
    at.arm = m_.dot(at.k);
    at.per_length = green() ? Real(Real(1 / table_.length) / at.stretch) : Real(1 / table_.length);
    at.torsion = twist_ * at.per_length - at.arm / at.below;
    at.by_inner = at.per_length * Real(4 * (1 - 2 * point.u));
    return at;
  }

  const FrameTable& table_;
  const FrameSection& section_;
  Vector middle_, m_;
  Real stretch_m_, twist_;
  End a_, b_;
  std::array<Seen, 2> points_;
};

template <class Real>
Real FrameElement<Real>::inner() const {
  constexpr int most = 30;
  Real angle(0);
  for (int i = 0; i < most; ++i) {
    Real pull(0), slope(0), stiff(0);
    for (std::size_t g = 0; g < 2; ++g) {
      const auto& point = table_.points[g];
      const FrameStrain<Real> strain = this->strain(g, angle);
      const Real w(point.weight), bump(point.bump()), by = points_[g].by_inner;
      const Real y = Real(section_.EI_y) * (strain.y - point.rest.y);
      const Real z = Real(section_.EI_z) * (strain.z - point.rest.z);
      pull +=
          w * ((y * strain.z - z * strain.y) * bump + Real(section_.GIp) * (strain.torsion - point.rest.torsion) * by);
      slope += w * bump * bump *
               (Real(section_.EI_y) * strain.z * strain.z + Real(section_.EI_z) * strain.y * strain.y - y * strain.y -
                z * strain.z);
      stiff += w * Real(section_.GIp) * by * by;
    }
    const Real step = pull / (slope + stiff > Real(0) ? Real(slope + stiff) : stiff);
    angle -= step;
    if (std::abs(value_of(step)) < 1e-9) break;  // the next one would be below rounding
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

/// What follows a strain's change back to what it changes with.
template <class Real>
FrameForce<Real> FrameElement<Real>::force(const Real& inner) const {
  FrameForce<Real> force;
  Vector on_middle = Vector::Zero();  // on the tangent there
  const double n = curvature_power(section_.law);
  for (std::size_t g = 0; g < 2; ++g) {
    const auto& point = table_.points[g];
    const Seen& at = points_[g];
    const FrameStrain<Real> strain = this->strain(g, inner);
    const Real w(point.weight);
    const Real M_y = w * Real(section_.EI_y) * (strain.y - Real(point.rest.y));
    const Real M_z = w * Real(section_.EI_z) * (strain.z - Real(point.rest.z));
    const Real T = w * Real(section_.GIp) * (strain.torsion - Real(point.rest.torsion));
    const auto [s, c] = sine_cosine(Real(inner * point.bump()));
    // all that acts on the curvature vector, and on the spin of the frame
    const Real share = T / at.below;
    const Vector on_k = at.f_y * Real(M_y * c - M_z * s) + at.f_z * Real(M_y * s + M_z * c) - m_ * share;
    const Real spin = M_y * strain.z - M_z * strain.y;
    const Real along = T * (strain.torsion + at.arm / at.below);  // torsion by the stretch, green
    Vector on_x = at.r_xx.cross(on_k) * at.over - at.t * Real(Real(n) * on_k.dot(at.k) / at.stretch);
    if (green()) on_x -= at.t * Real(along / at.stretch);
    const Vector on_xx = on_k.cross(at.r_x) * at.over;
    // on the tangents at the point and in the middle
    const Vector twists = m_.cross(at.t) * Real(spin / at.below);
    const Real arm = share * at.arm / at.below;
    const Vector on_t = m_ * arm - twists, on_m = at.t * arm - twists - at.k * share;
    on_x += (on_t - at.t * at.t.dot(on_t)) / at.stretch;
    on_middle += on_m;
    const Real torque = at.per_length * T;
    force.spin_a += spin * Real(1 - point.u) - torque;
    force.spin_b += spin * Real(point.u) + torque;
    force.inner += at.by_inner * T + spin * Real(point.bump());
    force.chord += on_x * Real(point.s_x[0]) + on_xx * Real(point.s_xx[0]);
    force.s_a += on_x * Real(point.s_x[1]) + on_xx * Real(point.s_xx[1]);
    force.s_b += on_x * Real(point.s_x[2]) + on_xx * Real(point.s_xx[2]);
  }
  const Vector on_a = a_.twists * Real(-force.spin_a), on_b = b_.twists * Real(-force.spin_b);
  on_middle += on_a + on_b;
  const Vector on_r_x = (on_middle - m_ * m_.dot(on_middle)) / stretch_m_;
  force.chord += on_r_x * Real(table_.middle[0]);
  force.s_a += on_r_x * Real(table_.middle[1]) + on_a / a_.stretch;  // which is across the slope
  force.s_b += on_r_x * Real(table_.middle[2]) + on_b / b_.stretch;
  return force;
}

/// Where an end of an element is and how it is turned by its angle.
struct FrameNode {
  const TriadReference* reference;
  Vec<double, 3> r, s;
  Vec<double, 3> direction;      ///< of the section's y axis
  Vec<double, 3> spin_by_slope;  ///< A

  FrameNode(const TriadReference& from, const Vec<double, 3>& place, const Vec<double, 3>& slope, double phi)
      : reference(&from),
        r(place),
        s(slope),
        direction(from.direction(slope, phi)),
        spin_by_slope(from.spin_by_slope<double>(slope)) {}
};

/// Unknowns of an element: r_A, s_A, phi_A, r_B, s_B, phi_B.
using FrameVector = Eigen::Matrix<double, 14, 1>;
using FrameMatrix = Eigen::Matrix<double, 14, 14>;

/// `turned` is the twist of the element to within half a turn [rad].
FrameEnds<double> frame_ends(const FrameNode& a, const FrameNode& b, double turned);
/// The gradient of the element's energy, the inner angle being that of the least energy.
FrameVector frame_gradient(const FrameTable& table, const FrameSection& section, const FrameNode& a, const FrameNode& b,
                           double turned);
/// The second derivative of that energy.
FrameMatrix frame_tangent(const FrameTable& table, const FrameSection& section, const FrameNode& a, const FrameNode& b,
                          double turned);

}  // namespace vlbeam
