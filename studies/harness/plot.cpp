#include "studies/harness/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "scene/derived.hpp"
#include "scene/options.hpp"
#include "scene/shape.hpp"
#include "studies/harness/gnuplot.hpp"
#include "studies/harness/json.hpp"
#include "studies/harness/nearest.hpp"

namespace vlbeam {
namespace {

constexpr int points_an_element = 12;
constexpr std::size_t longest_key = 21;  // lines beside the diagram
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

std::string terminal(const std::string& ending) {
  const std::string size = " size 900,620 ", font = "noenhanced background rgb 'white' ";
  if (ending == ".gif")
    return "set terminal gif animate delay 8 loop 0 size 900,620 noenhanced background rgb 'white'\n";
  return "set terminal " + std::string(ending == ".png" ? "pngcairo" : "svg") + size + "font 'Helvetica,15' " + font +
         "linewidth 1.2\n";
}

std::string frame_of(const Diagram& diagram, const std::string& ending) {
  std::string script = terminal(ending) +
                       "set encoding utf8\nset output output\nset datafile separator ','\nset datafile missing 'NaN'\n"
                       "set border linewidth 0.8 linecolor rgb '#444444'\nset tics nomirror scale 0.6\n"
                       "set grid linewidth 0.5 linecolor rgb '#dddddd' linetype 1\n"
                       "set key outside right top vertical Left reverse samplen 1.5 width -1\n";
  script += "set title " + text_of(diagram.title) + "\nset xlabel " + text_of(diagram.x_label) + "\nset ylabel " +
            text_of(diagram.y_label) + "\n";
  if (!diagram.key_title.empty()) script += "set key title " + text_of(diagram.key_title) + "\n";
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

std::string data_of(const Diagram& diagram) {
  std::string data;
  for (const Series& series : diagram.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      const bool there = std::isfinite(series.x[i]) && std::isfinite(series.y[i]);
      data += there ? number_text(series.x[i]) + "," + number_text(series.y[i]) + "\n" : "NaN,NaN\n";
    }
    data += "\n\n";
  }
  return data;
}

/// Ranges of both axes that hold every point, with a margin; of a straight line, too.
std::string ranges_of(const Diagram& diagram) {
  constexpr double margin = 0.05, infinite = std::numeric_limits<double>::infinity();
  std::array<double, 4> box{infinite, -infinite, infinite, -infinite};
  for (const Series& series : diagram.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) continue;
      box = {std::min(box[0], series.x[i]), std::max(box[1], series.x[i]), std::min(box[2], series.y[i]),
             std::max(box[3], series.y[i])};
    }
  }
  const double size = std::max({box[1] - box[0], box[3] - box[2], 1e-12});
  const auto range = [&](const char* axis, double low, double high) {
    // With equal scales a flat shape still gets a frame to stand in.
    const double least = diagram.equal_scales ? 0.25 * size : 0;
    const double widen =
        margin * (diagram.equal_scales ? size : high - low) + std::max(0.0, (least - (high - low)) / 2);
    const double some = widen > 0 ? widen : std::max(1e-12, 0.05 * std::abs(high));
    return std::string("set ") + axis + "range [" + number_text(low - some) + ":" + number_text(high + some) + "]\n";
  };
  return range("x", box[0], box[1]) + range("y", box[2], box[3]);
}

constexpr const char* palette =
    "set palette defined (0 '#08306b', 0.25 '#2171b5', 0.5 '#6baed6', 0.75 '#fdae6b', 1 '#a63603')\n"
    "set cbrange [0:1]\nunset colorbox\n";

void check_not_empty(const Diagram& diagram, const std::string& what) {
  for (const Series& series : diagram.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (std::isfinite(series.x[i]) && std::isfinite(series.y[i])) return;
    }
  }
  throw InvalidInput("--what", "\"" + what + "\"", "the report has no numbers for it");
}

std::string title_of(const RunFile& run) {
  return run.scene.title.empty() ? run.path.stem().string() : run.scene.title;
}

std::vector<Configuration> shapes_of(const RunFile& run) {
  auto shapes = run.configurations();
  if (shapes.empty()) {
    throw InvalidInput("--what", "a report without whole shapes",
                       "list the times of some in /output/configurations of the scene and run it again");
  }
  return shapes;
}

