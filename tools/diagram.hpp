#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/symbol.hpp"

namespace vlbeam {

/// A curve, or points, of a figure; what is not a number leaves a gap.
struct Series {
  enum class Style { line, points, line_with_points };
  std::string title;
  std::vector<double> x, y;
  Style style = Style::line;
};

/// Values over two axes: one row of points a time, all of the same number of points.
struct ColourField {
  std::string label;  ///< of the scale of colours, with its unit
  std::vector<double> x;
  std::vector<std::vector<double>> y, values;  ///< a row for each x
};

/// One diagram, of curves or of a field; axes carry their units.
struct Diagram {
  std::string title, x_label, y_label;
  std::vector<Series> series;
  bool logarithmic = false;      ///< both axes
  bool equal_scales = false;     ///< of both axes: shapes
  bool ordered_colours = false;  ///< of lines, from dark blue to orange in their order; points are black
  std::string key_title = {};
  ColourField field = {};
  std::vector<Symbol> symbols = {};  ///< below the curves; those of one place are drawn once
  bool in_time = true;               ///< frames of an animation are instants
};

/// How a figure is set.
struct Look {
  bool column = false;  ///< 84 mm wide, letters of 8 pt: a column of a journal, in place of a screen
  bool bare = false;    ///< no title: a paper's caption says it
};

/// Draws a diagram into an SVG, PNG or PDF file, by its ending; a PDF has its fonts in it. The key stands beside the
/// diagram, of a column's figure below it. Throws InvalidInput for another ending, std::runtime_error where gnuplot
/// fails.
void draw_diagram(const Diagram& diagram, const Look& look, const std::filesystem::path& figure);

/// Draws a GIF, or by ffmpeg an MP4: a frame for each of the first `frames` series, with the points of the others that
/// belong to it. `seconds` is how long the motion lasts.
void draw_frames(const Diagram& diagram, const Look& look, std::size_t frames, double seconds,
                 const std::filesystem::path& figure);

}  // namespace vlbeam
