#include "tools/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "io/json.hpp"
#include "io/nearest.hpp"
#include "scene/assembly.hpp"
#include "scene/derived.hpp"
#include "scene/options.hpp"
#include "scene/shape.hpp"
#include "tools/link_symbols.hpp"
#include "tools/scene_symbols.hpp"

namespace vlbeam {
namespace {

/// Intervals an element along which its curve is drawn: enough to look smooth, few of a beam of many elements.
int intervals(const RunFile& run) { return std::clamp(240 / run.scene.beam.elements, 2, 12); }
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

/// Where a joint is along the beam at a time between samples [m]; NaN where it has left.
double joint_between(const RunFile& run, const std::vector<double>& marks, double t) {
  const auto after = std::ranges::lower_bound(run.t, t);
  if (after == run.t.begin()) return marks.front();
  if (after == run.t.end()) return nan;
  const auto i = static_cast<std::size_t>(after - run.t.begin());
  return std::lerp(marks[i - 1], marks[i], (t - run.t[i - 1]) / (run.t[i] - run.t[i - 1]));
}

/// Where the sliding mass is: at the times of samples as they say, between them on the shape.
Series masses_at(const RunFile& run, const std::vector<Configuration>& shapes, std::size_t across, std::size_t up,
                 std::size_t which) {
  constexpr double same_time = 1e-9;  // of the duration
  const auto joints = sliding_joints(run.scene);
  constexpr std::array axes{"x", "y", "z"};
  const bool several = joints.size() > 1;
  const std::string of = several ? "joint" + std::to_string(which) + "_" : "";
  const auto column = [&](std::size_t axis) {
    const std::string name = several ? of + "mass_position_" + axes[axis] : std::string("mass_position.") + axes[axis];
    return run.column(find_quantity(run.scene, name));
  };
  const auto x = column(across), y = column(up);
  const auto marks = run.column(find_quantity(run.scene, several ? of + "position" : "joint_position"));
  const SupportType held = joints[which].support;
  const std::string kind = held == SupportType::pin ? "ring" : held == SupportType::clamp ? "sleeve" : "mass";
  const std::string number = several ? " " + std::to_string(which) : "";
  Series masses{kind + number, {}, {}, Series::Style::points};
  for (const Configuration& shape : shapes) {
    const auto sample =
        std::ranges::find_if(run.t, [&](double t) { return std::abs(t - shape.t) <= same_time * run.scene.duration; });
    if (sample != run.t.end()) {
      masses.x.push_back(x[static_cast<std::size_t>(sample - run.t.begin())]);
      masses.y.push_back(y[static_cast<std::size_t>(sample - run.t.begin())]);
      continue;
    }
    const double mark = joint_between(run, marks, shape.t);
    const std::vector<ShapePoint> points = points_along(run.scene, shape, intervals(run));
    const auto nearest =
        std::ranges::min_element(points, {}, [mark](const ShapePoint& point) { return std::abs(point.x - mark); });
    masses.x.push_back(std::isfinite(mark) ? nearest->r[across] : nan);
    masses.y.push_back(std::isfinite(mark) ? nearest->r[up] : nan);
  }
  return masses;
}

/// The point masses of the shapes, which keep their material points; those are nodes of the even mesh at t = 0.
Series point_masses_at(const RunFile& run, const std::vector<Configuration>& shapes, std::size_t across,
                       std::size_t up) {
  Series masses{run.scene.point_masses.size() == 1 ? "point mass" : "point masses", {}, {}, Series::Style::points};
  const double l = beam_length(run.scene) / run.scene.beam.elements;
  for (const Configuration& shape : shapes) {
    const std::vector<ShapePoint> points = points_along(run.scene, shape, intervals(run));
    for (const PointMassSpec& mass : run.scene.point_masses) {
      const double x = mass.position.value_or(mass.node * l);
      const auto nearest =
          std::ranges::min_element(points, {}, [x](const ShapePoint& point) { return std::abs(point.x - x); });
      masses.x.push_back(nearest->r[across]);
      masses.y.push_back(nearest->r[up]);
    }
  }
  return masses;
}

/// A body of an assembly at the times of the shapes, as far as there are samples then.
Series body_at(const RunFile& run, const std::string& name, const std::vector<Configuration>& shapes,
               std::size_t across, std::size_t up) {
  Series series{name, {}, {}, Series::Style::points};
  const char* const axes = "xyz";
  const auto places = [&](std::size_t axis) {
    return run.column(find_quantity(run.scene, name + ".position." + axes[axis]));
  };
  const std::vector<double> x = places(across), y = places(up);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (i > 0 && shapes[i].t == shapes[i - 1].t) continue;
    const auto at = static_cast<std::size_t>(std::ranges::find(run.t, shapes[i].t) - run.t.begin());
    const bool there = at < run.t.size();
    series.x.push_back(there ? x[at] : std::numeric_limits<double>::quiet_NaN());
    series.y.push_back(there ? y[at] : std::numeric_limits<double>::quiet_NaN());
  }
  return series;
}

/// Whether a joint is a wheel of its own or one of a block's.
bool is_wheel(const Scene& scene, std::size_t joint) {
  const auto of_it = [joint](const BlockSpec& block) {
    return std::ranges::find(block.joints, static_cast<int>(joint)) != block.joints.end();
  };
  return sliding_joints(scene)[joint].pulley || std::ranges::any_of(scene.blocks, of_it);
}

/// At how many times shapes were kept: of several beams there is one each.
std::size_t times_of(const std::vector<Configuration>& shapes) {
  std::size_t times = 0;
  for (std::size_t i = 0; i < shapes.size(); ++i) times += i == 0 || shapes[i].t != shapes[i - 1].t ? 1 : 0;
  return times;
}

Diagram shape_diagram(const RunFile& run, const std::vector<Configuration>& shapes) {
  const auto [across, up] = axes_of(run, shapes);
  constexpr std::array names{"X (m)", "Y (m)", "Z (m)"};
  const std::string plane =
      run.scene.dimension == 3 ? std::string(", ") + names[across][0] + names[up][0] + " plane" : "";
  Diagram diagram{.title = title_of(run) + plane,
                  .x_label = names[across],
                  .y_label = names[up],
                  .series = {},
                  .equal_scales = true,
                  .ordered_colours = true,
                  .key_title = time_label(run)};
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Configuration& shape = shapes[i];
    if (i > 0 && shape.t == shapes[i - 1].t && !shape.beam.empty()) {  // of the same instant: a gap, and another beam
      diagram.series.back().x.push_back(std::numeric_limits<double>::quiet_NaN());
      diagram.series.back().y.push_back(std::numeric_limits<double>::quiet_NaN());
    } else {
      std::array<char, 32> time{};
      std::snprintf(time.data(), time.size(), "%.4g", shape.t);
      diagram.series.push_back({time.data(), {}, {}});
    }
    for (const ShapePoint& point : points_along(run.scene, shape, intervals(run))) {
      diagram.series.back().x.push_back(point.r[across]);
      diagram.series.back().y.push_back(point.r[up]);
    }
  }
  diagram.equal_scales = comparable(diagram);
  if (!diagram.equal_scales) diagram.y_label += ", on a scale of its own";
  diagram.in_time = run.scene.analysis != Analysis::statics;
  diagram.symbols = symbols_of(run, shapes, across, up);
  for (std::size_t i = 0; i < sliding_joints(run.scene).size(); ++i) {
    diagram.series.push_back(masses_at(run, shapes, across, up, i));
    if (!is_wheel(run.scene, i)) continue;
    const Series& places = diagram.series.back();
    for (std::size_t k = 0; k < places.x.size(); ++k) {
      if (std::isfinite(places.x[k]) && std::isfinite(places.y[k]))
        diagram.symbols.push_back(wheel_at(run.scene, shapes[k], {places.x[k], places.y[k]}, across, up, k));
    }
  }
  if (!run.scene.point_masses.empty()) diagram.series.push_back(point_masses_at(run, shapes, across, up));
  if (run.scene.assembly) {
    for (const BodySpec& body : run.scene.assembly->bodies) {
      diagram.series.push_back(body_at(run, body.name, shapes, across, up));
    }
    const std::vector<Symbol> links = link_symbols(run, shapes, across, up);
    diagram.symbols.insert(diagram.symbols.end(), links.begin(), links.end());
  }
  return diagram;
}

