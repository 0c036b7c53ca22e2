#pragma once

#include <memory>

#include "mechanics/time/stepper.hpp"

namespace vlbeam {

/// A stepper that measures every entry of the state in its absolute tolerance: `inner`, made for an absolute tolerance
/// of 1, then meets those of each kind, and what it compares with each other has one unit. So its digits are the same
/// in all units that differ by powers of two.
std::unique_ptr<Stepper> in_tolerances(std::unique_ptr<Stepper> inner, const FieldTolerances& tolerances);

}  // namespace vlbeam
