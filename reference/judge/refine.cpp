#include "refine.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <future>

#include "motion.hpp"

namespace judge {
namespace {

using nlohmann::json;
using Ordered = nlohmann::ordered_json;

double difference(const Motion& a, const Motion& b, std::size_t row, std::size_t column) {
  return std::abs(a.values[row][column] - b.values[row][column]);
}

/// Rounded to the digits that an uncertainty leaves, two of its own.
double rounded(double value, double uncertainty) {
  if (uncertainty <= 0) return value;
  const double unit = std::pow(10.0, std::floor(std::log10(uncertainty)) - 1);
  char text[40];
  std::snprintf(text, sizeof text, "%.*e", std::max(0, static_cast<int>(std::log10(std::abs(value) / unit + 1) + 1)),
                std::round(value / unit) * unit);
  return std::stod(text);
}

double two_digits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.1e", value);
  return std::stod(text);
}

/// What degrees leave: the last step of refinement times what a geometric series adds, twice that for safety; all of it
/// of the largest differences up to the time, for differences change their sign.
double by_degree(double before, double last) {
  if (last <= 0) return 0;
  const double ratio = before > 0 ? last / before : 1;
  return ratio < 0.8 ? 2 * last * std::max(1.0, ratio / (1 - ratio)) : 8 * last;
}

}  // namespace

Ordered refine(const json& item) {
  const json& scene = item.at("scene");
  const auto degrees = item.at("degrees").get<std::vector<std::vector<int>>>();
  const auto times = item.at("times").get<std::vector<double>>();
  const double tolerance = item.value("tolerance", 1e-11), points = item.value("points_per_degree", 1.5);
  const auto between = item.value("marks", std::vector<double>());
  const std::size_t k = degrees.size();
  const auto run = [&](const std::vector<int>& p, double per_degree, double within, Method method) {
    return move(scene, {p, per_degree, within, method, between}, times);
  };
  // The finest beside the rest: two threads.
  auto finest =
      std::async(std::launch::async, [&] { return run(degrees[k - 1], points, tolerance, Method::fehlberg78); });
  std::vector<Motion> by_p;
  for (std::size_t i = 0; i + 1 < k; ++i) by_p.push_back(run(degrees[i], points, tolerance, Method::fehlberg78));
  const std::vector<int>& coarsest = degrees.front();
  const Motion loose = run(coarsest, points, 100 * tolerance, Method::fehlberg78);
  const Motion other = run(coarsest, points, tolerance, Method::bulirsch_stoer);
  const Motion rule = run(coarsest, 2 * points, tolerance, Method::fehlberg78);
  by_p.push_back(finest.get());

  const Motion& answer = by_p[k - 1];
  double seconds = loose.seconds + other.seconds + rule.seconds;
  Ordered result = {{"case", item.at("case")}, {"what", item.at("what")}, {"length", answer.length}, {"t", times}};
  Ordered quantities, study;
  double worst = 0;
  std::vector<std::vector<double>> values(answer.names.size()), uncertainties(answer.names.size());
  // Of places together, and of energies together: differences of one of them pass through zero.
  for (const bool energies : {false, true}) {
    std::vector<std::size_t> group;
    for (std::size_t q = 0; q < answer.names.size(); ++q) {
      if ((answer.names[q].rfind("energy", 0) == 0) == energies) group.push_back(q);
    }
    double before = 0, last = 0, in_time = 0, in_rule = 0;
    for (std::size_t row = 0; row < times.size(); ++row) {
      for (const std::size_t q : group) {
        before = std::max(before, difference(by_p[k - 3], by_p[k - 2], row, q));
        last = std::max(last, difference(by_p[k - 2], answer, row, q));
        in_time = std::max({in_time, difference(loose, by_p[0], row, q), difference(other, by_p[0], row, q)});
        in_rule = std::max(in_rule, difference(rule, by_p[0], row, q));
      }
      // Points follow the degree: what they leave is in the differences of the finer degrees already.
      const double uncertainty = by_degree(before, last) + in_time;
      for (const std::size_t q : group) {
        const double exact = answer.values[row][q], rounding = 1e-14 * std::max(1.0, std::abs(exact));
        const double value = rounded(exact, two_digits(uncertainty + rounding));
        const double stated = two_digits(uncertainty + rounding + std::abs(value - exact));
        values[q].push_back(value);
        uncertainties[q].push_back(stated);
        if (!energies) worst = std::max(worst, stated);
      }
    }
    study[energies ? "energies" : "places"] = {{"degrees", {two_digits(before), two_digits(last)}},
                                               {"tolerance_and_method", two_digits(in_time)},
                                               {"points", two_digits(in_rule)}};
  }
  for (std::size_t q = 0; q < answer.names.size(); ++q) {
    quantities[answer.names[q]] = {{"value", values[q]}, {"uncertainty", uncertainties[q]}};
  }
  Ordered levels;
  for (std::size_t i = 0; i < k; ++i) {
    levels.push_back({{"degrees", degrees[i]}, {"unknowns", by_p[i].unknowns}});
    seconds += by_p[i].seconds;
  }
  result["quantities"] = quantities;
  result["largest_uncertainty_of_a_position"] = worst;
  result["differences"] = study;
  if (item.value("conserved", false)) {
    double drift = 0;
    for (const Motion& motion : by_p) drift = std::max(drift, motion.energy_drift);
    result["energy_drift"] = two_digits(drift);
  }
  if (!between.empty()) result["marks"] = between;
  result["tolerance"] = tolerance;
  result["levels"] = levels;
  std::fprintf(stderr, "%s: positions to %.1e m, %zu steps, %.0f s of work\n",
               item.at("case").get<std::string>().c_str(), worst, answer.steps, seconds);
  return result;
}

}  // namespace judge
