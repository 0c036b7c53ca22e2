// What a case is known to: three degrees, two tolerances, two integrators, two numbers of Gauss points.
#pragma once

#include <nlohmann/json.hpp>

namespace judge {

/// The answer of a case of cases.json: for each quantity its values at the times and their uncertainties, and what they
/// were made of.
nlohmann::ordered_json refine(const nlohmann::json& item);

}  // namespace judge
