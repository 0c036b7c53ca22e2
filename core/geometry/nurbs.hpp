#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "core/geometry/rational_cubic.hpp"

namespace vlbeam {

/// A NURBS curve of degree 1 to 3 over the domain [knots[degree], knots[points.size()]]; its knots need not be clamped.
template <int D>
struct Nurbs {
  int degree = 3;
  std::vector<double> knots;    ///< points.size() + degree + 1, not decreasing
  std::vector<double> weights;  ///< one a control point, > 0
  std::vector<Vec<double, D>> points;
};

/// What is wrong with a NURBS curve, and at which entry of `field`.
struct NurbsError : std::invalid_argument {
  NurbsError(std::string field_, std::size_t index_, const std::string& allowed)
      : std::invalid_argument(allowed), field(std::move(field_)), index(index_) {}
  std::string field;  ///< "knots", "weights" or "control_points"
  std::size_t index;
};

/// One polynomial piece of a NURBS curve, between two neighbouring distinct knots.
template <int D>
struct NurbsSpan {
  std::size_t knot;  ///< index of the last of the knots where it starts
  RationalCubic<double, D> curve;
  bool kinked = false;  ///< whether its tangent at the start is another than that of the span before at its end
};

/// The curve as rational cubics, one between any two neighbouring distinct knots of its domain, raised to degree 3.
/// Throws NurbsError for counts that do not fit, weights that are not positive, knots that decrease or of which more
/// than `degree` coincide inside (the curve is torn), a span of no length and an end of a span without direction.
template <int D>
std::vector<NurbsSpan<D>> rational_spans(const Nurbs<D>& curve);

extern template std::vector<NurbsSpan<2>> rational_spans(const Nurbs<2>&);
extern template std::vector<NurbsSpan<3>> rational_spans(const Nurbs<3>&);

}  // namespace vlbeam