/// What stands along a shape.
using AlongShape = std::function<double(const ShapePoint&)>;
struct AlongKind {
  const char* name;
  const char* label;
  AlongShape of;
};
const std::vector<AlongKind>& along_kinds() {
  static const std::vector<AlongKind> kinds{
      {"strain", "axial strain (-)", &ShapePoint::strain},
      {"tension", "axial force (N)", &ShapePoint::tension},
      {"curvature", "curvature from the rest shape (1/m)", &ShapePoint::curvature},
      {"moment", "bending moment (N m)", [](const ShapePoint& point) { return point.force.moment; }},
      {"shear", "shear force (N)", [](const ShapePoint& point) { return point.force.shear; }},
      {"torque", "torque (N m)", [](const ShapePoint& point) { return point.force.torque; }}};
  return kinds;
}

/// A quantity along the beam, at the times kept.
Diagram along_diagram(const RunFile& run, const AlongShape& member, const std::string& label) {
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
    series.title = (shape.beam.empty() ? "" : shape.beam + ", ") + time.data();
    for (const ShapePoint& point : points_along(run.scene, shape, intervals(run))) {
      series.x.push_back(point.x);
      series.y.push_back(member(point));
    }
    diagram.series.push_back(std::move(series));
  }
  return diagram;
}

