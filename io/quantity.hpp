#pragma once

#include <string>
#include <vector>

#include "io/json.hpp"
#include "scene/sample_quantities.hpp"

namespace vlbeam {

/// One number of a sample, by the name users give it: "joint_position", "end.y", "energy.kinetic"; or the name of its
/// column in the CSV file, "end_y".
struct Quantity {
  std::string name;    ///< with points
  std::string column;  ///< of the CSV file
  std::string unit;
  SampleQuantity sampled;
  std::size_t component = 0;           ///< of `sampled`
  double Extreme::*extreme = nullptr;  ///< or one of these, over all steps until the sample
  std::size_t number = 0;              ///< of all numbers of a sample, the time left out

  /// NaN where it is not there.
  double of(const Sample& sample) const;
  /// Of all samples of a report, from its /samples. Throws InvalidInput where they lack it.
  std::vector<double> of(const Json& samples) const;
};

/// Those that the samples of a scene have, the time left out.
std::vector<Quantity> quantities(const Scene& scene);

/// Whether a name asks for an extreme over time, which /output/extremes has to keep: "end.y.largest".
bool is_extreme(const std::string& name);

/// The scene, keeping the extremes that a quantity of that name needs.
Scene keeping(Scene scene, const std::string& name);

/// The one of that name; with ".largest", ".least", ".largest_at" or ".least_at" behind it over all steps. Throws
/// InvalidInput, of `option`, naming the nearest.
Quantity find_quantity(const Scene& scene, const std::string& name, const std::string& option = "--quantity");

}  // namespace vlbeam
