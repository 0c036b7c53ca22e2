#pragma once

#include <optional>

#include "mechanics/frames/frame_element.hpp"
#include "mechanics/frames/frame_rest_rates.hpp"

namespace vlbeam {

// Kelvin-Voigt damping of an element with frames. Its dissipation function is
//   R = sum_g w_g c (EI_y y'^2 + EI_z z'^2 + GIp torsion'^2)/2,
// of the rates of strains, less those of the rest shape, at material points where the inner angle is 0. That angle is
// no coordinate: it turns at the rate at which R is least, as the angle itself is that of the least energy. Stiff
// torsion so does not lock.

/// What the material resists with: w c EI_y, w c EI_z, w c GIp at the first point of a table, then at the second, times
/// `scale`.
template <class Real, class Table>
std::array<Real, 6> resistances(const Table& table, const FrameSection& section, const Real& scale) {
  std::array<Real, 6> result;
  for (std::size_t g = 0; g < 2; ++g) {
    const Real share = scale * Real(table.points[g].weight * section.damping);
    result[3 * g] = share * Real(section.EI_y);
    result[3 * g + 1] = share * Real(section.EI_z);
    result[3 * g + 2] = share * Real(section.GIp);
  }
  return result;
}

/// How the material points at an element's ends move: r_B' - r_A', slopes, and spins about the tangents.
template <class Real>
struct FrameRates {
  Vec<Real, 3> chord, s_a, s_b;
  Real spin_a, spin_b;
};

/// The gradient of R by those rates, and the power that is lost [W].
template <class Real>
struct FrameViscous {
  FrameForce<Real> force;
  Real power;

  std::array<Real, 6> moments;  ///< conjugate to the rates of strains

  /// `resists` are resistances(), `rest` the rates of strains at rest, null where they stay.
  FrameViscous(const FrameElement<Real>& element, const std::array<Real, 6>& resists, const FrameRates<Real>& rates,
               const std::array<Real, 6>* rest = nullptr)
      : power(0) {
    std::array<FrameForce<Real>, 6> by;
    std::array<Real, 6> strain_rate;
    Real pull(0), stiff(0);
    for (std::size_t i = 0; i < 6; ++i) {
      by[i] = element.derivative(i, Real(0));
      strain_rate[i] = by[i].chord.dot(rates.chord) + by[i].s_a.dot(rates.s_a) + by[i].s_b.dot(rates.s_b) +
                       by[i].spin_a * rates.spin_a + by[i].spin_b * rates.spin_b;
      if (rest != nullptr) strain_rate[i] -= (*rest)[i];
      const Real moment = resists[i] * by[i].inner;
      pull += moment * strain_rate[i];
      stiff += moment * by[i].inner;
    }
    const Real inner_rate = -pull / stiff;
    for (std::size_t i = 0; i < 6; ++i) {
      strain_rate[i] += by[i].inner * inner_rate;
      const Real& moment = moments[i] = resists[i] * strain_rate[i];
      power += moment * strain_rate[i];
      force.chord += by[i].chord * moment;
      force.s_a += by[i].s_a * moment;
      force.s_b += by[i].s_b * moment;
      force.spin_a += by[i].spin_a * moment;
      force.spin_b += by[i].spin_b * moment;
    }
  }
};

/// That of one element in its coordinates: r_A, s_A, phi_A, r_B, s_B, phi_B, and where ends may move along the beam x_A
/// and x_B. The material point at a mark moves at r' - r_x x', its slope changes at s' - r_xx x', and it spins at
/// Omega - tau x' (moving_frame_spin.hpp); what acts on it acts on the mark as these say.
struct FrameDamping {
  const TriadReference &from_a, &from_b;
  const FrameTable& table;  ///< of length 1 where ends may move
  const FrameSection& section;
  double turned;
  /// r_xx at both ends by r_B - r_A, s_A, s_B, in an element of length 1; counts where ends may move.
  std::array<std::array<double, 3>, 2> bends;
  std::optional<FrameRestRates> rest = {};  ///< where ends may move and the beam is curved at rest

  template <class Real, int N>
  struct Answer {
    Eigen::Matrix<Real, N, 1> force;  ///< to be added to M a - Q
    Real power;
  };

