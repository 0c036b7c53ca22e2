#include "studies/harness/quantity.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "studies/harness/json.hpp"
#include "studies/harness/nearest.hpp"

namespace vlbeam {
namespace {}  // namespace

double Quantity::of(const Sample& sample) const {
  std::vector<double> components(sampled.columns.size());
  return sampled.values(sample, components.data()) ? components[component] : nan;
}

std::vector<double> Quantity::of(const Json& samples) const {
  const Json::json_pointer where("/" + sampled.path);
  if (!samples.contains(where))
    throw InvalidInput("/samples/" + sampled.path, InvalidInput::missing, "the report lacks it");
  std::vector<double> values;
  for (const Json& entry : samples.at(where)) {
    const auto part = [](const Json& list, std::size_t i) -> const Json& {
      static const Json nothing;
      return list.is_array() && i < list.size() ? list[i] : nothing;
    };
    if (sampled.shape == SampleShape::number) {
      values.push_back(number_or_nan(entry));
    } else if (sampled.shape == SampleShape::vector) {
      values.push_back(number_or_nan(part(entry, component)));
    } else {
      values.push_back(number_or_nan(part(part(entry, component / sampled.dimension), component % sampled.dimension)));
    }
  }
  return values;
}

std::vector<Quantity> quantities(const Scene& scene) {
  std::vector<Quantity> all;
  for (const SampleQuantity& sampled : sample_quantities(scene)) {
    if (sampled.path == "t") continue;
    std::string path = sampled.path;
    std::ranges::replace(path, '/', '.');
    for (std::size_t i = 0; i < sampled.columns.size(); ++i) {
      const std::string& column = sampled.columns[i];
      std::string name = column;
      if (sampled.columns.size() == 1) {
        name = path;
      } else if (sampled.shape == SampleShape::vector && column.size() > 2 && column[column.size() - 2] == '_') {
        name = path + "." + column.back();
      }
      all.push_back({name, column, sampled.unit, sampled, i});
    }
  }
  return all;
}

Quantity find_quantity(const Scene& scene, const std::string& name, const std::string& option) {
  const std::vector<Quantity> all = quantities(scene);
  std::vector<std::string> known;
  for (const Quantity& quantity : all) {
    if (quantity.name == name || quantity.column == name) return quantity;
    known.push_back(quantity.name);
  }
  throw InvalidInput(
      option, "\"" + name + "\"",
      "the nearest known quantity is \"" + nearest_of(name, known) + "\" (known here: " + quoted_list(known) + ")");
}

}  // namespace vlbeam
