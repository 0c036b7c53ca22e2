#pragma once

#include <numbers>
#include <sstream>

#include "core/element/section.hpp"
#include "core/error.hpp"
#include "mechanics/spin/spin_element.hpp"

namespace vlbeam {

/// A shaft of circular section and of one material.
struct CircularShaft {
  double radius = 0.01;          ///< [m]
  double density = 7800;         ///< [kg/m^3]
  double youngs_modulus = 2e11;  ///< [Pa]
  double poisson_ratio = 0.3;
  double damping = 0;  ///< Kelvin-Voigt time c [s], in tension, bending and torsion

  double area() const { return std::numbers::pi * radius * radius; }
  double shear_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }
  /// Second moment of area about a diameter, J = pi r^4/4 [m^4]; that about the axis, I_p, is twice as much.
  double second_moment() const { return area() * radius * radius / 4; }

  /// Throws ModelError where no such shaft exists.
  void check() const {
    auto demand = [](bool holds, const char* field, double value, const char* allowed) {
      if (holds) return;
      std::ostringstream text;
      text << value;
      throw ModelError(field, text.str(), allowed);
    };
    demand(radius > 0, "radius", radius, "a number > 0 [m]");
    demand(density > 0, "density", density, "a number > 0 [kg/m^3]");
    demand(youngs_modulus > 0, "youngs_modulus", youngs_modulus, "a number > 0 [Pa]");
    demand(poisson_ratio > -1 && poisson_ratio < 0.5, "poisson_ratio", poisson_ratio, "a number in (-1, 0.5)");
    demand(damping >= 0, "damping", damping, "a number >= 0 [s]");
  }

  BeamSection section() const {
    return {.rhoA = density * area(),
            .stiffness = {youngs_modulus * area(), youngs_modulus * second_moment()},
            .damping = damping};
  }
  SpinSection spin() const {
    return {.rhoIp = density * 2 * second_moment(), .GIp = shear_modulus() * 2 * second_moment(), .damping = damping};
  }
};

}  // namespace vlbeam
