#include "io/moordyn.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <sstream>
#include <utility>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "io/nearest.hpp"

namespace vlbeam {
namespace {

using Place = std::array<double, 3>;

constexpr int fewest_elements = 10, most_elements = 60;
constexpr double same_place = 1e-9;  // of the largest distance

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::optional<double> number_of(const std::string& word) {
  try {
    std::size_t end = 0;
    const double value = std::stod(word, &end);
    if (end == word.size() && std::isfinite(value)) return value;
  } catch (const std::exception&) {  // it is none
  }
  return {};
}

/// A row of a table of the file: its words, and under which names its columns stand.
struct TableRow {
  int line;
  std::vector<std::string> words;
  std::vector<std::string> columns;

  std::optional<std::string> text(const std::vector<std::string>& names) const {
    for (std::size_t i = 0; i < std::min(columns.size(), words.size()); ++i) {
      if (std::ranges::find(names, columns[i]) != names.end()) return words[i];
    }
    return {};
  }
  std::string needed(const std::vector<std::string>& names) const {
    if (const auto found = text(names)) return *found;
    throw InvalidInput("line " + std::to_string(line), "no column " + names.front(),
                       "the table's first line names its columns, as in MoorDyn's documents");
  }
  double number(const std::vector<std::string>& names, std::optional<double> otherwise = {}) const {
    const auto word = text(names);
    if (!word && otherwise) return *otherwise;
    const std::string found = needed(names);
    if (const auto value = number_of(found)) return *value;
    throw InvalidInput("line " + std::to_string(line) + ", " + names.front(), "\"" + found + "\"",
                       "it must be a number; curves of stress and strain are not read");
  }
};

/// A number > 0 of a row.
double positive(const TableRow& row, const std::vector<std::string>& names) {
  const double value = row.number(names);
  if (value > 0) return value;
  throw InvalidInput("line " + std::to_string(row.line) + ", " + names.front(), six_digits(value), "it must be > 0");
}

/// The tables of a file, by what their headlines say.
struct Tables {
  std::vector<TableRow> types, points, lines, rods, bodies;
  std::map<std::string, double> options;
};

bool is_headline(const std::string& line) { return line.starts_with("---"); }

/// Whose table a headline begins.
std::vector<TableRow>* table_of(Tables& tables, const std::string& headline) {
  const auto says = [&headline](const char* word) { return headline.find(word) != std::string::npos; };
  if (says("line types") || says("line dictionary")) return &tables.types;
  if (says("rod types") || says("rod dictionary")) return nullptr;
  if (says("rod")) return &tables.rods;
  if (says("bod")) return &tables.bodies;
  if (says("point") || says("node") || says("connection")) return &tables.points;
  if (says("lines") || says("line prop") || says("line list")) return &tables.lines;
  return nullptr;
}

Tables tables_of(const std::string& text) {
  Tables tables;
  std::istringstream stream(text);
  std::vector<TableRow>* table = nullptr;
  std::vector<std::string> columns;
  bool options = false, headed = false;
  int number = 0, heading = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const std::string said = lower(line);
    if (is_headline(said)) {
      table = table_of(tables, said);
      options = said.find("option") != std::string::npos;
      headed = headed || table != nullptr;
      heading = 0;
      continue;
    }
    const auto words = words_of(line);
    if (words.empty() || words[0].starts_with("#")) continue;
    if (options) {
      if (words.size() < 2) continue;
      if (const auto value = number_of(words[0])) tables.options[lower(words[1])] = *value;
    } else if (table != nullptr) {
      ++heading;
      if (heading == 1) columns = words_of(said);
      if (heading > 2) table->push_back({number, words, columns});  // the second line has units
    }
  }
  if (!headed) {
    throw InvalidInput("the file", "no table of lines", "it must be an input of MoorDyn: LINE TYPES, POINTS, LINES");
  }
  return tables;
}

struct LinePoint {
  std::string name;
  enum class Kind { fixed, coupled, free } kind = Kind::fixed;
  Place at{};
  double mass = 0, volume = 0;
};

struct LineType {
  double diameter, mass, stiffness, damping, normal_drag, tangential_drag, bending;
};

/// Where a line is drawn: its corners, and where the support at one of its ends then takes that.
struct Drawn {
  std::vector<Place> corners;
  std::optional<std::size_t> pulled;  ///< 0: its first end, 1: its last one
  Place by{};
};

Place between(const Place& a, const Place& b, double part) {
  return {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]), a[2] + part * (b[2] - a[2])};
}
double distance(const Place& a, const Place& b) { return portable::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }
double length_of(const std::vector<Place>& corners) {
  double length = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) length += distance(corners[i - 1], corners[i]);
  return length;
}

