#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace vlbeam {

/// A sample or an event of an integration: what the equations are told of the solution.
struct LoggedEvent {
  int guard = -1;              ///< index of the guard that has turned positive; -1 of a sample
  double t = 0;                ///< [s]
  Eigen::VectorXd y;           ///< before the event
  std::vector<double> system;  ///< what the equations remembered beside it
};

/// All that an integration needs in order to go on with the same digits. The equations come to where they were by being
/// told all that has happened once more: nothing of theirs, neither meshes nor results, is in here but by this.
struct Checkpoint {
  std::vector<LoggedEvent> past;
  double t = 0;  ///< [s]
  Eigen::VectorXd y;
  std::vector<double> system;  ///< what the equations remember
  std::vector<double> method;  ///< what the integration, and its steppers, do
  double seconds = 0;          ///< wall time it took to get there
};

/// Where an integration starts from, and when it leaves something to start from.
struct Checkpoints {
  std::optional<Checkpoint> from;                          ///< in place of the initial state
  double every = std::numeric_limits<double>::infinity();  ///< [s]
  std::function<void(const Checkpoint&)> keep;             ///< where interrupted, too; none are kept if it is empty
};

}  // namespace vlbeam
