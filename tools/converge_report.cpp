#include <array>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "io/json.hpp"
#include "io/quantity.hpp"
#include "io/scene_json.hpp"
#include "scene/names.hpp"
#include "scene/options.hpp"
#include "tools/converge.hpp"
#include "tools/converge_setting.hpp"

namespace vlbeam {
namespace {

constexpr std::array<const char*, 3> refined_names{"mesh", "time", "quadrature"};

Json setting_json(const Scene& scene, const Setting& setting) {
  Json json = {{"elements", setting.elements}, {"quadrature_points", setting.points}};
  if (scene.analysis == Analysis::dynamics) json[accuracy_name(scene)] = setting.accuracy;
  return json;
}

}  // namespace

Json convergence_to_json(const Scene& given, const Convergence& found) {
  const Scene scene = to_converge(given);
  Json json = {{"schema_version", "vlbeam.converge/1"},
               {"title", scene.title},
               {"quantity", found.quantity},
               {"unit", found.unit},
               {"t", found.t},
               {"error", found.error},
               {"answer", number_or_null(found.answer)},
               {"uncertainty", number_or_null(found.uncertainty)},
               {"reached", found.reached}};
  if (!found.reached) json["reason"] = found.reason;
  if (scene.analysis == Analysis::dynamics) json["predictable_until"] = found.predictable_until;
  if (found.horizon) json["horizon"] = *found.horizon;
  json["setting"] = found.cheapest ? setting_json(scene, *found.cheapest) : Json();
  json["finest"] = setting_json(scene, found.finest);
  Json& parts = json["parts"] = Json::object();
  for (std::size_t i = 0; i < refined_names.size(); ++i) {
    if (found.parts[i]) parts[refined_names[i]] = grid_convergence_to_json(*found.parts[i]);
  }
  Json& levels = json["levels"] = Json::array();
  for (const ConvergeLevel& level : found.levels) {
    Json row = {{"refined", refined_names[static_cast<std::size_t>(level.refined)]}};
    row.update(setting_json(scene, level.setting));
    row["value"] = number_or_null(level.value);
    row["difference"] = number_or_null(std::abs(level.value - found.answer));
    row["error_bound"] = number_or_null(std::abs(level.value - found.answer) + found.uncertainty);
    row["work"] = level.work;
    row["events"] = level.events;
    if (!level.failure.empty()) row["failure"] = level.failure;
    levels.push_back(row);
  }
  json["cost"] = {{"runs", found.levels.size()}, {"in_runs_of_the_finest", number_or_null(found.cost)}};
  const bool settled = found.cheapest.has_value();
  json["scene"] = scene_to_json(settled ? with_setting(scene, *found.cheapest) : scene);
  return json;
}

std::string convergence_table(const Scene& given, const Convergence& found) {
  const Scene scene = to_converge(given);
  const bool in_time = scene.analysis == Analysis::dynamics;
  const std::string accuracy = in_time ? "," + accuracy_name(scene) + (has_step(scene) ? " [s]" : " [-]") : "";
  std::string text = "refined,elements,quadrature_points" + accuracy + ",value [" + found.unit + "],difference [" +
                     found.unit + "],error_bound [" + found.unit + "],work [element evaluations],events\n";
  const auto number = [](double value) { return std::isfinite(value) ? number_text(value) : std::string(); };
  for (const ConvergeLevel& level : found.levels) {
    text += std::string(refined_names[static_cast<std::size_t>(level.refined)]) + "," +
            std::to_string(level.setting.elements) + "," + std::to_string(level.setting.points) +
            (in_time ? "," + number_text(level.setting.accuracy) : "") + "," + number(level.value) + "," +
            number(std::abs(level.value - found.answer)) + "," +
            number(std::abs(level.value - found.answer) + found.uncertainty) + "," + number(level.work) + "," +
            std::to_string(level.events) + "\n";
  }
  return text;
}

std::string level_line(const Scene& scene, const ConvergeLevel& level) {
  constexpr std::size_t width = 12;
  const std::string refined = refined_names[static_cast<std::size_t>(level.refined)];
  return "  " + refined + std::string(width - refined.size(), ' ') + setting_text(scene, level.setting) + ": " +
         (level.failure.empty() ? in_digits(level.value, 10) : level.failure) + ", " + in_digits(level.seconds, 2) +
         " s\n";
}

std::string convergence_summary(const Scene& given, const Convergence& found) {
  const Scene scene = to_converge(given);
  std::ostringstream text;
  const bool known = std::isfinite(found.answer);
  const bool in_time = scene.analysis == Analysis::dynamics;
  text << found.quantity << (in_time ? " at t = " + number_text(found.t) + " s" : " of the equilibrium") << ": ";
  if (known) {
    text << in_digits(found.answer, 10) << " +- " << in_digits(found.uncertainty, 2) << " " << found.unit << '\n';
  } else {
    text << "nothing is known yet\n";
  }
  for (std::size_t i = 0; i < refined_names.size(); ++i) {
    if (!found.parts[i]) continue;
    const GridConvergence& part = *found.parts[i];
    text << "  " << refined_names[i] << std::string(12 - std::string_view(refined_names[i]).size(), ' ') << "+- "
         << in_digits(part.uncertainty, 2)
         << (part.order ? ", order " + in_digits(*part.order, 3) : ", no order: " + part.refusal) << '\n';
  }
  if (found.reached) {
    text << "  the error wanted, " << in_digits(found.error, 3) << ", is reached\n";
    if (found.cheapest) text << "  cheapest    " << setting_text(scene, *found.cheapest) << '\n';
  } else {
    text << "  the error wanted, " << in_digits(found.error, 3) << ", is NOT reached: " << found.reason << '\n';
    if (known && in_time) text << "  it is kept until t = " << number_text(found.predictable_until) << " s\n";
  }
  if (found.horizon) {
    text << "  horizon     a density changed in its 8th digit matters less than that until t = "
         << number_text(*found.horizon) << " s\n";
  }
  if (known) text << "  finest      " << setting_text(scene, found.finest) << '\n';
  text << "  cost        " << found.levels.size() << (found.levels.size() == 1 ? " run" : " runs");
  if (known) text << ", worth " << in_digits(found.cost, 3) << " of the finest";
  text << '\n';
  return text.str();
}

}  // namespace vlbeam
