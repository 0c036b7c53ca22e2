#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "scene/result.hpp"

namespace vlbeam {

/// Where the judge of reference/judge, another formulation, has the joint, its mass and the end of a beam.
struct Judged {
  std::optional<double> joint;     ///< its material coordinate [m]
  std::optional<Point> mass, end;  ///< [m]; an end that is held is not among its answers
  double t = 0;                    ///< [s]
  double uncertainty = 0;          ///< the largest of these [m]

  /// The largest distance of a sample from these [m]; NaN where it lacks one of them.
  double error(const Sample& sample) const;
};

/// Of a case at one of its times [s], the last one if none is given; `studies` is the folder of the studies, beside
/// which reference/ stands. Throws InvalidInput where there is no such case or time.
Judged judged_at(const std::filesystem::path& studies, const std::string& name, std::optional<double> t = {});

}  // namespace vlbeam
