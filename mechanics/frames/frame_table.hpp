#pragma once

#include <array>

#include "core/element/strain_law.hpp"
#include "core/geometry/weights.hpp"

namespace vlbeam {

/// What a section resists besides stretching, about its own axes y and z and about the tangent, and its inertia about
/// that.
struct FrameSection {
  double EI_y = 0, EI_z = 0;  ///< [N m^2]
  double GIp = 0;             ///< [N m^2]
  double rhoIp = 0;           ///< [kg m]
  StrainLaw law = StrainLaw::green;
  double damping = 0;  ///< Kelvin-Voigt time c [s], of bending and torsion
};

/// Two curvatures and the torsion [1/m].
template <class Real>
struct FrameStrain {
  Real y, z, torsion;
};

/// What an element of fixed length needs to know of itself: its shape functions in its middle and at two Gauss points,
/// three of which would lock where torsion is stiff, and its strains there at rest. r_x and r_xx need the columns of
/// r_B - r_A, s_A and s_B only. `Number` may be a Pack: four elements, then.
template <class Number>
struct FrameTableOf {
  struct Point {
    double u;
    Number weight;  ///< weight times length [m]
    std::array<Number, 3> s_x, s_xx;
    FrameStrain<Number> rest{Number(0), Number(0), Number(0)};

    double bump() const { return 4 * u * (1 - u); }
  };
  Number length;
  std::array<Number, 3> middle;
  std::array<Point, 2> points;
};

struct FrameTable : FrameTableOf<double> {
  FrameTable(double l, const Weights<double>& w);
};

}  // namespace vlbeam
