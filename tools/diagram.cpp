#include "tools/diagram.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "io/nearest.hpp"
#include "scene/options.hpp"
#include "tools/gnuplot.hpp"

namespace vlbeam {
namespace {

constexpr std::size_t longest_key = 21, longest_below = 8;  // entries beside the diagram, and below a column's
constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000", "#999999"};

/// In double quotes, as gnuplot reads it: nothing in it is an escape.
std::string text_of(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string ending_of(const std::filesystem::path& figure, const std::vector<std::string>& known) {
  const std::string ending = figure.extension().string();
  if (std::ranges::find(known, ending) != known.end()) return ending;
  throw InvalidInput("-o", "\"" + figure.string() + "\"",
                     "the name of this figure must end in one of " + quoted_list(known));
}

/// A sheet of paper or a screen: where it goes, how large it is, and its letters and lines.
std::string terminal(const Look& look, const std::string& ending) {
  const std::string plain = " noenhanced background rgb 'white'";
  if (ending == ".gif") {
    return "set terminal gif animate delay delay loop 0 size " + std::string(look.column ? "450,330" : "900,620") +
           plain + "\n";
  }
  // A PDF and a PNG have their letters in them; an SVG names a face, and only a generic one is on every machine.
  const std::string face = ending == ".svg" ? "sans-serif" : "Helvetica";
  const auto set = [&](const char* kind, const char* size, const char* font, const char* lines) {
    return std::string("set terminal ") + kind + " size " + size + " font '" + face + "," + font + "'" + plain +
           " linewidth " + lines + "\n";
  };
  if (ending == ".pdf") {
    return look.column ? set("pdfcairo fontscale 0.75", "8.4cm,6.2cm", "8", "0.6")
                       : set("pdfcairo fontscale 0.75", "17cm,11.7cm", "10", "1");
  }
  if (ending == ".png") {  // a column's has 300 points an inch
    return look.column ? set("pngcairo", "992,732", "25", "2.2") : set("pngcairo", "900,620", "15", "1.2");
  }
  return look.column ? set("svg", "318,234", "10.5", "0.7") : set("svg", "900,620", "15", "1.2");
}

std::string frame_of(const Diagram& diagram, const Look& look, const std::string& ending) {
  const bool large = ending == ".png" && look.column;  // tics and lines of axes as letters are
  std::string script = terminal(look, ending) +
                       "set encoding utf8\nset output output\nset datafile separator ','\nset datafile missing 'NaN'\n"
                       "set border linewidth " +
                       std::string(large ? "0.6" : "0.8") +
                       " linecolor rgb '#444444'\nset tics nomirror scale 0.6\n"
                       "set grid linewidth 0.5 linecolor rgb '#dddddd' linetype 1\n";
  script += look.column ? "set key below horizontal Left reverse samplen 1 width -1 spacing 1\n"
                        : "set key outside right top vertical Left reverse samplen 1.5 width -1\n";
  if (!look.bare) script += "set title " + text_of(diagram.title) + "\n";
  script += "set xlabel " + text_of(diagram.x_label) + "\nset ylabel " + text_of(diagram.y_label) + "\n";
  // Below a column's figure the key has no room for its title: times have their unit there.
  if (!diagram.key_title.empty() && !look.column) script += "set key title " + text_of(diagram.key_title) + "\n";
  if (diagram.logarithmic) {
    script += "set logscale xy\nset format xy '%.0e'\nset offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05\n";
  }
  return script;
}

std::string style_of(const Diagram& diagram, std::size_t i) {
  const auto n = static_cast<std::size_t>(
      std::ranges::count_if(diagram.series, [](const Series& s) { return s.style != Series::Style::points; }));
  std::string style = diagram.series[i].style == Series::Style::line     ? "lines linewidth 2"
                      : diagram.series[i].style == Series::Style::points ? "points pointsize 1"
                                                                         : "linespoints linewidth 2 pointsize 1";
  constexpr std::array filled{7, 5, 9, 13};  // circle, square, triangle, diamond
  if (diagram.series[i].style != Series::Style::line) {
    // joints, all black, are told from each other by their shapes
    const std::size_t of_joints = i >= n ? (i - n) % filled.size() : 0;
    style +=
        " pointtype " + std::to_string(diagram.ordered_colours ? filled[of_joints] : 2 * static_cast<int>(i % 4) + 5);
  }
  if (diagram.ordered_colours) {
    if (diagram.series[i].style == Series::Style::points) return style + " linecolor rgb '#000000'";
    return style + " linecolor palette frac " +
           number_text(n > 1 ? static_cast<double>(i) / static_cast<double>(n - 1) : 0);
  }
  return style + " linecolor rgb '" + colours[i % colours.size()] + "'" +
         (i >= colours.size() ? " dashtype " + std::to_string(i / colours.size() + 1) : "");
}

/// What the key says of a curve.
std::string key_of(const Diagram& diagram, const Look& look, std::size_t i) {
  const bool time = diagram.key_title == "t (s)" && diagram.series[i].style == Series::Style::line;
  return diagram.series[i].title + (look.column && time ? " s" : "");
}

/// What is no number is missing; one such row within a line is a gap between two lines: an empty row.
std::string data_of(const Diagram& diagram) {
  std::string data;
  for (const Series& series : diagram.series) {
    const auto there = [&series](std::size_t i) {
      return i < series.x.size() && std::isfinite(series.x[i]) && std::isfinite(series.y[i]);
    };
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      const bool gap = series.style == Series::Style::line && i > 0 && there(i - 1) && there(i + 1);
      data += there(i) ? number_text(series.x[i]) + "," + number_text(series.y[i]) + "\n" : gap ? "\n" : "NaN,NaN\n";
    }
    data += "\n\n";
  }
  return data;
}

/// The least of 1, 2, 5, 10, ... that divides a range into at most `most` parts.
double step_of(double range, double most) {
  constexpr std::array factors{2.0, 2.5, 2.0};
  double step = 1e-15;
  for (std::size_t i = 0; step * most < range; ++i) step *= factors[i % factors.size()];
  return step;
}

/// What a diagram reaches over, of its points and the places of its symbols: left, right, low, high.
using Box = std::array<double, 4>;

Box box_of(const Diagram& diagram) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Box box{infinite, -infinite, infinite, -infinite};
  const auto hold = [&box](double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y)) return;
    box = {std::min(box[0], x), std::max(box[1], x), std::min(box[2], y), std::max(box[3], y)};
  };
  for (const Series& series : diagram.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) hold(series.x[i], series.y[i]);
  }
  for (const Symbol& symbol : diagram.symbols) {
    if (symbol.leads()) hold(symbol.other[0], symbol.other[1]);
    if (symbol.kind == Symbol::Kind::floor) hold(box[0], symbol.at[1]);
  }
  return box;
}

