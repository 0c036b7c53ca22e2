#pragma once

#include <string>
#include <vector>

#include "studies/harness/json.hpp"
#include "studies/harness/sample_quantities.hpp"

namespace vlbeam {

/// One number of a sample, by the name users give it: "joint_position", "end.y", "energy.kinetic"; or the name of its
/// column in the CSV file, "end_y".
struct Quantity {
  std::string name;    ///< with points
  std::string column;  ///< of the CSV file
  std::string unit;
  SampleQuantity sampled;
  std::size_t component = 0;  ///< of `sampled`

  /// NaN where it is not there.
  double of(const Sample& sample) const;
  /// Of all samples of a report, from its /samples. Throws InvalidInput where they lack it.
  std::vector<double> of(const Json& samples) const;
};

/// Those that the samples of a scene have, the time left out.
std::vector<Quantity> quantities(const Scene& scene);

/// The one of that name. Throws InvalidInput, of `option`, naming the nearest.
Quantity find_quantity(const Scene& scene, const std::string& name, const std::string& option = "--quantity");

}  // namespace vlbeam
