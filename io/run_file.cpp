#include "io/run_file.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "io/scene_json.hpp"

namespace vlbeam {
namespace {

Point point_from(const Json& json) {
  Point point{};
  for (std::size_t i = 0; i < json.size() && i < point.size(); ++i) point[i] = json[i].get<double>();
  return point;
}

std::vector<Point> points_from(const Json& json) {
  std::vector<Point> points;
  for (const Json& item : json) points.push_back(point_from(item));
  return points;
}

Configuration configuration_from(const Json& json) {
  Configuration shape;
  shape.t = json.at("t").get<double>();
  shape.beam = json.value("beam", "");
  shape.x = json.at("x").get<std::vector<double>>();
  shape.r = points_from(json.at("r"));
  shape.r_x = points_from(json.at("r_x"));
  shape.weights = json.at("weights").get<std::vector<std::array<double, 4>>>();
  shape.rates.x = json.at("x_rate").get<std::vector<double>>();
  shape.rates.v = points_from(json.at("v"));
  shape.rates.r_x = points_from(json.at("r_x_rate"));
  if (json.contains("rest")) {
    shape.rest = {points_from(json.at("rest").at("r")), points_from(json.at("rest").at("r_x"))};
  }
  const auto add_kink = [&shape](const Json& kink) {
    shape.kinks.push_back(
        {kink.at("node").get<std::size_t>(), point_from(kink.at("r_x")), point_from(kink.at("r_x_rate"))});
  };
  if (json.contains("kink")) add_kink(json.at("kink"));
  if (json.contains("kinks")) {
    for (const Json& kink : json.at("kinks")) add_kink(kink);
  }
  if (json.contains("actions")) {
    for (const Json& action : json.at("actions")) {
      shape.actions.push_back({action.at("x").get<double>(), point_from(action.at("force"))});
    }
  }
  if (json.contains("moments")) shape.moments = json.at("moments").get<std::vector<std::array<Point, 2>>>();
  return shape;
}

/// What a report lacks or has of another type is an error of its reader, and names the file.
template <class Function>
auto understanding(const std::filesystem::path& path, const Function& function) {
  try {
    return naming_file(path, function);
  } catch (const Json::exception& error) {
    throw InvalidInput(path.string(), "this report",
                       std::string("it must be as vlbeam run writes it: ") + error.what());
  }
}

}  // namespace

bool at_same_time(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(1.0, std::abs(a)); }

std::vector<double> RunFile::column(const Quantity& quantity) const {
  return understanding(path, [&] { return quantity.of(json.at("samples")); });
}

std::vector<Configuration> RunFile::configurations() const {
  return understanding(path, [&] {
    std::vector<Configuration> shapes;
    for (const Json& shape : json.at("configurations")) shapes.push_back(configuration_from(shape));
    return shapes;
  });
}

RunFile read_run_file(const std::filesystem::path& path) {
  RunFile file;
  file.path = path;
  file.json = read_json(path);
  understanding(path, [&file] {
    const Json version = file.json.is_object() ? file.json.value("schema_version", Json()) : file.json;
    if (version.is_null() && file.json.is_object() && file.json.contains("beam")) {
      throw InvalidInput("/schema_version", InvalidInput::missing,
                         "this is a scene; run it first, vlbeam run --report REPORT.json, and give the report");
    }
    if (version != "vlbeam.run/1") {
      throw InvalidInput("/schema_version", excerpt(version), "it must be \"vlbeam.run/1\", the report of a run");
    }
    file.scene = scene_from_json(file.json.at("scene"));
    file.t = file.json.at("samples").at("t").get<std::vector<double>>();
  });
  return file;
}

}  // namespace vlbeam
