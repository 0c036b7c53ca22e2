#pragma once

#include <string>

#include "io/json.hpp"
#include "io/run_report.hpp"

namespace vlbeam {

/// The report of a run, read back.
inline Json report_of(const Scene& scene, const RunResult& result, const Json& more = Json::object()) {
  std::string text;
  write_run_report(scene, result, more, [&text](std::string_view piece) { text += piece; });
  return parse_json(text);
}

}  // namespace vlbeam
