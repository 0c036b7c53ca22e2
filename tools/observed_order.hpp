#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/json.hpp"

namespace vlbeam {

// How an answer depends on the mesh or the step: orders where the error is known, limits and uncertainties where it is
// not. Both refuse to speak outside the asymptotic range. Levels are element counts (growing) or sizes and steps
// (shrinking), coarse to fine.

/// Which levels enter a fit. The study's data decide it, before any error is seen.
struct LevelRule {
  std::optional<double> coarsest = {};  ///< levels coarser than this one are left out
  std::optional<double> finest = {};    ///< and those finer than this one
  std::string reason = {};
};

/// Reads a rule, {"coarsest", "finest", "reason"}; null leaves out no level. Throws InvalidInput if it is not
/// understood, or has no reason.
LevelRule level_rule_from_json(const Json& json);
/// Reads the rule of one fit from a study's data, {"levels": {fit: rule}}. Without a rule no level is left out.
LevelRule level_rule_of(const Json& config, const std::string& fit);

struct OrderFitOptions {
  /// Uncertainty of the errors: rounding, or the error of the reference. The fit stops before the first error that is
  /// no larger. The uncertainty of each pair's order follows from it.
  double floor = 0;
  LevelRule rule = {};
};

/// How an error falls with refinement. Orders are positive where refining helps.
struct OrderFit {
  std::string quantity;
  std::vector<double> levels;              ///< coarse to fine, all that were run
  std::vector<double> errors;              ///< one a level
  double floor = 0;                        ///< as of the options
  std::size_t first = 0;                   ///< first level fitted; those before it are excluded by the rule
  std::size_t last = 0;                    ///< one past the last level fitted
  std::string excluded = {};               ///< the rule's reason, where it excludes levels
  std::vector<double> pairwise_orders;     ///< between neighbouring fitted levels: last - first - 1 of them
  std::vector<double> pair_uncertainties;  ///< of these, by what the errors are known to
  double slope = 0;                        ///< least squares over the fitted levels; NaN where they are too few
  /// Uncertainty of the slope: the larger of its standard error and of what the floor makes of it. NaN if the slope is.
  double slope_uncertainty = 0;
  /// Why these levels show no order: too few levels, an error that does not fall, or orders of pairs that differ by
  /// more than 0.5 (by more than a tenth of the order, if that is larger). Empty in the asymptotic range.
  std::string refusal = {};
};

/// Fits the observed order over all levels that the rule keeps and whose errors are above the floor. Levels must be
/// positive and strictly monotone, with one error each; throws std::invalid_argument otherwise.
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

struct GridConvergenceOptions {
  double expected_order = 0;  ///< by theory; 0 if theory has none: the safety factor then stays 3
  double floor = 0;           ///< rounding or temporal error of the values: differences below it say nothing
};

/// What solutions of one quantity on a sequence of meshes say about their limit, with error ~ h^order.
struct GridConvergence {
  std::string quantity;
  std::vector<double> levels;   ///< coarse to fine, all that were run
  std::vector<double> values;   ///< one a level
  std::optional<double> order;  ///< of the three finest; none where they are refused
  std::optional<double> limit;  ///< Richardson's extrapolation with it
  /// 1.25 if the order differs from the expected one by less than a tenth; with four levels or more, the order of the
  /// three levels before must do so, too. Else 3.
  double safety_factor = 3;
  /// Uncertainty of the finest value: the grid convergence index, safety factor times |finest - limit|. The order is
  /// taken no better than expected; the result is never less than the floor. Without a limit it is three times the
  /// largest difference among the three finest values. NaN with fewer than two levels.
  double uncertainty = 0;
  /// Why there is no limit: too few levels, an oscillation, differences that grow, an order far from the expected one
  /// (or 1.5 times it, and not seen in the three values before), or differences within the floor. Empty where there is
  /// one.
  std::string refusal = {};
};

/// Estimates the limit from values on at least three levels; two give an uncertainty only. Safety factors and the
/// limiting of the order follow Roache, and Oberkampf & Roy, *Verification and Validation in Scientific Computing*
/// (2010), section 8.7; three times the largest difference is Eca & Hoekstra's estimate outside the asymptotic range.
/// Throws as fit_order().
GridConvergence grid_convergence(std::string quantity, std::vector<double> levels, std::vector<double> values,
                                 const GridConvergenceOptions& options = {});

/// As reports hold them.
Json fit_to_json(const OrderFit& fit);
OrderFit fit_from_json(const Json& json);
Json grid_convergence_to_json(const GridConvergence& found);

}  // namespace vlbeam
