#pragma once

#include "core/element/strain.hpp"

namespace vlbeam {

/// Stretch |r_x| of a straight beam of axial stiffness `EA` under the axial force `force` [N]:
/// F = EA (lambda^2 - 1) lambda/2 (green) or EA (lambda - 1) (engineering). Throws ModelError where there is none: a
/// green beam bears no compression beyond EA/(3 sqrt 3).
double stretch_under(double force, double EA, StrainLaw law = StrainLaw::green);

}  // namespace vlbeam