/// Projections of a shape: x and y, or, in space, the two axes along which the beam reaches furthest.
std::array<std::size_t, 2> axes_of(const RunFile& run, const std::vector<Configuration>& shapes) {
  if (run.scene.dimension == 2) return {0, 1};
  std::array<std::pair<double, std::size_t>, 3> reach{};
  for (std::size_t c = 0; c < 3; ++c) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Configuration& shape : shapes) {
      for (const Point& r : shape.r) {
        low = std::min(low, r[c]);
        high = std::max(high, r[c]);
      }
    }
    reach[c] = {-(high - low), c};
  }
  std::ranges::sort(reach);
  return {reach[0].second, reach[1].second};
}

/// Across the longest axis a deflection may be a millionth of it: then each axis has a scale of its own.
bool comparable(const Diagram& diagram) {
  double low = 0, high = 0, left = 0, right = 0;
  bool first = true;
  for (const Series& series : diagram.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) continue;
      low = first ? series.y[i] : std::min(low, series.y[i]);
      high = first ? series.y[i] : std::max(high, series.y[i]);
      left = first ? series.x[i] : std::min(left, series.x[i]);
      right = first ? series.x[i] : std::max(right, series.x[i]);
      first = false;
    }
  }
  return high - low > 0.05 * (right - left) || high - low < 1e-9 * (right - left);
}

/// What the `t` of samples and shapes is.
const char* time_label(const RunFile& run) { return run.scene.analysis == Analysis::statics ? "equilibrium" : "t (s)"; }

/// Where the sliding mass is at the times of the shapes that are times of samples, too; NaN at others.
Series masses_at(const RunFile& run, const std::vector<Configuration>& shapes, std::size_t across, std::size_t up,
                 std::size_t which) {
  constexpr double same_time = 1e-9;  // of the duration
  const auto joints = sliding_joints(run.scene);
  constexpr std::array axes{"x", "y", "z"};
  const auto column = [&](std::size_t axis) {
    const bool several = joints.size() > 1;
    const std::string name = several ? "joint" + std::to_string(which) + "_mass_position_" + axes[axis]
                                     : std::string("mass_position.") + axes[axis];
    return run.column(find_quantity(run.scene, name));
  };
  const auto x = column(across), y = column(up);
  const SupportType held = joints[which].support;
  const std::string kind = held == SupportType::pin ? "ring" : held == SupportType::clamp ? "sleeve" : "mass";
  const std::string number = joints.size() > 1 ? " " + std::to_string(which) : "";
  Series masses{kind + number, {}, {}, Series::Style::points};
  for (const Configuration& shape : shapes) {
    const auto sample =
        std::ranges::find_if(run.t, [&](double t) { return std::abs(t - shape.t) <= same_time * run.scene.duration; });
    const auto i = static_cast<std::size_t>(sample - run.t.begin());
    masses.x.push_back(sample == run.t.end() ? nan : x[i]);
    masses.y.push_back(sample == run.t.end() ? nan : y[i]);
  }
  return masses;
}

/// The point masses of the shapes, which keep their material points; those are nodes of the even mesh at t = 0.
Series point_masses_at(const RunFile& run, const std::vector<Configuration>& shapes, std::size_t across,
                       std::size_t up) {
  Series masses{run.scene.point_masses.size() == 1 ? "point mass" : "point masses", {}, {}, Series::Style::points};
  const double l = beam_length(run.scene) / run.scene.beam.elements;
  for (const Configuration& shape : shapes) {
    const std::vector<ShapePoint> points = points_along(run.scene, shape, points_an_element);
    for (const PointMassSpec& mass : run.scene.point_masses) {
      const double x = mass.node * l;
      const auto nearest =
          std::ranges::min_element(points, {}, [x](const ShapePoint& point) { return std::abs(point.x - x); });
      masses.x.push_back(nearest->r[across]);
      masses.y.push_back(nearest->r[up]);
    }
  }
  return masses;
}