/// Corners of a slack line over a floor: down from one point, along the floor, up to the other. `part` of the way
/// between the points is spared at each end; below 0 it goes beyond them.
std::vector<Place> along_floor(const Place& a, const Place& b, double floor, double part) {
  const Place c = between(a, b, part), d = between(b, a, part);
  return {a, {c[0], c[1], floor}, {d[0], d[1], floor}, b};
}

Drawn drawn(const Place& a, const Place& b, double length, std::optional<double> floor, bool first_held, bool last_held,
            int line) {
  const double chord = distance(a, b);
  if (chord <= same_place * length) {
    throw InvalidInput("line " + std::to_string(line), "both ends at one place", "its points must be apart");
  }
  if (length < chord) {
    if (last_held)
      return {{a, between(a, b, length / chord)},
              1,
              between({}, {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, 1 - length / chord)};
    if (first_held)
      return {{between(b, a, length / chord), b},
              0,
              between({}, {a[0] - b[0], a[1] - b[1], a[2] - b[2]}, 1 - length / chord)};
    throw InvalidInput(
        "line " + std::to_string(line), std::to_string(length) + " m of line",
        "between two free points " + std::to_string(chord) + " m apart it must be no shorter: nothing holds them");
  }
  // a V that hangs down in the vertical plane of both points
  const double across = portable::hypot(b[0] - a[0], b[1] - a[1]), sag = std::sqrt(length * length - chord * chord) / 2;
  Place corner = between(a, b, 0.5);
  const double rise = (b[2] - a[2]) / chord, level = across / chord;
  const std::array<double, 2> along =
      across > 0 ? std::array{(b[0] - a[0]) / across, (b[1] - a[1]) / across} : std::array{1.0, 0.0};
  corner = {corner[0] + sag * rise * along[0], corner[1] + sag * rise * along[1], corner[2] - sag * level};
  if (sag <= same_place * length) return {{a, b}, {}, {}};
  if (!floor || corner[2] >= *floor) return {{a, corner, b}, {}, {}};
  double low = -1, high = 0.5;  // parts
  while (length_of(along_floor(a, b, *floor, low)) < length) low *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (length_of(along_floor(a, b, *floor, middle)) > length ? low : high) = middle;
  }
  Drawn line_on_floor{{a}, {}, {}};
  for (const Place& place : along_floor(a, b, *floor, (low + high) / 2)) {
    if (distance(place, line_on_floor.corners.back()) > same_place * length) line_on_floor.corners.push_back(place);
  }
  return line_on_floor;
}

class Import {
 public:
  explicit Import(const std::string& text) : tables_(tables_of(text)) {}

