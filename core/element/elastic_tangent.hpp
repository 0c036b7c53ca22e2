#pragma once

#include <cmath>

#include "core/element/strain.hpp"

namespace vlbeam {

/// Second derivatives of the strain energy per length W(r_x, r_xx): dp/dr_x, dp/dr_xx and dm/dr_xx of ElasticStress;
/// dm/dr_x is the transpose of dp/dr_xx.
/// With g = r_x.r_x, s = r_x.r_xx and h = r_xx.r_xx curvature is kappa^2 = h g^(1-n) - s^2 g^(-n), n = 3 (green) or 2
/// (engineering), in the plane and in space alike, and W depends on g, s and h alone. No branch on values.
template <class Real, int D>
struct ElasticTangent {
  using Matrix = Eigen::Matrix<Real, D, D>;

  Matrix pp, pm, mm;

  ElasticTangent(const Vec<Real, D>& rx, const Vec<Real, D>& rxx, const Stiffness& k) {
    using std::sqrt;
    const Real g = rx.dot(rx);
    Real by_g, by_gg;  // of the axial energy, then of W
    if (k.green()) {
      by_g = Real(0.25 * k.EA) * (g - Real(1));
      by_gg = Real(0.25 * k.EA);
      if (k.slackens()) {  // 2 dW/dg = EA psi'
        const SlackLaw<Real> rope(Real(0.5) * (g - Real(1)), k.slack_over);
        by_g = Real(0.5 * k.EA) * rope.pull;
        by_gg = Real(0.25 * k.EA) * rope.stiffness;
      }
    } else {
      const Real inverse_stretch = Real(1) / sqrt(g);
      by_g = Real(0.5 * k.EA) * (Real(1) - inverse_stretch);
      by_gg = Real(0.25 * k.EA) * inverse_stretch * inverse_stretch * inverse_stretch;
      if (k.slackens()) {  // 2 stretch dW/dg = EA psi'
        const SlackLaw<Real> rope(g * inverse_stretch - Real(1), k.slack_over);
        by_g = Real(0.5 * k.EA) * inverse_stretch * rope.pull;
        by_gg = Real(0.25 * k.EA) * inverse_stretch * inverse_stretch * (rope.stiffness - rope.pull * inverse_stretch);
      }
    }
    if (!k.bends()) {
      pp = rank_one(Real(Real(4) * by_gg), rx, rx);
      pp.diagonal().array() += Real(2) * by_g;
      pm = mm = Matrix::Zero();
    } else {
      const double n = k.curvature_power();
      const Real s = rx.dot(rxx), h = rxx.dot(rxx);
      const Real i1 = Real(1) / g;
      const Real half = k.green() ? Real(Real(0.5 * k.EI) * i1 * i1) : Real(Real(0.5 * k.EI) * i1);
      const Real si = s * i1, s2 = s * si, hi = h * i1;  // half = EI g^(1-n) / 2
      by_g += half * (Real(n) * s2 - Real(n - 1) * h) * i1;
      by_gg += half * (Real(n * (n - 1)) * hi - Real(n * (n + 1)) * si * si) * i1;
      const Real by_s = Real(-2) * half * si, by_h = half;
      const Real by_gs = Real(2 * n) * half * si * i1, by_gh = Real(1 - n) * half * i1, by_ss = Real(-2) * half * i1;
      const Vec<Real, D> along = rx * Real(Real(4) * by_gg) + rxx * Real(Real(2) * by_gs);
      const Vec<Real, D> across = rx * Real(Real(2) * by_gs) + rxx * by_ss;
      pp = along * rx.transpose() + across * rxx.transpose();
      pp.diagonal().array() += Real(2) * by_g;
      pm = across * rx.transpose() + rank_one(Real(Real(4) * by_gh), rx, rxx);
      pm.diagonal().array() += by_s;
      mm = rank_one(by_ss, rx, rx);
      mm.diagonal().array() += Real(2) * by_h;
    }
  }

 private:
  static Matrix rank_one(const Real& scale, const Vec<Real, D>& a, const Vec<Real, D>& b) {
    return (a * scale) * b.transpose();
  }
};

}  // namespace vlbeam
