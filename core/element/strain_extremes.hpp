#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/element/moving_kinematics.hpp"
#include "core/element/rest_strain.hpp"
#include "core/element/section.hpp"
#include "core/pack.hpp"

namespace vlbeam {

/// Least and largest of what the points looked at bear, from the rest shape.
struct StrainExtremes {
  struct Bounds {
    double least = std::numeric_limits<double>::infinity();
    double largest = -std::numeric_limits<double>::infinity();

    void add(double value) {
      least = std::min(least, value);
      largest = std::max(largest, value);
    }
    void add(const Bounds& others) {
      least = std::min(least, others.least);
      largest = std::max(largest, others.largest);
    }
    void add(const Pack& values) {
      for (int i = 0; i < Pack::width; ++i) add(values[i]);
    }
  };

  Bounds strain;         ///< axial, as the strain law measures it [-]
  Bounds force;          ///< along the axis, damping included [N]
  double curvature = 0;  ///< largest, as the strain law measures it [1/m]

  /// Those of other points.
  void add(const StrainExtremes& others) {
    strain.add(others.strain);
    force.add(others.force);
    curvature = std::max(curvature, others.curvature);
  }

  /// `rest` is null for a straight, unstrained rest shape. With packs, four points.
  template <class Real, int D>
  void add(const BeamSection& section, const PointMotion<Real, D>& at,
           const std::type_identity_t<RestStrain<Real>>* rest, Feels feels = Feels::everything) {
    if (feels != Feels::all_but_stretch) add_axial(section, at, rest);
    if (feels == Feels::stretch) return;
    Real from_rest = curvature_of(section, at);
    if (rest != nullptr) from_rest -= rest->curvature;
    curvature = std::max(curvature, largest_size(from_rest));
  }

 private:
  static double largest_size(double value) { return std::abs(value); }
  static double largest_size(const Pack& values) {
    return std::max(std::max(std::abs(values[0]), std::abs(values[1])),
                    std::max(std::abs(values[2]), std::abs(values[3])));
  }
  template <class Real, int D>
  void add_axial(const BeamSection& section, const PointMotion<Real, D>& at, const RestStrain<Real>* rest) {
    using std::sqrt;
    const Real stretch = sqrt(at.r_x.dot(at.r_x)), stretch_rate = at.r_x.dot(at.v_x) / stretch;
    const bool green = section.stiffness.green();
    Real from_rest = green ? Real((stretch * stretch - Real(1)) * Real(0.5)) : Real(stretch - Real(1));
    const Real rate = green ? Real(stretch * stretch_rate) : stretch_rate;
    if (rest != nullptr) from_rest -= rest->axial;
    strain.add(from_rest);
    // what is conjugate to Green's strain acts on the length before, the force on the length after
    const auto& k = section.stiffness;
    Real pull = from_rest, viscous = Real(section.damping) * rate;
    if (k.slackens()) {
      const SlackLaw<Real> rope(from_rest, k.slack_over);
      pull = rope.pull;
      viscous *= rope.stiffness;
    }
    const Real conjugate = Real(k.EA) * (pull + viscous);
    force.add(green ? Real(conjugate * stretch) : conjugate);
  }
  template <class Real, int D>
  static Real curvature_of(const BeamSection& section, const PointMotion<Real, D>& at) {
    using std::sqrt;
    const double regularization = D == 3 ? section.curvature_regularization : 0;
    if (D == 3 && regularization == 0) {  // a magnitude, whose gradient is not defined where the beam is straight
      const Real g = at.r_x.dot(at.r_x), along = at.r_x.dot(at.r_xx);
      const Real squared = g * at.r_xx.dot(at.r_xx) - along * along;
      return sqrt(clamped(squared, 0, std::numeric_limits<double>::max())) /
             (section.stiffness.green() ? Real(g * sqrt(g)) : g);
    }
    return Curvature<Real, D>(at.r_x, at.r_xx, section.stiffness.law, regularization).value;
  }
};

}  // namespace vlbeam
