#pragma once

#include <memory>
#include <vector>

#include "scene/sample_quantities.hpp"

namespace vlbeam {

/// The largest and the least of all numbers of the samples of a scene, over what it has been shown.
class Extremes {
 public:
  explicit Extremes(const Scene& scene) : quantities_(sample_quantities(scene)) {}

  void add(const Sample& sample);
  /// One a number of a sample, in the order of the quantities and of their columns, the time left out; not a number
  /// where it never was one.
  const std::vector<Extreme>& all() const { return all_; }

 private:
  std::vector<SampleQuantity> quantities_;
  std::vector<Extreme> all_;
  std::vector<double> values_;
};

}  // namespace vlbeam
