#include "tools/observed_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "io/json.hpp"
#include "scene/options.hpp"

namespace vlbeam {
namespace {

constexpr double pairs_apart = 0.5, pairs_apart_share = 0.1;  // of orders that are still one order
constexpr double least_order = 0.1, largest_order = 20;       // a limit is looked for between these
constexpr double near_safety = 1.25, far_safety = 3, near_share = 0.1;
// Of the expected order: a higher one must be seen twice, for a difference that is small by chance looks like one.
constexpr double seen_once = 1.5;

void check_levels(const std::vector<double>& levels, const std::vector<double>& values) {
  if (levels.size() != values.size()) throw std::invalid_argument("an observed order needs one error a level");
  const auto positive = [](double level) { return std::isfinite(level) && level > 0; };
  const bool growing = std::ranges::adjacent_find(levels, std::ranges::greater_equal{}) == levels.end();
  const bool shrinking = std::ranges::adjacent_find(levels, std::ranges::less_equal{}) == levels.end();
  if (!std::ranges::all_of(levels, positive) || (!growing && !shrinking)) {
    throw std::invalid_argument("levels of an observed order must be positive and strictly monotone, coarse to fine");
  }
}

/// Mesh sizes up to a factor, shrinking, whichever way the level is measured.
std::vector<double> sizes_of(const std::vector<double>& levels) {
  std::vector<double> sizes = levels;
  if (levels.size() > 1 && levels.front() < levels.back()) {
    for (double& size : sizes) size = 1 / size;
  }
  return sizes;
}

/// Slope of log(error) over log(size), and its standard error.
std::array<double, 2> least_squares(const OrderFit& fit, const std::vector<double>& sizes) {
  const auto n = static_cast<double>(fit.last - fit.first);
  double x_mean = 0, y_mean = 0;
  for (std::size_t i = fit.first; i < fit.last; ++i) {
    x_mean += portable::log(sizes[i]) / n;
    y_mean += portable::log(fit.errors[i]) / n;
  }
  double xy = 0, xx = 0;
  for (std::size_t i = fit.first; i < fit.last; ++i) {
    const double x = portable::log(sizes[i]) - x_mean;
    xy += x * (portable::log(fit.errors[i]) - y_mean);
    xx += x * x;
  }
  const double slope = xy / xx;
  double residuals = 0;
  for (std::size_t i = fit.first; i < fit.last; ++i) {
    const double r = portable::log(fit.errors[i]) - y_mean - slope * (portable::log(sizes[i]) - x_mean);
    residuals += r * r;
  }
  return {slope, n > 2 ? std::sqrt(residuals / (n - 2) / xx) : 0};
}

/// Why the fitted levels show no order.
std::string refusal_of(const OrderFit& fit) {
  if (fit.last - fit.first < 3) return "fewer than three levels to fit, above the floor and within the rule";
  const auto [least, most] = std::ranges::minmax(fit.pairwise_orders);
  if (least <= 0) return "the error does not fall at every level";
  if (most - least > std::max(pairs_apart, pairs_apart_share * most)) {
    return "the orders of pairs, " + number_text(least) + " to " + number_text(most) + ", are far apart";
  }
  return "";
}

/// The order that three values show, nothing where their differences do not shrink the way any order makes them.
std::optional<double> order_of(std::span<const double, 3> h, std::span<const double, 3> values) {
  const double observed = (values[0] - values[1]) / (values[1] - values[2]);
  // The ratio an order p would show; it grows with p.
  const auto ratio = [&h](double p) {
    return (portable::pow(h[0] / h[2], p) - portable::pow(h[1] / h[2], p)) / (portable::pow(h[1] / h[2], p) - 1);
  };
  double low = least_order, high = largest_order;
  if (!(observed >= ratio(low) && observed <= ratio(high))) return std::nullopt;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (ratio(middle) < observed ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

LevelRule level_rule_from_json(const Json& json) {
  LevelRule rule;
  if (json.is_null()) return rule;
  const auto refuse = [&](const std::string& key, const std::string& why) {
    throw InvalidInput("/" + key, excerpt(json), why);
  };
  if (!json.is_object()) refuse("", "a rule of levels must be an object");
  for (const auto& [key, value] : json.items()) {
    if (key == "reason") {
      if (!value.is_string()) refuse(key, "it must be a string");
      rule.reason = value.get<std::string>();
    } else if (key == "coarsest" || key == "finest") {
      if (!value.is_number()) refuse(key, "it must be a number");
      (key == "finest" ? rule.finest : rule.coarsest) = value.get<double>();
    } else {
      refuse(key, "known here: \"coarsest\", \"finest\", \"reason\"");
    }
  }
  if (rule.reason.empty()) refuse("reason", "levels are left out for a reason");
  return rule;
}

LevelRule level_rule_of(const Json& config, const std::string& fit) {
  return level_rule_from_json(config.value("levels", Json::object()).value(fit, Json()));
}

OrderFit fit_order(std::string quantity, std::vector<double> levels, std::vector<double> errors,
                   const OrderFitOptions& options) {
  check_levels(levels, errors);
  OrderFit fit;
  fit.quantity = std::move(quantity);
  fit.levels = std::move(levels);
  fit.errors = std::move(errors);
  fit.floor = std::max(options.floor, 0.0);
  const std::vector<double> sizes = sizes_of(fit.levels);
  const bool growing = fit.levels.size() > 1 && fit.levels.front() < fit.levels.back();
  const auto coarser = [growing](double a, double b) { return growing ? a < b : a > b; };

  const std::size_t n = fit.levels.size();
  const LevelRule& rule = options.rule;
  while (fit.first < n && rule.coarsest && coarser(fit.levels[fit.first], *rule.coarsest)) ++fit.first;
  fit.last = fit.first;
  bool all_numbers = true;
  const auto allowed = [&](std::size_t i) { return !rule.finest || !coarser(*rule.finest, fit.levels[i]); };
  while (fit.last < n && allowed(fit.last) && fit.errors[fit.last] > fit.floor && std::isfinite(fit.errors[fit.last])) {
    ++fit.last;
  }
  std::size_t within = fit.first;
  for (; within < n && allowed(within); ++within) all_numbers = all_numbers && std::isfinite(fit.errors[within]);
  if (fit.first > 0 || within < n) fit.excluded = rule.reason;

  for (std::size_t i = fit.first + 1; i < fit.last; ++i) {
    const double refinement = portable::log(sizes[i - 1] / sizes[i]);
    fit.pairwise_orders.push_back(portable::log(fit.errors[i - 1] / fit.errors[i]) / refinement);
    fit.pair_uncertainties.push_back(fit.floor * (1 / fit.errors[i - 1] + 1 / fit.errors[i]) / refinement);
  }
  fit.refusal = all_numbers ? refusal_of(fit) : "an error is not a number";
  fit.slope = fit.slope_uncertainty = nan;
  if (all_numbers && fit.last - fit.first >= 2) {
    const auto [slope, standard_error] = least_squares(fit, sizes);
    fit.slope = slope;
    const double range = portable::log(sizes[fit.first] / sizes[fit.last - 1]);
    const double known_to = fit.floor * (1 / fit.errors[fit.first] + 1 / fit.errors[fit.last - 1]) / range;
    fit.slope_uncertainty = std::max(standard_error, known_to);
  }
  return fit;
}

std::string broken_order_rule(const OrderFit& fit, const OrderRule& rule) {
  std::ostringstream why;
  const auto broken = [&why]() -> std::ostream& { return why << (why.tellp() > 0 ? "; " : ""); };
  const double least = rule.expected - rule.tolerance;
  if (!fit.refusal.empty()) broken() << fit.refusal;
  // Negated comparisons, so that NaN breaks every rule.
  if (!(fit.slope >= least)) broken() << "slope " << fit.slope << " < " << least;
  if (!(fit.slope <= rule.at_most)) broken() << "slope " << fit.slope << " > " << rule.at_most;
  for (std::size_t i = 0; i < fit.pairwise_orders.size(); ++i) {
    const double order = fit.pairwise_orders[i];
    if (!(order >= least)) {
      broken() << "order " << order << " < " << least << " between levels " << fit.levels[fit.first + i] << " and "
               << fit.levels[fit.first + i + 1];
    }
  }
  if (fit.errors.empty()) {
    broken() << "no errors";
  } else if (!(fit.errors.back() <= rule.finest_error)) {
    broken() << "finest error " << fit.errors.back() << " > " << rule.finest_error;
  }
  return why.str();
}

GridConvergence grid_convergence(std::string quantity, std::vector<double> levels, std::vector<double> values,
                                 const GridConvergenceOptions& options) {
  check_levels(levels, values);
  GridConvergence found;
  found.quantity = std::move(quantity);
  found.levels = std::move(levels);
  found.values = std::move(values);
  const double floor = std::max(options.floor, 0.0);
  const std::vector<double> h = sizes_of(found.levels);
  const std::vector<double>& f = found.values;
  const std::size_t n = f.size();
  if (n < 2 || !std::ranges::all_of(f, [](double value) { return std::isfinite(value); })) {
    found.refusal = n < 2 ? "fewer than three levels" : "a value is not a number";
    found.uncertainty = nan;
    return found;
  }
  const std::size_t from = n >= 3 ? n - 3 : 0;
  const auto [least, most] = std::minmax_element(f.begin() + static_cast<std::ptrdiff_t>(from), f.end());
  found.uncertainty = std::max(far_safety * (*most - *least), floor);
  if (n < 3) {
    found.refusal = "fewer than three levels";
    return found;
  }
  const double before = f[n - 3] - f[n - 2], last = f[n - 2] - f[n - 1];
  if (std::abs(last) <= floor) {
    found.refusal = "the finest values differ by no more than the floor";
    if (std::abs(before) <= floor) found.uncertainty = std::max(floor, far_safety * std::abs(last));
    return found;
  }
  if (before * last < 0) {
    found.refusal = "the values oscillate";
    return found;
  }
  const auto triple = [&](std::size_t i) {
    return order_of(std::span<const double, 3>(&h[i], 3), std::span<const double, 3>(&f[i], 3));
  };
  const auto order = triple(n - 3);
  if (!order) {
    found.refusal =
        std::abs(last) >= std::abs(before) ? "the differences do not shrink" : "no order between 0.1 and 20";
    return found;
  }
  const double expected = options.expected_order;
  const auto near_expected = [&](double p) { return expected > 0 && std::abs(p - expected) <= near_share * expected; };
  const double coarser = n >= 4 ? triple(n - 4).value_or(0) : 0;  // 0: not known
  const bool near = near_expected(*order) && (n < 4 || near_expected(coarser));
  if (expected > 0 && (*order < expected / 2 || *order > 2 * expected)) {
    found.refusal = "the order " + six_digits(*order) + " is far from the expected " + number_text(expected);
    return found;
  }
  const double believed = seen_once * expected;
  if (expected > 0 && *order > believed && coarser <= believed) {
    found.refusal = "the order " + six_digits(*order) + ", far better than the expected " + number_text(expected) +
                    ", is seen in three values alone";
    return found;
  }
  found.order = *order;
  found.limit = f[n - 1] - last / (portable::pow(h[n - 2] / h[n - 1], *order) - 1);
  found.safety_factor = near ? near_safety : far_safety;
  const double no_better = expected > 0 ? std::min(*order, expected) : *order;
  found.uncertainty =
      std::max(found.safety_factor * std::abs(last) / (portable::pow(h[n - 2] / h[n - 1], no_better) - 1), floor);
  return found;
}

Json fit_to_json(const OrderFit& fit) {
  Json json = {{"quantity", fit.quantity},
               {"levels", fit.levels},
               {"errors", fit.errors},
               {"errors_known_to", fit.floor},
               {"fitted_from", fit.first},
               {"fitted_to", fit.last},
               {"pairwise_orders", fit.pairwise_orders},
               {"pair_uncertainties", fit.pair_uncertainties},
               {"slope", number_or_null(fit.slope)},
               {"slope_uncertainty", number_or_null(fit.slope_uncertainty)}};
  if (!fit.excluded.empty()) json["excluded"] = fit.excluded;
  if (!fit.refusal.empty()) json["refusal"] = fit.refusal;
  return json;
}

OrderFit fit_from_json(const Json& json) {
  OrderFit fit;
  fit.quantity = json.value("quantity", "");
  const auto numbers = [&](const char* key) {
    std::vector<double> list;
    for (const Json& value : json.at(key)) list.push_back(number_or_nan(value));
    return list;
  };
  fit.levels = numbers("levels");
  fit.errors = numbers("errors");
  fit.floor = number_or_nan(json.at("errors_known_to"));
  fit.first = json.at("fitted_from").get<std::size_t>();
  fit.last = json.at("fitted_to").get<std::size_t>();
  fit.pairwise_orders = numbers("pairwise_orders");
  fit.pair_uncertainties = numbers("pair_uncertainties");
  fit.slope = number_or_nan(json.at("slope"));
  fit.slope_uncertainty = number_or_nan(json.at("slope_uncertainty"));
  fit.excluded = json.value("excluded", "");
  fit.refusal = json.value("refusal", "");
  return fit;
}

Json grid_convergence_to_json(const GridConvergence& found) {
  Json json = {{"quantity", found.quantity},
               {"levels", found.levels},
               {"values", found.values},
               {"order", found.order ? Json(*found.order) : Json()},
               {"limit", found.limit ? Json(*found.limit) : Json()},
               {"safety_factor", found.safety_factor},
               {"uncertainty", number_or_null(found.uncertainty)}};
  if (!found.refusal.empty()) json["refusal"] = found.refusal;
  return json;
}

}  // namespace vlbeam