Diagram shape_diagram(const RunFile& run, const std::vector<Configuration>& shapes) {
  const auto [across, up] = axes_of(run, shapes);
  constexpr std::array names{"X (m)", "Y (m)", "Z (m)"};
  Diagram diagram{.title = title_of(run),
                  .x_label = names[across],
                  .y_label = names[up],
                  .series = {},
                  .equal_scales = true,
                  .ordered_colours = true,
                  .key_title = time_label(run)};
  for (const Configuration& shape : shapes) {
    Series series;
    std::array<char, 32> time{};
    std::snprintf(time.data(), time.size(), "%.4g", shape.t);
    series.title = time.data();
    for (const ShapePoint& point : points_along(run.scene, shape, points_an_element)) {
      series.x.push_back(point.r[across]);
      series.y.push_back(point.r[up]);
    }
    diagram.series.push_back(std::move(series));
  }
  diagram.equal_scales = comparable(diagram);
  for (std::size_t i = 0; i < sliding_joints(run.scene).size(); ++i) {
    diagram.series.push_back(masses_at(run, shapes, across, up, i));
  }
  if (!run.scene.point_masses.empty()) diagram.series.push_back(point_masses_at(run, shapes, across, up));
  return diagram;
}

/// A quantity along the beam, at the times kept.
Diagram along_diagram(const RunFile& run, double ShapePoint::*member, const std::string& label) {
  Diagram diagram{.title = title_of(run),
                  .x_label = "material coordinate (m)",
                  .y_label = label,
                  .series = {},
                  .ordered_colours = true,
                  .key_title = time_label(run)};
  for (const Configuration& shape : shapes_of(run)) {
    Series series;
    std::array<char, 32> time{};
    std::snprintf(time.data(), time.size(), "%.4g", shape.t);
    series.title = time.data();
    for (const ShapePoint& point : points_along(run.scene, shape, points_an_element)) {
      series.x.push_back(point.x);
      series.y.push_back(point.*member);
    }
    diagram.series.push_back(std::move(series));
  }
  return diagram;
}

Diagram history_diagram(const RunFile& run, const std::vector<std::string>& names, const std::string& label) {
  Diagram diagram{.title = title_of(run), .x_label = time_label(run), .y_label = label, .series = {}};
  std::string unit;
  for (const std::string& name : names) {
    const Quantity quantity = find_quantity(run.scene, name);
    if (!unit.empty() && unit != quantity.unit) {
      throw InvalidInput(
          "--quantity", "\"" + name + "\"",
          "what stands in one figure must have one unit, and this is in " + quantity.unit + ", not in " + unit);
    }
    unit = quantity.unit;
    diagram.series.push_back({quantity.name, run.t, run.column(quantity)});
  }
  if (label.empty())
    diagram.y_label = (names.size() == 1 ? diagram.series.front().title : std::string("value")) + " (" + unit + ")";
  return diagram;
}

void draw_animation(const RunFile& run, const std::filesystem::path& figure) {
  const std::string ending = ending_of(figure, {".gif"});
  const auto shapes = shapes_of(run);
  const Diagram diagram = shape_diagram(run, shapes);
  std::string script = frame_of(diagram, ending) + palette + ranges_of(diagram) + "unset key\n";
  if (diagram.equal_scales) script += "set size ratio -1\n";
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    script += "set title " + text_of(diagram.title + ", t = " + diagram.series[i].title + " s") + "\nplot data index " +
              std::to_string(i) + " using 1:2 with lines linewidth 3 linecolor rgb '#08306b'";
    for (std::size_t joint = 0; joint < sliding_joints(run.scene).size(); ++joint) {
      const std::string frame = std::to_string(i);
      script += ", data index " + std::to_string(shapes.size() + joint) + " every ::" + frame + "::" + frame +
                " using 1:2 with points pointtype 7 pointsize 2 linecolor rgb '#a63603'";
    }
    script += "\n";
  }
  draw_figure_of(script, data_of(diagram), figure);
}

}  // namespace

