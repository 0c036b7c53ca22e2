#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "core/geometry/vec.hpp"
#include "mechanics/motion/system/beam_model.hpp"
#include "scene/integrator_type.hpp"

namespace vlbeam {

// What several features of a scene ask.

/// Whether a name can be part of a quantity's: letters, digits and underscores.
inline bool is_plain_name(const std::string& name) {
  return std::ranges::all_of(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; });
}

/// Whether a method takes forces of links and unknowns of vehicles as they are: others need derivatives of them.
inline bool takes_links(IntegratorType type) {
  return type != IntegratorType::rosenbrock4 && type != IntegratorType::ida && type != IntegratorType::cvode &&
         type != IntegratorType::energy_momentum;
}

/// The part of that kind that a model has, or null.
template <class P, int D>
const P* part_of(const BeamModel<D>& model) {
  const P* found = nullptr;
  for (const auto& part : model.parts) {
    if (const auto* const one = dynamic_cast<const P*>(part.get())) found = one;
  }
  return found;
}

}  // namespace vlbeam
