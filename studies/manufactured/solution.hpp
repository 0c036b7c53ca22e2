#pragma once

#include <vector>

#include "core/geometry/vec.hpp"
#include "io/json.hpp"

namespace vlbeam::manufactured {

using Vector = Vec<double, 2>;

/// A motion of a beam in the plane that is chosen, not computed: r*(x, t) = (x, 0) + sum of a sin(k x + w t + phase).
class ChosenMotion {
 public:
  struct Wave {
    Vector amplitude;    ///< [m]
    double k, w, phase;  ///< [rad/m], [rad/s], [rad]
  };

  explicit ChosenMotion(std::vector<Wave> waves) : waves_(std::move(waves)) {}
  /// {"amplitude": [m, m], "k", "w", "phase"} each.
  static ChosenMotion from_json(const Json& waves);

  /// r* differentiated `by_x` times by x, and `by_t` times by t.
  Vector derivative(double x, double t, int by_x, int by_t = 0) const;

 private:
  std::vector<Wave> waves_;
};

/// Stiffnesses and mass of the beam that is made to follow it, and its curvature at rest.
struct Properties {
  double EA, EI, rhoA;        ///< [N], [N m^2], [kg/m]
  double rest_curvature = 0;  ///< [1/m]
};

/// What the beam must be given so that r* is its motion. All of it comes from the energy per length alone,
/// W = EA ((r_x . r_x - 1)/2)^2/2 + EI (kappa - kappa_0)^2/2, by automatic differentiation: with n = dW/dr_x and
/// m = dW/dr_xx, Hamilton's principle gives rhoA r'' = (n - m_x)_x + b.
class Forces {
 public:
  Forces(ChosenMotion motion, const Properties& properties) : motion_(std::move(motion)), of_(properties) {}

  const ChosenMotion& motion() const { return motion_; }
  /// b at a material point [N/m].
  Vector body(double x, double t) const;
  /// What the part of the beam behind x does on the part before it: n - m_x on r [N], m on r_x [N m].
  struct Cut {
    Vector on_r, on_slope;
  };
  Cut cut(double x, double t) const;

 private:
  /// n and m with the derivatives by x that are needed.
  struct Resultants {
    Vector n, n_x, m, m_x, m_xx;
  };
  Resultants resultants(double x, double t) const;

  ChosenMotion motion_;
  Properties of_;
};

}  // namespace vlbeam::manufactured
