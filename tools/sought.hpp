#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/quantity.hpp"
#include "scene/result.hpp"

namespace vlbeam {

/// A number that `converge` refines: a quantity of samples, or a natural frequency about the equilibrium,
/// "frequencies.0" being the lowest.
class Sought {
 public:
  /// Makes the scene keep what the number needs. Throws InvalidInput where the scene has no such number.
  Sought(Scene& scene, const std::string& name);

  const std::string& name() const { return name_; }
  const std::string& unit() const { return unit_; }
  /// One value a sample; of a frequency there is one.
  std::vector<double> values(const RunResult& result) const;

 private:
  std::string name_, unit_;
  std::optional<Quantity> sampled_;
  std::size_t frequency_ = 0;
};

}  // namespace vlbeam
