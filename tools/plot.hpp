#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/json.hpp"
#include "io/run_file.hpp"
#include "tools/diagram.hpp"
#include "tools/influence.hpp"

namespace vlbeam {

/// What plot_run() can draw.
std::vector<std::string> plot_kinds();

/// Draws the report of a run: `what` is one of plot_kinds(), or empty where `names` of quantities are drawn against
/// time. An animation is a .gif or an .mp4, a frame a shape. Throws InvalidInput where the report has nothing of it.
void plot_run(const RunFile& run, const std::string& what, const std::vector<std::string>& names, const Look& look,
              const std::filesystem::path& figure);

/// Draws what `vlbeam converge` found: error against work.
void plot_convergence(const Json& report, const Look& look, const std::filesystem::path& figure);

/// Draws influence lines into one diagram.
void plot_influence(const std::string& title, const Influence& found, const Look& look,
                    const std::filesystem::path& figure);

}  // namespace vlbeam
