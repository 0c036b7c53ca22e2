#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/result.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

enum class SampleShape { number, vector, vectors };

/// One observed quantity of a run: the one table behind the samples of a report, the columns of its CSV file and the
/// schema of both.
struct SampleQuantity {
  std::string path;  ///< where it stands below /samples: "energy/kinetic"
  std::vector<std::string>
      columns;       ///< names in the CSV file, without unit: one a component; none: a part, maybe empty
  std::string unit;  ///< "-" for a pure number
  std::string description;
  SampleShape shape = SampleShape::number;
  std::size_t dimension = 1;  ///< components of each vector
  /// Writes the components, of which some may be no number; false where the quantity is not there.
  std::function<bool(const Sample&, double* components)> values;
};

/// Those that the samples of a scene have, in the order of the report.
std::vector<SampleQuantity> sample_quantities(const Scene& scene);

}  // namespace vlbeam
