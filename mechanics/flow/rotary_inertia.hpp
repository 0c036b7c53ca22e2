#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "core/geometry/prescribed.hpp"
#include "core/tangent_weights.hpp"
#include "mechanics/flow/driven_residual.hpp"

namespace vlbeam {

/// What a section's turning with the axis adds to the kinetic energy per length (Rayleigh's beam, and the shaft of Katz
/// 2001):
///   rhoJ |P r_x'|^2/2 - rhoI_p Omega d.(r_x x r_x')/2,   r_x' the rate of the slope at a fixed material point,
/// P = 1 - d d^T. It holds for small slopes against the direction d, and for one spin Omega of the whole shaft, on
/// which bending does not react. P removes the component of the slope along d. That component must stay out: stretching
/// has no such inertia. With it, short elements that move along the beam would be unstable, because no stiffness
/// opposes gradients of the stretch.
template <int D>
struct RotaryInertia {
  double rhoJ = 0;                                    ///< [kg m]
  double gyroscopic = 0;                              ///< rho I_p Omega [kg m/s]; in space only
  Vec<double, D> direction = Vec<double, D>::Zero();  ///< unit vector d

  bool present() const { return rhoJ != 0 || gyroscopic != 0; }

  /// P v.
  Vec<double, D> across(const Vec<double, D>& v) const { return v - direction.dot(v) * direction; }
  /// d x v, which is nothing in the plane.
  Vec<double, D> turned([[maybe_unused]] const Vec<double, D>& v) const {
    if constexpr (D == 3) return direction.cross(v);
    return Vec<double, D>::Zero();
  }
};

/// One quadrature point, which moves at c along the beam: r_x = sum s_i e_i, and its rate at a fixed material point is
/// sum s_i e_i' + g_i e_i,  g_i = ds_i/dt - c s_i,x.
struct RotaryPoint {
  using Row = Eigen::Vector4d;
  double m, m_rate;          ///< quadrature weight times the length, and its rate
  Row s, s_rate, g, g_rate;  ///< rates at the point
  Row flux;                  ///< m' s + m c s_x: what the point's motion adds to the momentum of s

  /// `f` are the shape functions of frozen weights at u.
  RotaryPoint(const Prescribed& x_a, const Prescribed& x_b, double u, double w, const ShapeTable<double>& f) {
    const double l = x_b.value - x_a.value, growth = (x_b.rate - x_a.rate) / l;
    const double growth2 = (x_b.acceleration - x_a.acceleration) / l;  // l''/l
    const double c = x_a.rate * (1 - u) + x_b.rate * u, c_rate = x_a.acceleration * (1 - u) + x_b.acceleration * u;
    m = w * l;
    m_rate = m * growth;
    for (int i = 0; i < 4; ++i) {
      const auto& shape = f[static_cast<std::size_t>(i)];
      const double position = i % 2 == 0 ? 1 : 0;  // its s is f'/l, that of a slope f'
      const double scale = i % 2 == 0 ? 1 / l : 1, s_x = shape[2] * scale / l;
      s[i] = shape[1] * scale;
      s_rate[i] = -position * growth * s[i];
      g[i] = s_rate[i] - c * s_x;
      g_rate[i] = position * (2 * growth * growth - growth2) * s[i] - c_rate * s_x + c * (1 + position) * growth * s_x;
      flux[i] = m_rate * s[i] + m * c * s_x;
    }
  }
};

/// Lagrange's equations of that energy, summed over the points of one element whose material coordinates are
/// prescribed. All is linear in the nodal coordinates e, of which component by component
///   residual = rhoJ P (A e'' + B e' + C e) - rhoI_p Omega d x (A e' + B e/2).
class RotaryElement {
 public:
  template <int D>
  using Nodal = std::array<Vec<double, D>, 4>;

  RotaryElement(const Prescribed& x_a, const Prescribed& x_b, const ShapeTabulation& table) {
    A_.setZero();
    B_.setZero();
    C_.setZero();
    for (std::size_t i = 0; i < with_mass(table.rule).size(); ++i) {
      const RotaryPoint at(x_a, x_b, table.rule[i].u, table.rule[i].weight, table.shape[i]);
      A_ += at.m * at.s * at.s.transpose();
      B_ += at.flux * at.s.transpose() + at.m * at.s * (at.s_rate + at.g).transpose();
      C_ += at.flux * at.g.transpose() + at.m * at.s * at.g_rate.transpose();
    }
  }