  ImportedScene operator()() {
    for (const auto* rows : {&tables_.rods, &tables_.bodies}) {
      if (rows->empty()) continue;
      throw InvalidInput("line " + std::to_string(rows->front().line), rows == &tables_.rods ? "a rod" : "a body",
                         "lines between points are read; write \"bodies\" and \"links\" into the scene yourself");
    }
    read_options();
    read_types();
    read_points();
    if (tables_.lines.empty()) throw InvalidInput("the file", "no line", "there must be one under LINES");
    if (points_.empty()) throw InvalidInput("the file", "no point", "lines need two under POINTS");
    lay_axes();
    Json scene{{"schema", "vlbeam.scene/1"}, {"title", "Lines of a MoorDyn input"}};
    if (!plane_) scene["dimension"] = 3;
    scene["gravity"] = place({0, 0, -gravity_});
    scene["analysis"] = "statics";
    std::vector<Json> beams;
    for (const TableRow& row : tables_.lines) beams.push_back(line_of(row));
    const bool free_points =
        std::ranges::any_of(points_, [](const LinePoint& p) { return p.kind == LinePoint::Kind::free; });
    if (beams.size() == 1 && !free_points) {
      Json beam = Json::object();
      for (const auto& [key, value] : beams[0].items()) {
        if (key == "curve" || key == "section" || key == "material" || key == "elements") beam[key] = value;
      }
      scene["beam"] = beam;
      for (const auto& [key, value] : beams[0].items()) {
        if (!beam.contains(key) && key != "name") scene[key] = value;
      }
    } else {
      scene["beams"] = beams;
      tie(scene);
    }
    for (const char* const what : {"added mass (Can, Cat), waves and currents", "the file's outputs and time steps"}) {
      left_out_.push_back(what);
    }
    return {std::move(scene), std::move(left_out_)};
  }

 private:
  double option(const std::vector<std::string>& names, double otherwise) const {
    for (const std::string& name : names) {
      if (const auto found = tables_.options.find(name); found != tables_.options.end()) return found->second;
    }
    return otherwise;
  }

  void read_options() {
    gravity_ = option({"g", "gravity"}, 9.80665);
    density_ = option({"rhow", "rho", "wtrdnsty", "wtrdens", "wtrden"}, 1025);
    const double depth = option({"wtrdpth", "depth"}, 0);
    if (depth > 0) floor_ = -depth;
    floor_stiffness_ = option({"kbot", "kb"}, 3e6);
    floor_damping_ = option({"cbot", "cb"}, 3e5);
    const double friction = option({"frictioncoefficient", "mu_kt", "mu_ka"}, 0);
    if (friction > 0) left_out_.push_back("friction of the seabed, which acts in a motion only: /ground/friction");
  }

  void read_types() {
    for (const TableRow& row : tables_.types) {
      LineType type{};
      type.diameter = row.number({"diam", "diameter"});
      type.mass = positive(row, {"massden", "massdeninair", "mass/m"});
      type.stiffness = positive(row, {"ea"});
      type.damping = row.number({"ba/-zeta", "ba", "ba/zeta", "cint", "c"}, 0);
      type.normal_drag = row.number({"cd", "cdn"}, 0);
      type.tangential_drag = row.number({"cdax", "cdt"}, 0);
      type.bending = row.number({"ei"}, 0);
      types_[row.needed({"name", "linetype", "typename", "type"})] = type;
    }
  }

  void read_points() {
    for (const TableRow& row : tables_.points) {
      LinePoint point;
      point.name = row.needed({"id", "node", "point", "connection"});
      const std::string kind = lower(row.needed({"attachment", "type", "att"}));
      if (kind.starts_with("fix") || kind.starts_with("anchor")) {
        point.kind = LinePoint::Kind::fixed;
      } else if (kind.starts_with("vessel") || kind.starts_with("coupled") || kind.starts_with("cpld") ||
                 kind.starts_with("fair")) {
        point.kind = LinePoint::Kind::coupled;
      } else if (kind.starts_with("free") || kind.starts_with("connect")) {
        point.kind = LinePoint::Kind::free;
      } else {
        throw InvalidInput("line " + std::to_string(row.line) + ", Attachment", "\"" + kind + "\"",
                           "a point must be Fixed, Coupled (or Vessel), or Free (or Connect)");
      }
      point.at = {row.number({"x"}), row.number({"y"}), row.number({"z"})};
      point.mass = row.number({"m", "mass"}, 0);
      point.volume = row.number({"v", "vol", "volume"}, 0);
      if (row.number({"cda"}, 0) > 0 || row.number({"ca"}, 0) > 0) drag_of_points_ = true;
      points_.push_back(point);
    }
    if (drag_of_points_) left_out_.push_back("drag and added mass of points (CdA, CA)");
  }

