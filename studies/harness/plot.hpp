#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/harness/json.hpp"
#include "studies/harness/run_file.hpp"

namespace vlbeam {

/// A curve, or points, of a figure; what is not a number leaves a gap.
struct Series {
  enum class Style { line, points, line_with_points };
  std::string title;
  std::vector<double> x, y;
  Style style = Style::line;
};

/// One diagram; axes carry their units.
struct Diagram {
  std::string title, x_label, y_label;
  std::vector<Series> series;
  bool logarithmic = false;      ///< both axes
  bool equal_scales = false;     ///< of both axes: shapes
  bool ordered_colours = false;  ///< of lines, from dark blue to orange in their order; points are black
  std::string key_title = {};
};

/// Draws a diagram into an SVG or PNG file, by its ending; the key stands beside it. Throws InvalidInput for another
/// ending, std::runtime_error where gnuplot fails.
void draw_diagram(const Diagram& diagram, const std::filesystem::path& figure);

/// What plot_run() can draw.
std::vector<std::string> plot_kinds();

/// Draws the report of a run: `what` is one of plot_kinds(), or empty where `names` of quantities are drawn against
/// time; an animation needs a .gif, which any number of shapes gives. Throws InvalidInput where the report has nothing
/// of it.
void plot_run(const RunFile& run, const std::string& what, const std::vector<std::string>& names,
              const std::filesystem::path& figure);

/// Draws what `vlbeam converge` found: error against work.
void plot_convergence(const Json& report, const std::filesystem::path& figure);

}  // namespace vlbeam
