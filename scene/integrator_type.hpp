#pragma once

#include "mechanics/time/integration_method.hpp"

namespace vlbeam {

/// The methods that a scene may ask for.
enum class IntegratorType {
  dopri5,
  cash_karp,
  fehlberg78,
  bulirsch_stoer,
  adams_bashforth_moulton,
  rosenbrock4,
  generalized_alpha,
  energy_momentum,
  ida,
  cvode,
  arkode
};

/// Whether a method takes steps of one given length; the others choose it by their tolerances.
constexpr bool has_fixed_step(IntegratorType type) {
  return type == IntegratorType::adams_bashforth_moulton || type == IntegratorType::generalized_alpha ||
         type == IntegratorType::energy_momentum;
}

/// Whether a method is one of SUNDIALS, which a build may lack.
constexpr bool of_sundials(IntegratorType type) {
  return type == IntegratorType::ida || type == IntegratorType::cvode || type == IntegratorType::arkode;
}

}  // namespace vlbeam
