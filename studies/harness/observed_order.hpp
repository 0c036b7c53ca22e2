#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "studies/harness/json.hpp"

namespace vlbeam {

// How an answer depends on the mesh or the step: orders where the error is known, limits and uncertainties where it is
// not. Both refuse to speak outside the asymptotic range. Levels are element counts (growing) or sizes and steps
// (shrinking), coarse to fine.

/// Which levels enter a fit, decided before any error is seen: it stands in the study's data.
struct LevelRule {
  std::optional<double> coarsest = {};  ///< levels coarser than this one are left out
  std::optional<double> finest = {};    ///< and those finer than this one
  std::string reason = {};
};

/// The rule of a study's data, {"coarsest", "finest", "reason"}; null is the rule that leaves out nothing. Throws
/// InvalidInput where it is not understood, or has no reason.
LevelRule level_rule_from_json(const Json& json);
/// That of a fit in a study's data, {"levels": {fit: rule}}; the rule that leaves out nothing where there is none.
LevelRule level_rule_of(const Json& config, const std::string& fit);

struct OrderFitOptions {
  /// What errors are known to: rounding, or the error of the reference. The fit stops before the first error that is
  /// not above it, and it makes the uncertainty of each pair's order.
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
  /// Of the slope: its standard error, or what the floor makes of it, whichever is larger. NaN as the slope.
  double slope_uncertainty = 0;
  /// Why these levels show no order: too few of them, an error that does not fall, or pairs farther apart than a half
  /// (a tenth of the order, where that is more). Empty in the asymptotic range.
  std::string refusal = {};
};

/// Fits the observed order over all levels above the floor that the rule leaves in. Levels must be positive and
/// strictly monotone, errors one a level; throws std::invalid_argument otherwise.
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
  double expected_order = 0;  ///< of the theory; 0 where there is none: the safety factor then stays 3
  double floor = 0;           ///< rounding or temporal error of the values: differences below it say nothing
};

/// What solutions of one quantity on a sequence of meshes say about their limit, with error ~ h^order.
struct GridConvergence {
  std::string quantity;
  std::vector<double> levels;   ///< coarse to fine, all that were run
  std::vector<double> values;   ///< one a level
  std::optional<double> order;  ///< of the three finest; none where they are refused
  std::optional<double> limit;  ///< Richardson's extrapolation with it
  /// 1.25 where the order is within a tenth of the expected one, and, with four levels or more, that of the three
  /// levels before is so too; else 3.
  double safety_factor = 3;
  /// Of the finest value: the grid convergence index, safety factor times |finest - limit| with an order that is taken
  /// no better than expected, and never less than the floor. Where no limit can be given, three times the largest
  /// difference among the three finest values. NaN below two levels.
  double uncertainty = 0;
  /// Why there is no limit: too few levels, an oscillation, differences that grow, orders far apart, or differences
  /// within the floor. Empty where there is one.
  std::string refusal = {};
};

/// From the values on at least two levels; the limit needs three. Safety factors and the limiting of the order follow
/// Roache, and Oberkampf & Roy, *Verification and Validation in Scientific Computing* (2010), section 8.7; three times
/// the largest difference is Eca & Hoekstra's estimate outside the asymptotic range. Throws as fit_order().
GridConvergence grid_convergence(std::string quantity, std::vector<double> levels, std::vector<double> values,
                                 const GridConvergenceOptions& options = {});

/// As reports hold them.
Json fit_to_json(const OrderFit& fit);
OrderFit fit_from_json(const Json& json);
Json grid_convergence_to_json(const GridConvergence& found);

}  // namespace vlbeam
