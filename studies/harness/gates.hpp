#pragma once

#include <string>
#include <vector>

#include "studies/harness/json.hpp"
#include "studies/harness/observed_order.hpp"

namespace vlbeam {

/// What one gate found.
struct GateVerdict {
  std::string name;
  double value = 0;         ///< NaN where the report does not hold the quantity
  std::string bound = {};   ///< in words
  std::string reason = {};  ///< why this bound and no other
  bool passed = false;
  std::string failure = {};  ///< what is wrong, where it did not pass
};

/// Evaluates the gates of a study on its report. `gates` is a gates file:
///   {"schema": "vlbeam.gates/1", "gates": [{"name", "reason", "profiles", and one of
///      "quantity" with "max" and/or "min", or "equals" with "tolerance";
///      "fit" with "order": {"expected", "tolerance", "at_most", "finest_error"}}, ...]}
/// A quantity is a name in the report's `measured`, or a JSON pointer into the report; a fit is named by its quantity.
/// Gates with `profiles` (["full"]) apply to these only. What the report does not hold fails, and so does a report that
/// is not completed. Throws InvalidInput where the gates file is not understood.
std::vector<GateVerdict> evaluate_gates(const Json& gates, const Json& report);

bool all_passed(const std::vector<GateVerdict>& verdicts);

/// The verdicts as a report holds them.
Json gates_to_json(const std::vector<GateVerdict>& verdicts);

/// A table for the terminal: one line a gate, then how many were evaluated and how many failed.
std::string gates_text(const std::string& title, const std::vector<GateVerdict>& verdicts);

Json fit_to_json(const OrderFit& fit);

}  // namespace vlbeam