/// Ranges of both axes, as a box, with a margin around every point; of a straight line, too.
Box ranges_of(const Diagram& diagram) {
  const Box box = box_of(diagram);
  const double margin = diagram.symbols.empty() ? 0.05 : 0.1;  // symbols stand around points
  const double size = std::max({box[1] - box[0], box[3] - box[2], 1e-12});
  const auto some = [&](bool across, double low, double high) {
    // With equal scales a flat shape still gets a frame to stand in, and an upright one room for the numbers below it.
    const double least = diagram.equal_scales ? (across ? 0.8 : 0.25) * size : 0;
    const double widen =
        margin * (diagram.equal_scales ? size : high - low) + std::max(0.0, (least - (high - low)) / 2);
    return widen > 0 ? widen : std::max(1e-12, 0.05 * std::abs(high));
  };
  const double x = some(true, box[0], box[1]), y = some(false, box[2], box[3]);
  return {box[0] - x, box[1] + x, box[2] - y, box[3] + y};
}

/// In a column there is room for few numbers below the diagram, and for fewer where equal scales make it narrow.
std::string set_ranges(const Diagram& diagram, const Look& look) {
  const Box ranges = ranges_of(diagram), box = box_of(diagram);
  const std::string script = "set xrange [" + number_text(ranges[0]) + ":" + number_text(ranges[1]) +
                             "]\nset yrange [" + number_text(ranges[2]) + ":" + number_text(ranges[3]) + "]\n";
  if (!look.column) return script;
  const double size = std::max({box[1] - box[0], box[3] - box[2], 1e-12});
  const double width = std::max(box[1] - box[0], diagram.equal_scales ? 0.8 * size : 0);
  const double share = diagram.equal_scales ? std::min(1.0, width / (1.3 * (box[3] - box[2]))) : 1;
  return script + "set xtics " + number_text(step_of(box[1] - box[0] > 0 ? width : 1, std::max(2.0, 5 * share))) + "\n";
}

constexpr const char* with_symbol_lines = " using 1:2 with lines linewidth 1.2 linecolor rgb '#555555' notitle";

/// Lines of symbols, apart from each other by a blank line; `frame`: those of one time, and what stands all the time.
std::string symbol_data(const Diagram& diagram, std::optional<std::size_t> frame) {
  constexpr double share = 0.035, one_place = 0.6;  // of the picture; of a symbol's size
  const Box box = ranges_of(diagram);
  const double wide = box[1] - box[0], high = box[3] - box[2];
  const double size = share * std::max(wide, high);
  const std::array<double, 2> sizes =
      diagram.equal_scales ? std::array{size, size} : std::array{share * wide, 1.4 * share * high};
  std::vector<const Symbol*> drawn;
  std::string data;
  for (const Symbol& symbol : diagram.symbols) {
    if (frame && symbol.frame != *frame && symbol.kind != Symbol::Kind::floor) continue;
    const double reach = symbol.is_small() ? one_place / 3 : one_place;
    const auto near = [&](const std::array<double, 2>& a, const std::array<double, 2>& b) {
      return std::abs(a[0] - b[0]) < reach * sizes[0] && std::abs(a[1] - b[1]) < reach * sizes[1];
    };
    const bool again = std::ranges::any_of(drawn, [&](const Symbol* other) {
      return other->kind == symbol.kind && near(other->at, symbol.at) &&
             (!symbol.leads() || near(other->other, symbol.other));
    });
    if (again) continue;
    drawn.push_back(&symbol);
    for (const auto& line : lines_of(symbol, sizes, box[0], box[1])) {
      for (const auto& point : line) data += number_text(point[0]) + "," + number_text(point[1]) + "\n";
      data += "\n";
    }
  }
  return data.empty() ? "NaN,NaN\n" : data;
}