  std::size_t point_at(const TableRow& row, const std::vector<std::string>& names) const {
    std::string name = row.needed(names);
    const auto found = std::ranges::find_if(points_, [&](const LinePoint& point) {
      return point.name == name || lower(name) == "c" + point.name || lower(name) == "p" + point.name ||
             lower(name) == "n" + point.name;
    });
    if (found == points_.end()) {
      throw InvalidInput("line " + std::to_string(row.line) + ", " + names.front(), "\"" + name + "\"",
                         "there is no point of that name; ends on rods and bodies are not read");
    }
    return static_cast<std::size_t>(found - points_.begin());
  }

  /// A scene whose points all stand in one vertical plane is one in the plane.
  void lay_axes() {
    const Place& origin = points_.front().at;
    double far = 0;
    for (const LinePoint& point : points_) {
      const double way = portable::hypot(point.at[0] - origin[0], point.at[1] - origin[1]);
      if (way > far) {
        far = way;
        along_ = {(point.at[0] - origin[0]) / way, (point.at[1] - origin[1]) / way};
      }
    }
    if (along_[0] < 0 || (along_[0] == 0 && along_[1] < 0)) along_ = {-along_[0], -along_[1]};
    plane_ = std::ranges::all_of(points_, [&](const LinePoint& point) {
      return std::abs((point.at[0] - origin[0]) * along_[1] - (point.at[1] - origin[1]) * along_[0]) <=
             same_place * std::max(far, 1e-300);
    });
    // a plane through the vertical axis keeps its distances from there
    if (plane_ && (along_[0] != 1 || origin[1] != 0))
      left_out_.push_back("where the vertical plane of the lines stands: x is the way along it");
  }

  Json place(const Place& p) const {
    if (plane_) return {p[0] * along_[0] + p[1] * along_[1], p[2]};
    return {p[0], p[1], p[2]};
  }

  Json line_of(const TableRow& row) {
    const std::string name = row.needed({"id", "line"});
    const std::string type_name = row.needed({"linetype", "type"});
    const auto known = types_.find(type_name);
    if (known == types_.end()) {
      std::vector<std::string> names;
      for (const auto& entry : types_) names.push_back(entry.first);
      throw InvalidInput(
          "line " + std::to_string(row.line) + ", LineType", "\"" + type_name + "\"",
          names.empty() ? "the file names no type" : "the nearest is \"" + nearest_of(type_name, names) + "\"");
    }
    const LineType& type = known->second;
    const std::array<std::size_t, 2> ends{point_at(row, {"attacha", "nodeanch", "nodea"}),
                                          point_at(row, {"attachb", "nodefair", "nodeb"})};
    const double length = positive(row, {"unstrlen", "length"});
    const int segments = static_cast<int>(std::clamp(positive(row, {"numsegs", "numseg"}), 1.0, 1e6));
    const auto held = [&](std::size_t end) { return points_[ends[end]].kind != LinePoint::Kind::free; };
    const Drawn shape = drawn(points_[ends[0]].at, points_[ends[1]].at, length, floor_, held(0), held(1), row.line);
    const bool straight = shape.corners.size() == 2;

    Json beam{{"name", "line " + name}};
    Json corners = Json::array();
    for (const Place& corner : shape.corners) corners.push_back(place(corner));
    beam["curve"] = straight ? Json{{"type", "line"}, {"start", corners[0]}, {"end", corners[1]}}
                             : Json{{"type", "polyline"}, {"points", corners}};
    if (type.bending > 0 && !straight) {
      left_out_.push_back("the bending stiffness of line " + name + ", which is drawn with corners");
    }
    beam["section"] = {{"type", "stiffness"},
                       {"EA", type.stiffness},
                       {"EI", straight && plane_ ? type.bending : 0},
                       {"rhoA", type.mass}};
    const double damping = type.damping >= 0
                               ? type.damping / type.stiffness
                               : -type.damping * length / segments * std::sqrt(type.mass / type.stiffness);
    if (damping > 0) beam["material"] = {{"damping", damping}};
    beam["elements"] = std::clamp(segments, fewest_elements, most_elements);
    Json supports = Json::array();
    for (const std::size_t end : {0U, 1U}) {
      if (!held(end)) continue;
      Json support{{"at", end == 0 ? "start" : "end"}, {"type", "pin"}};
      if (shape.pulled == end) support["motion"] = pulled(shape.by);
      supports.push_back(support);
    }
    if (!supports.empty()) beam["supports"] = supports;
    beam["places"] = Json::array({{{"name", "A"}, {"end", "start"}}, {{"name", "B"}, {"end", "end"}}});
    const double area = std::numbers::pi / 4 * type.diameter * type.diameter;
    if (density_ > 0 && area > 0) beam["fluid"] = {{"density", density_}, {"area", area}};
    if (density_ > 0 && (type.normal_drag > 0 || type.tangential_drag > 0)) {
      beam["drag"] = {{"quadratic",
                       {{"normal", density_ * type.normal_drag * type.diameter / 2},
                        {"tangential", density_ * type.tangential_drag * std::numbers::pi * type.diameter / 2}}}};
    }
    if (floor_) {
      beam["ground"] = {{"height", *floor_},
                        {"stiffness", floor_stiffness_ * type.diameter},
                        {"damping", floor_damping_ * type.diameter}};
    }
    for (const std::size_t end : {0U, 1U}) meeting_[ends[end]].push_back({beam["name"], end == 0 ? "start" : "end"});
    return beam;
  }

