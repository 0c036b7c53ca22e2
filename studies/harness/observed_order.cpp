#include "studies/harness/observed_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace vlbeam {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void check_levels(const std::vector<double>& levels, const std::vector<double>& errors) {
  if (levels.size() != errors.size()) throw std::invalid_argument("an observed order needs one error a level");
  const auto positive = [](double level) { return std::isfinite(level) && level > 0; };
  const bool growing = std::ranges::adjacent_find(levels, std::ranges::greater_equal{}) == levels.end();
  const bool shrinking = std::ranges::adjacent_find(levels, std::ranges::less_equal{}) == levels.end();
  if (!std::ranges::all_of(levels, positive) || (!growing && !shrinking)) {
    throw std::invalid_argument("levels of an observed order must be positive and strictly monotone, coarse to fine");
  }
}

/// Slope of log(error) over -|log(level)|: refinement counts as progress whichever way the level is measured.
double least_squares_slope(const OrderFit& fit) {
  const std::size_t first = fit.used - fit.fitted;
  const double sign = fit.levels.front() > fit.levels.back() ? 1 : -1;
  double x_mean = 0;
  double y_mean = 0;
  for (std::size_t i = first; i < fit.used; ++i) {
    x_mean += sign * std::log(fit.levels[i]) / static_cast<double>(fit.fitted);
    y_mean += std::log(fit.errors[i]) / static_cast<double>(fit.fitted);
  }
  double xy = 0;
  double xx = 0;
  for (std::size_t i = first; i < fit.used; ++i) {
    const double x = sign * std::log(fit.levels[i]) - x_mean;
    xy += x * (std::log(fit.errors[i]) - y_mean);
    xx += x * x;
  }
  return xy / xx;
}

}  // namespace

OrderFit fit_order(std::string quantity, std::vector<double> levels, std::vector<double> errors,
                   const OrderFitOptions& options) {
  check_levels(levels, errors);
  if (options.fitted < 2) throw std::invalid_argument("a slope needs at least 2 levels");
  OrderFit fit;
  fit.quantity = std::move(quantity);
  fit.levels = std::move(levels);
  fit.errors = std::move(errors);

  const auto measurable = [&](double error) { return std::isfinite(error) && error > std::max(options.floor, 0.0); };
  fit.used = static_cast<std::size_t>(std::ranges::find_if_not(fit.errors, measurable) - fit.errors.begin());
  fit.fitted = options.fitted;
  for (std::size_t i = 1; i < fit.used; ++i) {
    fit.pairwise_orders.push_back(std::log(fit.errors[i - 1] / fit.errors[i]) /
                                  std::abs(std::log(fit.levels[i] / fit.levels[i - 1])));
  }
  const bool all_numbers = std::ranges::all_of(fit.errors, [](double error) { return std::isfinite(error); });
  fit.slope = all_numbers && fit.used >= fit.fitted ? least_squares_slope(fit) : nan;
  return fit;
}

std::string broken_order_rule(const OrderFit& fit, const OrderRule& rule) {
  std::ostringstream why;
  const auto broken = [&why]() -> std::ostream& { return why << (why.tellp() > 0 ? "; " : ""); };
  const double least = rule.expected - rule.tolerance;
  if (fit.used < fit.fitted) {
    broken() << "only " << fit.used << " levels above the roundoff floor, " << fit.fitted << " are needed";
  } else {
    // Negated comparisons, so that NaN breaks every rule.
    if (!(fit.slope >= least)) broken() << "slope " << fit.slope << " < " << least;
    if (!(fit.slope <= rule.at_most)) broken() << "slope " << fit.slope << " > " << rule.at_most;
    for (std::size_t i = fit.pairwise_orders.size() - (fit.fitted - 1); i < fit.pairwise_orders.size(); ++i) {
      const double order = fit.pairwise_orders[i];
      if (!(order >= least)) {
        broken() << "order " << order << " < " << least << " between levels " << fit.levels[i] << " and "
                 << fit.levels[i + 1];
      }
    }
  }
  if (fit.errors.empty()) {
    broken() << "no errors";
  } else if (!(fit.errors.back() <= rule.finest_error)) {
    broken() << "finest error " << fit.errors.back() << " > " << rule.finest_error;
  }
  return why.str();
}

std::optional<SelfConvergence> self_convergence(const std::array<double, 3>& h, const std::array<double, 3>& values) {
  if (!(h[0] > h[1] && h[1] > h[2] && h[2] > 0)) throw std::invalid_argument("step sizes must shrink, coarse to fine");
  const double observed = (values[0] - values[1]) / (values[1] - values[2]);
  // The ratio an order p would show; it grows with p.
  const auto ratio = [&h](double p) {
    return (std::pow(h[0] / h[2], p) - std::pow(h[1] / h[2], p)) / (std::pow(h[1] / h[2], p) - 1);
  };
  double low = 0.1;
  double high = 20;
  if (!(observed >= ratio(low) && observed <= ratio(high))) return std::nullopt;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (ratio(middle) < observed ? low : high) = middle;
  }
  const double order = (low + high) / 2;
  const double limit = values[2] - (values[1] - values[2]) / (std::pow(h[1] / h[2], order) - 1);
  return SelfConvergence{.order = order, .limit = limit, .finest_error = std::abs(values[2] - limit)};
}

}  // namespace vlbeam
