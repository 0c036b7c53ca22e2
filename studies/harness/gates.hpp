#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/json.hpp"
#include "scene/names.hpp"
#include "tools/observed_order.hpp"

namespace vlbeam {

/// Where a gate's bound comes from.
enum class GateKind {
  exact,        ///< a closed form or an identity
  independent,  ///< another formulation, another method or another program
  self,         ///< finer meshes or steps of the same, judged with their uncertainty
  regression,   ///< nothing but the value measured before: it tells a change, and is no evidence
};
constexpr auto names(GateKind) {
  return std::to_array<Named<GateKind>>({{GateKind::exact, "exact"},
                                         {GateKind::independent, "independent"},
                                         {GateKind::self, "self"},
                                         {GateKind::regression, "regression"}});
}

/// What one gate found.
struct GateVerdict {
  std::string name;
  GateKind kind = GateKind::regression;
  double value = 0;         ///< NaN where the report does not hold the quantity
  double uncertainty = 0;   ///< of the value; 0 where none is known
  std::string bound = {};   ///< in words
  std::string reason = {};  ///< why this bound and no other; of a regression what it guards
  bool passed = false;
  std::string failure = {};  ///< what is wrong, where it did not pass
};

/// Evaluates the gates of a study on its report. `gates` is a gates file:
///   {"schema": "vlbeam.gates/1", "gates": [{"name", "kind", "reason" (of kind regression: "guards"), "profiles", and
///   one of
///      "quantity" with "max" and/or "min", or "equals" with "tolerance", and "uncertainty";
///      "fit" with "order": {"expected", "tolerance", "at_most", "finest_error"}}, ...]}
/// A quantity is a name in the report's `measured`, or a JSON pointer into the report; a fit is named by its quantity.
/// An uncertainty is a number or a quantity; bounds must hold for the value plus and minus it. A quantity of kind
/// `self` needs an uncertainty; a fit has its own. Gates with `profiles` (["full"]) apply to these only. A gate fails
/// if the report lacks its quantity, or is not completed. Throws InvalidInput if the gates file is not understood.
std::vector<GateVerdict> evaluate_gates(const Json& gates, const Json& report);

bool all_passed(const std::vector<GateVerdict>& verdicts);

/// The verdicts as a report holds them, and how many there are of each kind.
Json gates_to_json(const std::vector<GateVerdict>& verdicts);
Json kinds_to_json(const std::vector<GateVerdict>& verdicts);

/// How many of each kind: "3 exact, 2 independent, 1 self; 4 regression, which are no evidence".
std::string kinds_text(const std::vector<GateVerdict>& verdicts);

/// A table for the terminal: one line a gate, then how many were evaluated, how many failed, and how many of each kind
/// there are.
std::string gates_text(const std::string& title, const std::vector<GateVerdict>& verdicts);

}  // namespace vlbeam