/// A name as a legend says it: "joint_position" is "joint position", "energy.axial" is "axial strain".
std::string words_of(const std::string& name) {
  if (name == "energy.axial") return "axial strain";
  std::string words = name.starts_with("energy.") ? name.substr(7) : name;
  std::ranges::replace(words, '_', ' ');
  std::ranges::replace(words, '.', ' ');
  return words;
}

/// The parts of the energy whose sum is the total, then the total; parts that are 0 throughout are left out. Work that
/// was supplied comes last: the total changes by it.
std::vector<std::string> energies_of(const RunFile& run) {
  std::vector<std::string> names;
  for (const char* const name : {"energy.kinetic", "energy.axial", "energy.bending", "energy.torsion", "energy.gravity",
                                 "energy.dissipated", "energy.total", "energy.supplied"}) {
    const auto all = quantities(run.scene);
    if (std::ranges::none_of(all, [&](const Quantity& known) { return known.name == name; })) continue;
    const auto values = run.column(find_quantity(run.scene, name));
    const bool there = std::ranges::any_of(values, [](double value) { return std::isfinite(value) && value != 0; });
    if (there || name == std::string("energy.total")) names.emplace_back(name);
  }
  return names;
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
    diagram.series.push_back({words_of(quantity.name), run.t, run.column(quantity)});
  }
  if (label.empty())
    diagram.y_label = (names.size() == 1 ? diagram.series.front().title : std::string("value")) + " (" + unit + ")";
  return diagram;
}

/// A quantity along the beam and over time, by the shapes that were kept.
Diagram field_diagram(const RunFile& run, const AlongShape& member, const std::string& label) {
  constexpr std::size_t points = 120;
  const auto shapes = shapes_of(run);
  if (run.scene.assembly) {
    throw InvalidInput("--what", "a report of several beams", "fields and envelopes are of one beam");
  }
  if (shapes.size() < 2) {
    throw InvalidInput("--what", "a report with one shape", "a field takes several: run the scene with --frames 100");
  }
  Diagram diagram{
      .title = title_of(run), .x_label = time_label(run), .y_label = "material coordinate (m)", .series = {}};
  diagram.field.label = label;
  for (const Configuration& shape : shapes) {
    const std::vector<ShapePoint> along = points_along(run.scene, shape, intervals(run));
    std::vector<double> xs(points), values(points);
    std::size_t k = 0;
    for (std::size_t i = 0; i < points; ++i) {
      const double part = static_cast<double>(i) / (points - 1);
      xs[i] = along.front().x + part * (along.back().x - along.front().x);
      while (k + 2 < along.size() && along[k + 1].x < xs[i]) ++k;
      const double step = along[k + 1].x - along[k].x;
      const double u = step > 0 ? std::clamp((xs[i] - along[k].x) / step, 0.0, 1.0) : 0;
      values[i] = (1 - u) * member(along[k]) + u * member(along[k + 1]);
    }
    diagram.field.x.push_back(shape.t);
    diagram.field.y.push_back(std::move(xs));
    diagram.field.values.push_back(std::move(values));
  }
  return diagram;
}

