#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/element/moving_kinematics.hpp"
#include "core/element/rest_strain.hpp"
#include "core/element/section.hpp"

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
  };

  Bounds strain;         ///< axial, as the strain law measures it [-]
  Bounds force;          ///< along the axis, damping included [N]
  double curvature = 0;  ///< largest, as the strain law measures it [1/m]

  /// `rest` is null for a straight, unstrained rest shape.
  template <int D>
  void add(const BeamSection& section, const PointMotion<double, D>& at, const RestStrain<double>* rest,
           Feels feels = Feels::everything) {
    if (feels != Feels::all_but_stretch) add_axial(section, at, rest);
    if (feels == Feels::stretch) return;
    curvature = std::max(curvature, std::abs(curvature_of(section, at) - (rest != nullptr ? rest->curvature : 0)));
  }

 private:
  template <int D>
  void add_axial(const BeamSection& section, const PointMotion<double, D>& at, const RestStrain<double>* rest) {
    const double stretch = at.r_x.norm(), stretch_rate = at.r_x.dot(at.v_x) / stretch;
    const bool green = section.stiffness.green();
    const double eps = green ? (stretch * stretch - 1) / 2 : stretch - 1;
    const double rate = green ? stretch * stretch_rate : stretch_rate;
    const double from_rest = eps - (rest != nullptr ? rest->axial : 0);
    strain.add(from_rest);
    // what is conjugate to Green's strain acts on the length before, the force on the length after
    const auto& k = section.stiffness;
    const double pull = k.slackens() ? SlackLaw<double>(from_rest, k.slack_over).pull : from_rest;
    force.add(k.EA * (pull + section.damping * rate) * (green ? stretch : 1));
  }
  template <int D>
  static double curvature_of(const BeamSection& section, const PointMotion<double, D>& at) {
    const double regularization = D == 3 ? section.curvature_regularization : 0;
    if (D == 3 && regularization == 0) {  // a magnitude, whose gradient is not defined where the beam is straight
      const double g = at.r_x.squaredNorm();
      const double squared = g * at.r_xx.squaredNorm() - at.r_x.dot(at.r_xx) * at.r_x.dot(at.r_xx);
      return std::sqrt(std::max(squared, 0.0)) / (section.stiffness.green() ? g * std::sqrt(g) : g);
    }
    return Curvature<double, D>(at.r_x, at.r_xx, section.stiffness.law, regularization).value;
  }
};

}  // namespace vlbeam
