#pragma once

namespace vlbeam {

/// A method of integration of this folder.
enum class IntegrationMethod {
  dopri5,
  cash_karp,
  fehlberg78,
  bulirsch_stoer,
  adams_bashforth_moulton,
  rosenbrock4,
  generalized_alpha
};

/// How often a Newton iteration takes a new tangent.
enum class NewtonKind {
  modified,  ///< when the last one makes it converge too slowly
  full,      ///< at every iteration
};

/// What of the estimated error of a step limits its length.
enum class ErrorEstimate {
  all,
  filtered,  ///< without what the method damps by itself: vibrations whose period is shorter than the step
};

}  // namespace vlbeam
