#pragma once

#include <array>
#include <optional>

#include "core/element/moving_points.hpp"

namespace vlbeam {

/// Bending of an element in which EI changes. There the curvature jumps, which the cubic's does not; the moment goes
/// on. So the moment M(x) is linear along the element, and its curvature M/EI makes the element bend by as much as the
/// cubic's, k, does. What of k is not linear, k - c(x), is as stiff as elsewhere. The energy is, over all linear M and
/// c,
///   max of the integral of M k - M^2/(2 EI),  and min of that of EI (k - c)^2/2:
/// what changes the cubic, or moves the points, changes it at constant M and c. Where EI is one it is EI k^2/2. In
/// space curvatures and moments are vectors, across the axis.
template <class Real, int D>
class PieceBending {
 public:
  using Vector = Vec<Real, D>;
  using Moment = std::array<Real, D == 2 ? 1 : 3>;

  /// Counts x from `origin`, over `length` [m].
  PieceBending(StrainLaw law, double origin, double length) : law_(law), origin_(origin), length_(length) {}

  /// A point for M and c, whose place is `x`.
  void add(const Real& weight, const Real& x, const Vector& r_x, const Vector& r_xx, double EI) {
    const Moment k = curvature(r_x, r_xx);
    moment_.add(weight, Real(1 / EI), at(x), k, weight);
    smooth_.add(weight, Real(EI), at(x), k, weight * Real(EI));
  }
  /// Finds them, once all points are there.
  void solve() {
    moment_.solve();
    smooth_.solve();
  }

  /// By how much more than the cubic the element bends at x, where its bending stiffness is EI [1/m].
  Moment beyond_cubic(const Real& x, double EI) const {
    Moment beyond;
    for (std::size_t i = 0; i < beyond.size(); ++i) {
      beyond[i] = moment_.at(at(x), i) * Real(1 / EI) - smooth_.at(at(x), i);
    }
    return beyond;
  }

  /// What is stored per length at a point, how that grows along the beam while r_x and r_xx stay, and its derivatives
  /// by these.
  struct Stress {
    Real stored = Real(0), stored_x = Real(0);
    Vector p, m;
  };
  Stress stress(const Real& x, const Vector& r_x, const Vector& r_xx, double EI) const {
    const Moment k = curvature(r_x, r_xx);
    const Real along = at(x);
    Moment moment;
    Stress stress;
    for (std::size_t c = 0; c < k.size(); ++c) {
      const Real M = moment_.at(along, c), rest = k[c] - smooth_.at(along, c);
      moment[c] = M + Real(EI) * rest;
      stress.stored += M * (k[c] - M * Real(0.5 / EI)) + Real(0.5 * EI) * rest * rest;
      stress.stored_x +=
          (moment_.growth[c] * (k[c] - M * Real(1 / EI)) - smooth_.growth[c] * Real(EI) * rest) * Real(1 / length_);
    }
    // k = r_x x r_xx/g^(n/2), g = r_x.r_x
    const Real scale = over_slope(r_x);
    if constexpr (D == 2) {
      const Real of = moment[0] * scale;
      stress.p << of * r_xx[1], -(of * r_xx[0]);
      stress.m << -(of * r_x[1]), of * r_x[0];
    } else {
      Vector of;
      of << moment[0] * scale, moment[1] * scale, moment[2] * scale;
      stress.p = r_xx.cross(of);
      stress.m = of.cross(r_x);
    }
    Real work(0);
    for (std::size_t c = 0; c < k.size(); ++c) work += moment[c] * k[c];
    stress.p -= r_x * Real(work * Real(curvature_power(law_)) / r_x.dot(r_x));
    return stress;
  }

 private:
  /// A linear function along the element, of as many components as a moment has, by least squares.
  struct Linear {
    Real a = Real(0), b = Real(0), c = Real(0);  ///< its matrix
    Moment by_mean = zero(), by_growth = zero();
    Moment mean = zero(), growth = zero();

    void add(const Real& weight, const Real& of, const Real& along, const Moment& k, const Real& of_k) {
      const Real w = weight * of;
      a += w;
      b += w * along;
      c += w * along * along;
      for (std::size_t i = 0; i < k.size(); ++i) {
        by_mean[i] += of_k * k[i];
        by_growth[i] += of_k * k[i] * along;
      }
    }
    void solve() {
      const Real inverse = Real(1) / (a * c - b * b);
      for (std::size_t i = 0; i < mean.size(); ++i) {
        mean[i] = (c * by_mean[i] - b * by_growth[i]) * inverse;
        growth[i] = (a * by_growth[i] - b * by_mean[i]) * inverse;
      }
    }
    Real at(const Real& along, std::size_t i) const { return mean[i] + growth[i] * along; }

    static Moment zero() {
      Moment none;
      none.fill(Real(0));
      return none;
    }
  };

  Real at(const Real& x) const { return (x - Real(origin_)) * Real(1 / length_); }
  Real over_slope(const Vector& r_x) const {
    using std::sqrt;
    const Real g = r_x.dot(r_x);
    return Real(1) / (law_ == StrainLaw::green ? Real(g * sqrt(g)) : g);
  }
  Moment curvature(const Vector& r_x, const Vector& r_xx) const {
    const Real scale = over_slope(r_x);
    if constexpr (D == 2) {
      return {(r_x[0] * r_xx[1] - r_x[1] * r_xx[0]) * scale};
    } else {
      const Vector f = r_x.cross(r_xx);
      return {f[0] * scale, f[1] * scale, f[2] * scale};
    }
  }

  StrainLaw law_;
  double origin_, length_;
  Linear moment_, smooth_;  ///< M, c
};

/// That of an element, of whose points `kinematics` knows the motion; nothing where a piece does not bend at all.
template <class Real, int D, MovingEnds Ends>
std::optional<PieceBending<Real, D>> piece_bending(const MovingKinematics<Real, D, Ends>& kinematics,
                                                   const BeamRule& rule, const BeamSection& own,
                                                   const SectionPieces& pieces) {
  const double x_a = number_of(kinematics.coordinates().x_a), x_b = number_of(kinematics.coordinates().x_b);
  bool bends = true;
  pieces.visit(x_a, x_b, [&](const auto& piece) { bends = bends && piece.share->of(own).bends(); });
  if (!bends) return std::nullopt;
  PieceBending<Real, D> bending(own.stiffness.law, x_a, x_b - x_a);
  const RestKinematics<Real, D, Ends>* const none = nullptr;
  const auto motion = [&](const auto& u, const auto& shape) { return kinematics.at(u, shape); };
  for_each_point_in_pieces(kinematics, rule, own, pieces, none, motion,
                           [&](const auto& point, const auto& at, const auto*) {
                             const double EI = point.here_felt().stiffness.EI;
                             if (EI > 0) bending.add(point.weight, point.x, at.r_x, at.r_xx, EI);
                           });
  bending.solve();
  return bending;
}

}  // namespace vlbeam