  Json pulled(const Place& by) const {
    const Json way = place(by);
    Json motion = Json::object();
    const std::array<const char*, 3> axes{"x", "y", "z"};
    for (std::size_t i = 0; i < way.size(); ++i) {
      if (way[i].get<double>() != 0) motion[axes[i]] = Json::object({{"value", way[i]}});
    }
    return motion;
  }

  /// Bodies and pins of the points that nothing holds.
  void tie(Json& scene) {
    Json bodies = Json::array(), links = Json::array();
    const auto end_of = [](const std::pair<std::string, std::string>& end) {
      return Json{{"beam", end.first}, {"at", end.second}};
    };
    for (const auto& [which, ends] : meeting_) {
      const LinePoint& point = points_[which];
      if (point.kind != LinePoint::Kind::free) continue;
      const std::string name = "point " + point.name;
      if (point.mass > 0) {
        Json body{{"name", name}, {"mass", point.mass}, {"position", place(point.at)}};
        if (point.volume > 0 && density_ > 0) {
          body["loads"] = Json::array({{{"type", "force"},
                                        {"magnitude", Json::object({{"value", density_ * gravity_ * point.volume}})},
                                        {"direction", place({0, 0, 1})}}});
        }
        bodies.push_back(body);
        for (std::size_t i = 0; i < ends.size(); ++i) {
          links.push_back({{"name", name + " " + ends[i].first},
                           {"type", "pin"},
                           {"between", {end_of(ends[i]), Json::object({{"body", name}})}}});
        }
        continue;
      }
      if (point.volume > 0) left_out_.push_back("the buoyancy of " + name + ", which has no mass");
      for (std::size_t i = 1; i < ends.size(); ++i) {
        links.push_back(
            {{"name", name + " " + ends[i].first}, {"type", "pin"}, {"between", {end_of(ends[0]), end_of(ends[i])}}});
      }
    }
    if (!bodies.empty()) scene["bodies"] = bodies;
    if (!links.empty()) scene["links"] = links;
  }

  Tables tables_;
  double gravity_ = 9.80665, density_ = 1025, floor_stiffness_ = 0, floor_damping_ = 0;
  std::optional<double> floor_;
  std::map<std::string, LineType> types_;
  std::vector<LinePoint> points_;
  std::map<std::size_t, std::vector<std::pair<std::string, std::string>>> meeting_;  ///< ends of lines, by their point
  std::array<double, 2> along_{1, 0};
  bool plane_ = false, drag_of_points_ = false;
  std::vector<std::string> left_out_;
};

}  // namespace

ImportedScene scene_of_moordyn(const std::string& text) { return Import(text)(); }

}  // namespace vlbeam