  template <class Real, int N>
  Answer<Real, N> at(const Eigen::Matrix<Real, N, 1>& q, const Eigen::Matrix<Real, N, 1>& rate) const {
    using Vector = Vec<Real, 3>;
    constexpr bool moves = N == 16;
    const Real l = moves ? Real(q[N - 1] - q[N - 2]) : Real(1);
    struct End {
      Vector s, A, d, r_rate, s_rate, bent;
      Real spin;
    };
    const auto look = [&](const TriadReference& from, int i) {
      End end;
      end.s = q.template segment<3>(i + 3);
      end.A = from.spin_by_slope<Real>(end.s);
      end.d = from.direction<Real>(end.s, q[i + 6]);
      end.r_rate = rate.template segment<3>(i);
      end.s_rate = rate.template segment<3>(i + 3);
      end.spin = rate[i + 6] + end.A.dot(end.s_rate);
      return end;
    };
    End a = look(from_a, 0), b = look(from_b, 7);
    const Vector chord = q.template segment<3>(7) - q.template segment<3>(0);
    const FrameEnds<Real> ends{chord, a.s * l, b.s * l, a.d, b.d, turned};
    const FrameElement<Real> element(table, section, ends);
    Real tau(0);
    if constexpr (moves) {
      tau = element.twist() / l;
      const auto pass = [&](End& end, std::size_t e, const Real& x_rate) {
        end.bent =
            (chord * Real(bends[e][0]) + ends.s_a * Real(bends[e][1]) + ends.s_b * Real(bends[e][2])) / Real(l * l);
        end.r_rate -= end.s * x_rate;
        end.s_rate -= end.bent * x_rate;
        end.spin -= tau * x_rate;
      };
      pass(a, 0, rate[N - 2]);
      pass(b, 1, rate[N - 1]);
    }
    const Real scale = !moves ? Real(1) : section.law == StrainLaw::green ? l : Real(Real(1) / l);
    std::array<std::array<Real, 6>, 2> by_rest;  // by x_A' and x_B'
    std::array<Real, 6> rest_rate;
    const bool reshaped = moves && rest;
    if constexpr (moves) {
      for (std::size_t i = 0; reshaped && i < 6; ++i) {
        for (std::size_t e = 0; e < 2; ++e) by_rest[e][i] = at_marks((*rest)[e][i], Real(q[N - 2]), Real(q[N - 1]));
        rest_rate[i] = by_rest[0][i] * rate[N - 2] + by_rest[1][i] * rate[N - 1];
      }
    }
    const FrameViscous<Real> lost(
        element, resistances<Real>(table, section, scale),
        {Vector(b.r_rate - a.r_rate), Vector(a.s_rate * l), Vector(b.s_rate * l), a.spin, b.spin},
        reshaped ? &rest_rate : nullptr);
    Answer<Real, N> answer{{}, lost.power};
    const auto put = [&](const End& end, int i, const Vector& on_r, const Vector& on_s, const Real& on_spin) {
      answer.force.template segment<3>(i) = on_r;
      answer.force.template segment<3>(i + 3) = on_s + end.A * on_spin;
      answer.force[i + 6] = on_spin;
      if constexpr (moves) answer.force[14 + i / 7] = -(end.s.dot(on_r) + end.bent.dot(on_s) + tau * on_spin);
    };
    put(a, 0, -lost.force.chord, lost.force.s_a * l, lost.force.spin_a);
    put(b, 7, lost.force.chord, lost.force.s_b * l, lost.force.spin_b);
    for (std::size_t i = 0; reshaped && i < 6; ++i) {
      for (int e = 0; e < 2; ++e) answer.force[N - 2 + e] -= lost.moments[i] * by_rest[static_cast<std::size_t>(e)][i];
    }
    return answer;
  }

 private:
  /// A number that is known with its derivatives at marks which are these.
  template <class Real>
  static Real at_marks(const Active<2>& known, const Real& x_a, const Real& x_b) {
    Real result(known.value());
    if constexpr (!std::is_same_v<Real, double>) {
      result.derivatives() = x_a.derivatives() * known.derivatives()[0] + x_b.derivatives() * known.derivatives()[1];
    }
    return result;
  }
};

}  // namespace vlbeam