  /// Without the inertia of e'', which is rhoJ P mass().
  template <int D>
  Nodal<D> residual(const RotaryInertia<D>& rotary, const NodalCubic<double, D>& e,
                    const NodalCubic<double, D>& rate) const {
    const Nodal<D> position = nodal(e), velocity = nodal(rate);
    Nodal<D> r;
    for (int i = 0; i < 4; ++i) {
      Vec<double, D> sum = Vec<double, D>::Zero(), gyroscopic = sum;
      for (int j = 0; j < 4; ++j) {
        const auto& v = velocity[static_cast<std::size_t>(j)];
        const auto& q = position[static_cast<std::size_t>(j)];
        sum += B_(i, j) * v + C_(i, j) * q;
        gyroscopic += A_(i, j) * v + 0.5 * B_(i, j) * q;
      }
      r[static_cast<std::size_t>(i)] = rotary.rhoJ * rotary.across(sum) - rotary.gyroscopic * rotary.turned(gyroscopic);
    }
    return r;
  }
  const Eigen::Matrix4d& mass() const { return A_; }
  /// The inertia of the accelerations `a`.
  template <int D>
  Nodal<D> inertia(const RotaryInertia<D>& rotary, const NodalCubic<double, D>& a) const {
    const Nodal<D> nodes = nodal(a);
    Nodal<D> r;
    for (int i = 0; i < 4; ++i) {
      Vec<double, D> sum = Vec<double, D>::Zero();
      for (int j = 0; j < 4; ++j) sum += A_(i, j) * nodes[static_cast<std::size_t>(j)];
      r[static_cast<std::size_t>(i)] = rotary.rhoJ * rotary.across(sum);
    }
    return r;
  }

  template <int D>
  Eigen::Matrix<double, 4 * D, 4 * D> tangent(const RotaryInertia<D>& rotary, const TangentWeights& by) const {
    Eigen::Matrix<double, D, D> cross, across;
    for (int c = 0; c < D; ++c) {
      cross.col(c) = rotary.turned(Vec<double, D>::Unit(c));
      across.col(c) = rotary.across(Vec<double, D>::Unit(c));
    }
    Eigen::Matrix<double, 4 * D, 4 * D> result;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        const double inertia = rotary.rhoJ * (by.a * A_(i, j) + by.v * B_(i, j) + by.q * C_(i, j));
        result.template block<D, D>(i * D, j * D) =
            inertia * across - rotary.gyroscopic * (by.v * A_(i, j) + by.q * 0.5 * B_(i, j)) * cross;
      }
    }
    return result;
  }

  template <int D>
  static Nodal<D> nodal(const NodalCubic<double, D>& e) {
    return {e.r_a, e.s_a, e.r_b, e.s_b};
  }

 private:
  Eigen::Matrix4d A_, B_, C_;
};

/// Rate of the kinetic energy of rotary inertia of one element [W].
template <int D>
double rotary_power(const RotaryInertia<D>& rotary, const Prescribed& x_a, const Prescribed& x_b,
                    const ShapeTabulation& table, const NodalCubic<double, D>& e, const NodalCubic<double, D>& rate,
                    const NodalCubic<double, D>& a) {
  auto sum = [](const RotaryPoint::Row& row, const NodalCubic<double, D>& nodal) -> Vec<double, D> {
    return row[0] * nodal.r_a + row[1] * nodal.s_a + row[2] * nodal.r_b + row[3] * nodal.s_b;
  };
  double power = 0;
  for (std::size_t i = 0; i < with_mass(table.rule).size(); ++i) {
    const RotaryPoint at(x_a, x_b, table.rule[i].u, table.rule[i].weight, table.shape[i]);
    const Vec<double, D> turning = rotary.across(sum(at.s, rate) + sum(at.g, e));
    const Vec<double, D> change = sum(at.s, a) + sum(at.s_rate + at.g, rate) + sum(at.g_rate, e);
    power += rotary.rhoJ * (0.5 * at.m_rate * turning.squaredNorm() + at.m * turning.dot(change));
  }
  return power;
}

}  // namespace vlbeam
