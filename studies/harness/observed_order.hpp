#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace vlbeam {

struct OrderFitOptions {
  double floor = 0;        ///< errors at or below it are roundoff: the fit stops before the first of them
  std::size_t fitted = 3;  ///< how many of the last levels above the floor the slope is fitted to, at least 2
};

/// How an error falls with refinement. Orders are positive where refining helps.
struct OrderFit {
  std::string quantity;
  std::vector<double> levels;           ///< coarse to fine: element counts (growing) or step sizes (shrinking)
  std::vector<double> errors;           ///< one a level
  std::size_t used = 0;                 ///< levels before the roundoff floor
  std::size_t fitted = 0;               ///< the last of the used levels, which the slope is fitted to
  std::vector<double> pairwise_orders;  ///< between neighbouring used levels: used - 1 of them
  double slope = 0;                     ///< least squares over the fitted levels; NaN where they are too few
};

/// Fits the observed order. Levels must be positive and strictly monotone, errors one a level; throws
/// std::invalid_argument otherwise. An error that is not a number ends the used levels and makes the slope NaN.
OrderFit fit_order(std::string quantity, std::vector<double> levels, std::vector<double> errors,
                   const OrderFitOptions& options = {});

/// What an observed order must satisfy, all of it at once; never the best of the pairs.
struct OrderRule {
  double expected = 0;      ///< the order p that theory states
  double tolerance = 0;     ///< slope and every fitted pair must be >= p - tolerance
  double at_most = 0;       ///< upper bound on the slope: an order too good is a cancellation or a wrong reference
  double finest_error = 0;  ///< upper bound on the error of the finest level
};

/// Why a fit breaks a rule, in words; empty where it holds.
std::string broken_order_rule(const OrderFit& fit, const OrderRule& rule);

/// What three solutions of one quantity say about their limit, with error ~ h^order.
struct SelfConvergence {
  double order = 0;
  double limit = 0;         ///< Richardson's extrapolation
  double finest_error = 0;  ///< |finest value - limit|
};

/// From values at three step sizes h, coarse to fine. Nothing where the differences do not shrink the way any order
/// between 0.1 and 20 makes them.
std::optional<SelfConvergence> self_convergence(const std::array<double, 3>& h, const std::array<double, 3>& values);

}  // namespace vlbeam
