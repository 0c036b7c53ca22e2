#include "io/quantity.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "core/error.hpp"
#include "io/json.hpp"
#include "io/nearest.hpp"

namespace vlbeam {
namespace {

struct Suffix {
  const char* text;
  double Extreme::*member;
  bool is_time;
};
constexpr std::array<Suffix, 4> suffixes{{{".largest", &Extreme::largest, false},
                                          {".least", &Extreme::least, false},
                                          {".largest_at", &Extreme::at_largest, true},
                                          {".least_at", &Extreme::at_least, true}}};

const Suffix* suffix_of(const std::string& name) {
  const auto found = std::ranges::find_if(suffixes, [&](const Suffix& suffix) { return name.ends_with(suffix.text); });
  return found == suffixes.end() ? nullptr : &*found;
}

}  // namespace

bool is_extreme(const std::string& name) { return suffix_of(name) != nullptr; }

Scene keeping(Scene scene, const std::string& name) {
  if (is_extreme(name)) scene.output.extremes = true;
  return scene;
}

double Quantity::of(const Sample& sample) const {
  if (extreme != nullptr) return sample.extremes ? (*sample.extremes)[number].*extreme : nan;
  std::vector<double> components(sampled.columns.size());
  return sampled.values(sample, components.data()) ? components[component] : nan;
}

std::vector<double> Quantity::of(const Json& samples) const {
  if (extreme != nullptr) {
    throw InvalidInput(name, "over time", "samples have values; extremes over time stand in the report's /extremes");
  }
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
      all.push_back({name, column, sampled.unit, sampled, i, nullptr, all.size()});
    }
  }
  return all;
}

Quantity find_quantity(const Scene& scene, const std::string& name, const std::string& option) {
  if (const Suffix* const suffix = suffix_of(name)) {
    Quantity quantity = find_quantity(scene, name.substr(0, name.size() - std::strlen(suffix->text)), option);
    if (!scene.output.extremes) {
      throw InvalidInput(option, "\"" + name + "\"", "extremes over time need \"extremes\": true in /output");
    }
    quantity.extreme = suffix->member;
    quantity.name += suffix->text;
    quantity.column += "_" + std::string(suffix->text).substr(1);
    if (suffix->is_time) quantity.unit = "s";
    return quantity;
  }
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