void draw_diagram(const Diagram& diagram, const std::filesystem::path& figure) {
  const std::string ending = ending_of(figure, {".svg", ".png"});
  std::string script = frame_of(diagram, ending);
  if (diagram.ordered_colours) script += palette;
  if (!diagram.logarithmic) script += ranges_of(diagram);
  if (diagram.equal_scales) script += "set size ratio -1\n";
  const std::size_t each = (diagram.series.size() + longest_key - 1) / longest_key;
  for (std::size_t i = 0; i < diagram.series.size(); ++i) {
    script += (i == 0 ? "plot data" : ", \\\n  data") + std::string(" index ") + std::to_string(i) +
              " using 1:2 with " + style_of(diagram, i) +
              (i % each == 0 ? " title " + text_of(diagram.series[i].title) : std::string(" notitle"));
  }
  draw_figure_of(script + "\n", data_of(diagram), figure);
}

std::vector<std::string> plot_kinds() {
  return {"shape", "energy", "tip", "joint", "strain", "tension", "curvature", "animation"};
}

void plot_run(const RunFile& run, const std::string& what, const std::vector<std::string>& names,
              const std::filesystem::path& figure) {
  if (what == "animation") return draw_animation(run, figure);
  Diagram diagram;
  if (what.empty() && !names.empty()) {
    diagram = history_diagram(run, names, "");
  } else if (what == "shape") {
    diagram = shape_diagram(run, shapes_of(run));
  } else if (what == "energy") {
    std::vector<std::string> energies = {"energy.kinetic", "energy.axial", "energy.bending", "energy.gravity",
                                         "energy.total"};
    if (run.scene.spin) energies.insert(energies.begin() + 3, "energy.torsion");
    diagram = history_diagram(run, energies, "energy (J)");
  } else if (what == "tip") {
    std::vector<std::string> tip = {"end.x", "end.y"};
    if (run.scene.dimension == 3) tip.emplace_back("end.z");
    diagram = history_diagram(run, tip, "position of the beam's end (m)");
  } else if (what == "joint") {
    if (!sliding_joint(run.scene)) throw InvalidInput("--what", "\"joint\"", "this scene has no sliding mass");
    std::vector<std::string> marks;
    const std::size_t count = sliding_joints(run.scene).size();
    for (std::size_t i = 0; i < count; ++i) marks.push_back("joint" + std::to_string(i) + "_position");
    if (count == 1) marks = {"joint_position"};
    diagram =
        history_diagram(run, marks, count == 1 ? "material coordinate of the mass (m)" : "material coordinates (m)");
  } else if (what == "strain") {
    diagram = along_diagram(run, &ShapePoint::strain, "axial strain (-)");
  } else if (what == "tension") {
    diagram = along_diagram(run, &ShapePoint::tension, "axial force (N)");
  } else if (what == "curvature") {
    diagram = along_diagram(run, &ShapePoint::curvature, "curvature from the rest shape (1/m)");
  } else {
    throw InvalidInput(
        "--what", "\"" + what + "\"",
        "the nearest is \"" + nearest_of(what, plot_kinds()) + "\" (there are: " + quoted_list(plot_kinds()) + ")");
  }
  check_not_empty(diagram, what);
  draw_diagram(diagram, figure);
}

void plot_convergence(const Json& report, const std::filesystem::path& figure) {
  Diagram diagram{.title = report.value("title", "") + ": " + report.value("quantity", ""),
                  .x_label = "work (element evaluations)",
                  .y_label = "bound of the error (" + report.value("unit", "") + ")",
                  .series = {},
                  .logarithmic = true};
  for (const std::string kind : {"mesh", "time", "quadrature"}) {
    Series series{kind + " refined", {}, {}, Series::Style::points};
    for (const Json& row : report.at("levels")) {
      if (row.value("refined", "") != kind || !row.at("error_bound").is_number()) continue;
      series.x.push_back(row.at("work").get<double>());
      series.y.push_back(row.at("error_bound").get<double>());
    }
    if (!series.x.empty()) diagram.series.push_back(std::move(series));
  }
  if (diagram.series.empty()) throw InvalidInput("--what", "this report", "no level of it has a difference to draw");
  std::vector<double> work;
  for (const Series& series : diagram.series) work.insert(work.end(), series.x.begin(), series.x.end());
  const auto [least, most] = std::ranges::minmax(work);
  const double wanted = report.at("error").get<double>();
  diagram.series.push_back({"error wanted", {least, most}, {wanted, wanted}});
  draw_diagram(diagram, figure);
}

}  // namespace vlbeam
