#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "scene/result.hpp"

namespace vlbeam {

/// Where the joint, its mass and the end of a beam are by the judge of reference/judge, another formulation.
struct Judged {
  std::optional<double> joint;     ///< its material coordinate [m]
  std::optional<Point> mass, end;  ///< [m]; an end that is held is not among its answers
  double t = 0;                    ///< [s]
  double uncertainty = 0;          ///< the largest uncertainty of these [m]

  /// Largest distance of a sample from these [m]; NaN if the sample lacks one of them.
  double error(const Sample& sample) const;
};

/// Reads the judge's answer to a case at a time [s]; without a time, the last one. `studies` is the folder of the
/// studies, beside reference/. Throws InvalidInput if there is no such case or time.
Judged judged_at(const std::filesystem::path& studies, const std::string& name, std::optional<double> t = {});

}  // namespace vlbeam
