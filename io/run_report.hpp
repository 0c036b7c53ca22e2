#pragma once

#include <string>

#include "io/files.hpp"
#include "io/json.hpp"
#include "io/shapes.hpp"
#include "scene/result.hpp"

namespace vlbeam {

/// Writes the report of a run (`vlbeam schema run`), piece by piece: of many samples a text is far larger than they
/// are. Positions have as many components as the scene has dimensions. `more` holds what is not the same whenever it is
/// run, and stands at the end.
void write_run_report(const Scene& scene, const RunResult& result, const Json& more, const TextSink& sink);
/// The same with shapes that the result does not keep.
void write_run_report(const Scene& scene, const RunResult& result, const Shapes& shapes, const Json& more,
                      const TextSink& sink);

/// Wall times of a run [s].
Json run_timing(const RunTiming& timing);

/// Writes the samples as a table with one line of column names and units; empty cells where a quantity is not there.
void write_samples_csv(const Scene& scene, const RunResult& result, const TextSink& sink);

/// How the axial force follows from the stretch, in words.
std::string law_in_words(const Scene& scene);

/// What was run and how it went, for a reader at the terminal.
std::string run_summary(const Scene& scene, const RunResult& result);

}  // namespace vlbeam
