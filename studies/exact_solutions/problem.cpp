#include "studies/exact_solutions/problem.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace vlbeam::exact_solutions {

const Json& References::of(const std::string& name) const {
  for (const Json& item : file_.at("cases")) {
    if (item.at("case") == name) return item;
  }
  throw InvalidInput("/cases", name, "a case of reference/exact/exact.json");
}

Known References::known(const std::string& name, const std::vector<std::string>& keys, std::size_t most) const {
  const Json& item = of(name);
  Known known;
  for (const std::string& key : keys) {
    const Json& value = item.at("values").at(key);
    const double error = item.at("error").at(key);
    const std::size_t members = value.is_array() ? std::min(most, value.size()) : 1;
    for (std::size_t i = 0; i < members; ++i) {
      known.names.push_back(value.is_array() ? key + " " + std::to_string(i + 1) : key);
      known.values.push_back(value.is_array() ? value[i] : value);
      known.errors.push_back(error);
    }
  }
  return known;
}

void judge_in_motion(Problem& problem, const FamilyData& data, double cost) {
  problem.steps = true;
  problem.order = data.number("order");
  problem.floor = data.number("floor");
  problem.cost = cost;
}

}  // namespace vlbeam::exact_solutions
