#include "tools/judged.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "io/json.hpp"
#include "tools/measures.hpp"

namespace vlbeam {

double Judged::error(const Sample& sample) const {
  constexpr double lacks = std::numeric_limits<double>::quiet_NaN();
  double largest = end ? distance(*end, sample.end) : 0;
  if (joint) {
    if (!sample.joint_position) return lacks;
    largest = std::max(largest, std::abs(*joint - *sample.joint_position));
  }
  if (mass) {
    if (!sample.mass_position) return lacks;
    largest = std::max(largest, distance(*mass, *sample.mass_position));
  }
  return largest;
}

Judged judged_at(const std::filesystem::path& studies, const std::string& name, std::optional<double> t) {
  const Json answers = read_json(studies.parent_path() / "reference" / "judge" / "judge.json").at("cases");
  const auto found = std::ranges::find_if(answers, [&](const Json& one) { return one.at("case") == name; });
  if (found == answers.end()) throw InvalidInput("/cases", name, "a case of reference/judge/judge.json");
  const auto times = found->at("t").get<std::vector<double>>();
  const double at = t.value_or(times.back());
  const auto time = std::ranges::find_if(times, [at](double known) { return std::abs(known - at) < 1e-9; });
  if (time == times.end()) throw InvalidInput("/t", std::to_string(at), "a time of the judge's case " + name);
  const auto index = static_cast<std::size_t>(time - times.begin());
  Judged judged;
  judged.t = *time;
  const auto number = [&](const std::string& quantity) -> std::optional<double> {
    const auto known = found->at("quantities").find(quantity);
    if (known == found->at("quantities").end()) return std::nullopt;
    judged.uncertainty = std::max(judged.uncertainty, known->at("uncertainty").at(index).get<double>());
    return known->at("value").at(index).get<double>();
  };
  const auto point = [&](const std::string& quantity) -> std::optional<Point> {
    const auto x = number(quantity + ".x"), y = number(quantity + ".y");
    if (!x || !y) return std::nullopt;
    return Point{*x, *y, number(quantity + ".z").value_or(0)};
  };
  judged.joint = number("joint_position");
  judged.mass = point("mass_position");
  judged.end = point("end");
  return judged;
}

}  // namespace vlbeam