/// The least and the largest at each material coordinate, of the shapes that were kept.
Diagram envelope_diagram(const RunFile& run, const AlongShape& member, const std::string& label) {
  const Diagram all = field_diagram(run, member, label);
  Series least{"least", {}, {}}, largest{"largest", {}, {}};
  for (std::size_t i = 0; i < all.field.y.front().size(); ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& values : all.field.values) {
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
    }
    for (Series* const series : {&least, &largest}) series->x.push_back(all.field.y.back()[i]);
    least.y.push_back(low);
    largest.y.push_back(high);
  }
  return {.title = title_of(run) + ", envelope of " + std::to_string(all.field.x.size()) + " shapes",
          .x_label = "material coordinate (m)",
          .y_label = label,
          .series = {largest, least}};
}

/// The kind of this name and suffix, or null.
const AlongKind* kind_of(const std::string& what, const std::string& suffix) {
  const auto found =
      std::ranges::find_if(along_kinds(), [&](const AlongKind& kind) { return kind.name + suffix == what; });
  return found == along_kinds().end() ? nullptr : &*found;
}

}  // namespace

std::vector<std::string> plot_kinds() {
  std::vector<std::string> kinds{"shape", "energy", "tip", "joint"};
  for (const char* const suffix : {"", "-field", "-envelope"}) {
    for (const AlongKind& kind : along_kinds()) kinds.push_back(kind.name + std::string(suffix));
  }
  kinds.emplace_back("animation");
  return kinds;
}

void plot_run(const RunFile& run, const std::string& what, const std::vector<std::string>& names, const Look& look,
              const std::filesystem::path& figure) {
  if (what == "animation") {
    const auto shapes = shapes_of(run);
    return draw_frames(shape_diagram(run, shapes), look, times_of(shapes), shapes.back().t - shapes.front().t, figure);
  }
  Diagram diagram;
  if (what.empty() && !names.empty()) {
    diagram = history_diagram(run, names, "");
  } else if (what == "shape") {
    diagram = shape_diagram(run, shapes_of(run));
  } else if (what == "energy") {
    diagram = history_diagram(run, energies_of(run), "energy (J)");
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
  } else if (const AlongKind* const kind = kind_of(what, "-field")) {
    return draw_diagram(field_diagram(run, kind->of, kind->label), look, figure);
  } else if (const AlongKind* const enveloped = kind_of(what, "-envelope")) {
    diagram = envelope_diagram(run, enveloped->of, enveloped->label);
  } else if (const AlongKind* const along = kind_of(what, "")) {
    diagram = along_diagram(run, along->of, along->label);
  } else {
    throw InvalidInput(
        "--what", "\"" + what + "\"",
        "the nearest is \"" + nearest_of(what, plot_kinds()) + "\" (there are: " + quoted_list(plot_kinds()) + ")");
  }
  check_not_empty(diagram, what);
  draw_diagram(diagram, look, figure);
}

void plot_convergence(const Json& report, const Look& look, const std::filesystem::path& figure) {
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
  draw_diagram(diagram, look, figure);
}

void plot_influence(const std::string& title, const Influence& found, const Look& look,
                    const std::filesystem::path& figure) {
  const bool one = found.lines.size() == 1;
  const std::string unit = found.lines.front().unit;
  const bool one_unit = std::ranges::all_of(found.lines, [&](const auto& line) { return line.unit == unit; });
  Diagram diagram{.title = (title.empty() ? "" : title + ": ") +
                           (one ? "influence line of " + found.lines.front().quantity : "influence lines"),
                  .x_label = "material coordinate of the load (m)",
                  .y_label = one_unit ? "ordinate (" + unit + ")" : "ordinate (units in the key)",
                  .series = {}};
  for (const Influence::Line& line : found.lines) {
    diagram.series.push_back({line.quantity + (one_unit ? "" : " (" + line.unit + ")"), found.x, line.ordinates});
  }
  draw_diagram(diagram, look, figure);
}

}  // namespace vlbeam