constexpr const char* palette =
    "set palette defined (0 '#08306b', 0.25 '#2171b5', 0.5 '#6baed6', 0.75 '#fdae6b', 1 '#a63603')\n"
    "set cbrange [0:1]\nunset colorbox\n";

/// Rows of a field, apart from each other by a blank line.
std::string field_data(const ColourField& field) {
  std::string data;
  for (std::size_t i = 0; i < field.x.size(); ++i) {
    for (std::size_t k = 0; k < field.y[i].size(); ++k) {
      data += number_text(field.x[i]) + "," + number_text(field.y[i][k]) + "," + number_text(field.values[i][k]) + "\n";
    }
    data += "\n";
  }
  return data;
}

std::string field_script(const ColourField& field, const Look& look) {
  // The colours of viridis, which grow evenly brighter.
  return "set palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21918c', 0.75 '#5ec962', 1 '#fde725')\n"
         "set pm3d map\nunset key\nunset grid\nset autoscale xfix\nset autoscale yfix\n" +
         std::string(look.column ? "set lmargin screen 0.17\nset rmargin screen 0.7\n"
                                 : "set lmargin screen 0.1\nset rmargin screen 0.82\n") +
         "set bmargin screen 0.19\nset tmargin screen 0.9\nset cblabel " + text_of(field.label) +
         " offset 1,0\nsplot data using 1:2:3 with pm3d\n";
}

}  // namespace

void draw_diagram(const Diagram& diagram, const Look& look, const std::filesystem::path& figure) {
  const std::string ending = ending_of(figure, {".svg", ".png", ".pdf"});
  std::string script = frame_of(diagram, look, ending);
  if (!diagram.field.values.empty()) {
    return draw_figure_of(script + field_script(diagram.field, look), field_data(diagram.field), figure);
  }
  if (diagram.ordered_colours) script += palette;
  if (!diagram.logarithmic) script += set_ranges(diagram, look);
  if (diagram.equal_scales) script += "set size ratio -1\n";
  if (diagram.series.size() == 1) script += "unset key\n";  // the axis says it
  const std::size_t most = look.column ? longest_below : longest_key;
  const std::size_t each = (diagram.series.size() + most - 1) / most;
  script += "plot";
  const std::size_t n = diagram.series.size();
  if (!diagram.symbols.empty()) script += " data index " + std::to_string(n) + with_symbol_lines + ",";
  for (std::size_t i = 0; i < n; ++i) {
    script += (i == 0 ? " data" : ", \\\n  data") + std::string(" index ") + std::to_string(i) + " using 1:2 with " +
              style_of(diagram, i) +
              (i % each == 0 || diagram.series[i].style == Series::Style::points
                   ? " title " + text_of(key_of(diagram, look, i))
                   : std::string(" notitle"));
  }
  draw_figure_of(script + "\n", data_of(diagram) + symbol_data(diagram, {}), figure);
}

void draw_frames(const Diagram& diagram, const Look& look, std::size_t frames, double seconds,
                 const std::filesystem::path& figure) {
  const bool film = ending_of(figure, {".gif", ".mp4"}) == ".mp4";
  // As long as the motion, between 2 and 10 s; a hundredth of a second is the unit of a GIF.
  const double shown = std::clamp(seconds, 2.0, 10.0);
  const auto delay = std::max(2, static_cast<int>(std::lround(100 * shown / static_cast<double>(frames))));
  std::string script = "delay = " + std::to_string(delay) + "\n" + frame_of(diagram, look, ".gif") + palette +
                       set_ranges(diagram, look) + "unset key\n";
  if (diagram.equal_scales) script += "set size ratio -1\n";
  std::string data = data_of(diagram);
  for (std::size_t i = 0; i < frames; ++i) {
    const std::string now =
        diagram.in_time ? ", t = " + diagram.series[i].title + " s" : ", equilibrium " + diagram.series[i].title;
    if (!look.bare) script += "set title " + text_of(diagram.title + now) + "\n";
    data += symbol_data(diagram, i) + "\n\n";
    script += "plot data index " + std::to_string(diagram.series.size() + i) + with_symbol_lines + ", data index " +
              std::to_string(i) + " using 1:2 with lines linewidth 3 linecolor rgb '#08306b'";
    for (std::size_t joint = frames; joint < diagram.series.size(); ++joint) {
      if (!std::isfinite(diagram.series[joint].x[i])) continue;
      const std::string frame = std::to_string(i);
      script += ", data index " + std::to_string(joint) + " every ::" + frame + "::" + frame +
                " using 1:2 with points pointtype 7 pointsize 2 linecolor rgb '#a63603'";
    }
    script += "\n";
  }
  if (film) return draw_film_of(script, data, figure);
  draw_figure_of(script, data, figure);
}

}  // namespace vlbeam
