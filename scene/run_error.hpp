#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vlbeam {

/// How far one quantity of a run may be off: the largest estimate over the run, empty where nothing stood for it.
struct QuantityError {
  std::string quantity;  ///< "end", "joint 0", "mass 0", "shape", "winch start", "angles", "energy", ...
  std::string unit;
  std::optional<double> time, mesh;
};

/// What the companions of a run tell of it: runs of the same scene with longer steps, and on coarser meshes.
struct RunError {
  std::optional<double> time;  ///< of places [m], by the steps
  std::optional<double> mesh;  ///< of places [m], by the elements
  double allowed = 0;          ///< of `time`, by the accuracy asked [m]; 0 where none is asked
  double motion = 0;           ///< by which places move [m]
  double trusted_until = 0;    ///< `time` keeps to what is allowed, and `mesh` to 1 % of the motion, until then [s]
  int repeats = 0;             ///< how often the run was done again with a finer tolerance
  int elements_wanted = 0;     ///< that would bring `mesh` below 1 % of the motion; 0 where it is
  std::string no_time = {}, no_mesh = {};  ///< why there is no such estimate
  std::vector<QuantityError> quantities = {};
};

}  // namespace vlbeam
