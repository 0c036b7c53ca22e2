#include "io/scene_json.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/assembly_json.hpp"
#include "io/files.hpp"
#include "io/nearest.hpp"
#include "scene/automatic_integrator.hpp"
#include "scene/corners.hpp"
#include "scene/derived.hpp"
#include "scene/options.hpp"
#include "scene/scene_options.hpp"
#include "scene/slack.hpp"
#include "scene/time_function.hpp"
#include "scene/validate.hpp"

namespace vlbeam {
namespace {

Json::json_pointer pointer(std::string_view text) { return Json::json_pointer(std::string(text)); }

/// The option table as a tree of keys; its leaves are null. A list is an object whose keys are "at=start", ...: one for
/// each entry it may have; or, if it may have any number of them, an array with one. A part that may be a number has
/// the key "".
class KeyTree {
 public:
  KeyTree() { visit_options(*this, scene_); }

  template <class T>
  void operator()(const Option& option, const T&) {
    at(option.pointer) = nullptr;
  }
  template <class T>
  bool present(const Option&, const std::optional<T>&) {
    return true;
  }
  template <class T>
  bool number_or(const Option& option, double, const std::optional<T>&) {
    at(option.pointer)[""] = nullptr;  // the number is the part's entry without a name
    return true;
  }
  template <class T>
  void list(const Option&, const std::vector<T>&) {}
  void section(const Option&) {}

  const Json& tree() const { return tree_; }

 private:
  /// What stands at one of the table's pointers, put there if nothing does. To make pointers of the library of all
  /// these texts would be a twentieth of a short run.
  Json& at(std::string_view pointer) {
    Json* node = &tree_;
    while (!pointer.empty()) {
      const std::size_t end = std::min(pointer.find('/', 1), pointer.size());
      const std::string_view key = pointer.substr(1, end - 1);
      node = key == "0" ? &(*node)[std::size_t{0}] : &(*node)[std::string(key)];
      pointer.remove_prefix(end);
    }
    return *node;
  }

  const Scene scene_ = scene_with_every_part();
  Json tree_;
};

/// Supports of points between the ends stand in the table by this key, and in a file in /supports.
constexpr const char* between_ends = "bearings";

/// The discriminating key of a list ("at"), or nothing if the tree's node is no list.
std::string list_key(const Json& node) {
  if (!node.is_object() || node.empty()) return "";
  const std::string& first = node.begin().key();
  const auto equals = first.find('=');
  return equals == std::string::npos ? "" : first.substr(0, equals);
}

std::vector<std::string> keys_of(const Json& node) {
  std::vector<std::string> keys;
  for (const auto& item : node.items()) {
    if (!item.key().empty() && item.key() != between_ends) keys.push_back(item.key());
  }
  return keys;
}

std::string unknown_key_hint(const std::string& key, const Json& node, const std::string& discriminator) {
  std::vector<std::string> known = keys_of(node);
  if (!discriminator.empty()) known.push_back(discriminator);
  if (key == "schema_version") return "this is a report; its scene stands in it under \"scene\"";
  return "the nearest known key is \"" + nearest_of(key, known) + "\" (known here: " + quoted_list(known) + ")";
}

/// A scene file whose lists are turned into objects with keys "at=start", so that the table's pointers reach
/// everything. Refuses keys the table does not know. Remembers where things stood in the file, for error messages.
class Canonical {
 public:
  /// Takes the values out of the file: one may hold millions of numbers.
  explicit Canonical(Json file) : json_(canonical(std::move(file))) {}

  const Json* find(std::string_view at) const {
    const auto where = pointer(at);
    return json_.contains(where) ? &json_.at(where) : nullptr;
  }
  bool has_parent(std::string_view at) const { return json_.contains(pointer(at).parent_pointer()); }

  /// Where the table's pointer stands in the file: "/supports/at=start/type" is "/supports/0/type".
  std::string in_file(std::string_view at) const {
    std::string text(at);
    for (const auto& [ours, theirs] : renamed_) {
      const bool whole = text.size() == ours.size() || (text.size() > ours.size() && text[ours.size()] == '/');
      if (whole && text.starts_with(ours)) return theirs + text.substr(ours.size());
    }
    return text;
  }

 private:
  Json canonical(Json file) {
    const Json tree = KeyTree().tree();
    set_apart_between_ends(file, tree);
    return object(file, tree, "", "", "");
  }

  /// Supports whose place is an object go to a list of their own.
  void set_apart_between_ends(Json& file, const Json& tree) {
    if (!file.is_object()) return;
    if (file.contains(between_ends)) {
      throw InvalidInput(std::string("/") + between_ends, "an unknown key", unknown_key_hint(between_ends, tree, ""));
    }
    if (!file.contains("supports") || !file.at("supports").is_array()) return;
    Json at_ends = Json::array(), between = Json::array();
    Json& supports = file.at("supports");
    for (std::size_t i = 0; i < supports.size(); ++i) {
      const bool is_between = supports[i].is_object() && supports[i].contains("at") && supports[i].at("at").is_object();
      if (is_between) {
        renamed_.emplace_back("/" + std::string(between_ends) + "/" + std::to_string(between.size()),
                              "/supports/" + std::to_string(i));
      } else {
        supports_at_.push_back(i);
      }
      (is_between ? between : at_ends).push_back(std::move(supports[i]));
    }
    supports = std::move(at_ends);
    if (!between.empty()) file[between_ends] = std::move(between);
  }

  /// `here` is where we are by the table's pointers, `shown` by the file's.
  Json object(Json& file, const Json& node, const std::string& here, const std::string& shown,
              const std::string& discriminator) {
    if (!file.is_object()) {
      const bool of_time = file.is_number() && node.contains("value") && node.contains("ramp");
      throw InvalidInput(shown.empty() ? "the top level" : shown, excerpt(file),
                         of_time ? "it must be an object, a function of time: {\"value\": " + excerpt(file) + "}"
                                 : "it must be an object");
    }
    Json result = Json::object();
    result.get_ref<Json::object_t&>().reserve(file.size());  // as it grows it copies what it holds
    for (auto& item : file.items()) {
      const std::string& key = item.key();
      const std::string at = here + "/" + escaped(key);
      const std::string at_shown = shown + "/" + escaped(key);
      if (key == discriminator && !key.empty()) continue;
      if (key.empty() || !node.contains(key)) {
        throw InvalidInput(at_shown, "an unknown key", unknown_key_hint(key, node, discriminator));
      }
      const Json& child = node.at(key);
      if (child.is_array()) {
        if (!item.value().is_array()) throw InvalidInput(at_shown, excerpt(item.value()), "it must be an array");
        Json& entries = result[key] = Json::array();
        for (std::size_t i = 0; i < item.value().size(); ++i) {
          const std::string entry = "/" + std::to_string(i);
          entries.push_back(object(item.value()[i], child[0], at + entry, shown_as(at + entry, at_shown + entry), ""));
        }
      } else if (!list_key(child).empty()) {
        result[key] = list(item.value(), child, at, at_shown);
      } else if (child.is_object() && !(child.contains("") && !item.value().is_object())) {
        result[key] = object(item.value(), child, at, at_shown, "");
      } else {
        result[key] = std::move(item.value());
      }
    }
    return result;
  }

  Json list(Json& file, const Json& node, const std::string& here, const std::string& shown) {
    if (!file.is_array()) throw InvalidInput(shown, excerpt(file), "it must be an array of objects");
    const std::string discriminator = list_key(node);
    std::vector<std::string> choices;
    for (const auto& item : node.items()) choices.push_back(item.key().substr(discriminator.size() + 1));
    const bool ends = here == "/supports";
    const std::string allowed =
        "it must be one of " + quoted_list(choices) + (ends ? R"(, or a place between the ends, {"x": ...})" : "");

    Json result = Json::object();
    for (std::size_t i = 0; i < file.size(); ++i) {
      Json& entry = file[i];
      const std::string entry_shown = shown + "/" + std::to_string(ends ? supports_at_[i] : i);
      if (!entry.is_object()) throw InvalidInput(entry_shown, excerpt(entry), "it must be an object");

      const std::string key_shown = entry_shown + "/" + discriminator;
      if (!entry.contains(discriminator)) throw InvalidInput(key_shown, InvalidInput::missing, allowed);
      const Json& value = entry.at(discriminator);
      const std::string key = discriminator + "=" + (value.is_string() ? value.get<std::string>() : "");
      if (!node.contains(key)) throw InvalidInput(key_shown, excerpt(value), allowed);
      if (result.contains(key)) throw InvalidInput(key_shown, excerpt(value), "it stands in the list already");

      const std::string at = here + "/" + key;
      renamed_.emplace_back(at, entry_shown);
      result[key] = object(entry, node.at(key), at, entry_shown, discriminator);
    }
    return result;
  }

  /// Where an entry of a list stands in the file.
  std::string shown_as(const std::string& here, const std::string& otherwise) const {
    const auto found = std::ranges::find(renamed_, here, &std::pair<std::string, std::string>::first);
    return found != renamed_.end() ? found->second : otherwise;
  }

  std::vector<std::pair<std::string, std::string>> renamed_;
  std::vector<std::size_t> supports_at_;  ///< where those of the ends stand in the file
  Json json_;
};

/// Fills a scene from a file, option by option.
class Reader {
 public:
  explicit Reader(Json file) : file_(std::move(file)) {}

  std::string in_file(std::string_view at) const { return file_.in_file(at); }

  template <class T>
  void operator()(const Option& option, T& member) const {
    const Json* const value = file_.find(option.pointer);
    const std::string field = file_.in_file(option.pointer);
    if (value == nullptr) {
      if (option.required && option.when.holds && file_.has_parent(option.pointer)) {
        throw InvalidInput(field, InvalidInput::missing, "it must be " + allowed_text<T>(option));
      }
    } else if (!option.when.holds) {
      const std::string beside =
          option.instead.empty() ? "" : ", and not beside \"" + std::string(option.instead) + "\"";
      throw InvalidInput(field, "this key", "it is used only where " + text(option.when) + beside);
    } else if (!read(*value, option, member)) {
      throw InvalidInput(field, excerpt(*value), "it must be " + allowed_text<T>(option));
    }
  }

  template <class T>
  bool present(const Option& option, std::optional<T>& part) const {
    if (file_.find(option.pointer) != nullptr) part.emplace();
    return part.has_value();
  }

  template <class T>
  bool number_or(const Option& option, double& number, std::optional<T>& part) const {
    const Json* const file = file_.find(option.pointer);
    if (file == nullptr) {
      if (option.required && file_.has_parent(option.pointer)) {
        throw InvalidInput(file_.in_file(option.pointer), InvalidInput::missing,
                           "it must be " + allowed_text<double>(option) + ", or an object");
      }
      return false;
    }
    if (file->is_object()) {
      part.emplace();
    } else if (!read(*file, option, number)) {
      throw InvalidInput(file_.in_file(option.pointer), excerpt(*file),
                         "it must be " + allowed_text<double>(option) + ", or an object");
    }
    return part.has_value();
  }

  template <class T>
  void list(const Option& option, std::vector<T>& entries) const {
    const Json* const file = file_.find(option.pointer);
    entries.assign(file != nullptr ? file->size() : 0, T{});
  }

  void section(const Option& option) const {
    if (!option.required || file_.find(option.pointer) != nullptr) return;
    throw InvalidInput(std::string(option.pointer), InvalidInput::missing,
                       "every scene needs this object: " + std::string(option.description));
  }

 private:
  std::string text(const Condition& when) const {
    std::string text = file_.in_file(when.pointer) + " is " + when.text();
    for (const Condition& other : when.or_else) text += ", or " + this->text(other);
    return text;
  }

  template <class T>
  static bool read(const Json& value, const Option& option, T& member) {
    if constexpr (NamedEnum<T>) {
      const auto choice = value.is_string() ? from_string<T>(value.get_ref<const std::string&>()) : std::nullopt;
      const bool known = choice && option.allows(to_string(*choice));
      if (known) member = *choice;
      return known;
    } else if constexpr (OptionalEnum<T> || OptionalNumber<T>) {
      return read(value, option, member.emplace());
    } else if constexpr (std::same_as<T, bool>) {
      if (value.is_boolean()) member = value.get<bool>();
      return value.is_boolean();
    } else if constexpr (std::same_as<T, std::string>) {
      if (value.is_string()) member = value.get<std::string>();
      return value.is_string();
    } else if constexpr (std::same_as<T, int>) {
      if (!value.is_number()) return false;
      const auto number = value.get<double>();  // 1e1 is a whole number, too
      if (number != std::trunc(number) || std::abs(number) > std::numeric_limits<int>::max()) return false;
      if (!option.range.contains(number)) return false;
      member = static_cast<int>(number);
      return true;
    } else if constexpr (std::same_as<T, std::vector<int>>) {
      if (!value.is_array()) return false;
      member.assign(value.size(), 0);
      for (std::size_t i = 0; i < value.size(); ++i) {
        if (!read(value[i], option, member[i])) return false;
      }
      return true;
    } else if constexpr (std::same_as<T, std::vector<double>>) {
      if (!value.is_array() || !all_numbers(value)) return false;
      member = value.get<std::vector<double>>();
      return true;
    } else if constexpr (std::same_as<T, std::vector<Point>>) {
      if (!value.is_array()) return false;
      member.assign(value.size(), Point{});
      for (std::size_t i = 0; i < value.size(); ++i) {
        if (!read(value[i], option, member[i])) return false;
      }
      return true;
    } else if constexpr (std::same_as<T, Point> || std::same_as<T, std::array<double, 4>>) {
      const std::size_t size = option.components > 0 ? static_cast<std::size_t>(option.components) : member.size();
      if (!value.is_array() || value.size() != size || !all_numbers(value)) return false;
      member = {};
      for (std::size_t i = 0; i < size; ++i) member[i] = value[i].get<double>();
      return true;
    } else {
      if (value.is_number()) member = value.get<double>();
      return value.is_number();
    }
  }

  static bool all_numbers(const Json& array) {
    return std::ranges::all_of(array, [](const Json& item) { return item.is_number(); });
  }

  Canonical file_;
};

/// Writes every option that applies and is not left open.
class Writer {
 public:
  template <class T>
  void operator()(const Option& option, const T& member) {
    if constexpr (OptionalNumber<T> || OptionalEnum<T>) {
      if (!member) return;
    }
    if (option.when.holds) json_[pointer(option.pointer)] = value(option, member);
  }
  template <class T>
  bool present(const Option&, const std::optional<T>& part) {
    return part.has_value();
  }
  template <class T>
  bool number_or(const Option& option, double number, const std::optional<T>& part) {
    if (!part) (*this)(option, number);
    return part.has_value();
  }
  template <class T>
  void list(const Option&, const std::vector<T>&) {}
  void section(const Option&) {}

  Json json() const {
    Json result = with_lists(json_);
    if (result.contains(between_ends)) {
      for (const Json& entry : result.at(between_ends)) result["supports"].push_back(entry);
      result.erase(between_ends);
    }
    return result;
  }

 private:
  template <class T>
  static Json value(const Option& option, const T& member) {
    if constexpr (NamedEnum<T>) {
      return to_string(member);
    } else if constexpr (OptionalEnum<T>) {
      return member ? Json(to_string(*member)) : Json();
    } else if constexpr (std::same_as<T, Point>) {
      Json array = Json::array();
      for (std::size_t i = 0; i < static_cast<std::size_t>(option.components); ++i) array.push_back(member[i]);
      return array;
    } else if constexpr (std::same_as<T, std::vector<Point>>) {
      Json array = Json::array();
      for (const Point& item : member) array.push_back(value(option, item));
      return array;
    } else if constexpr (OptionalNumber<T>) {
      return member ? value(option, *member) : Json();
    } else {
      return member;
    }
  }

  static Json with_lists(const Json& node) {
    if (node.is_array()) {
      Json result = Json::array();
      for (const Json& entry : node) result.push_back(with_lists(entry));
      return result;
    }
    if (!node.is_object()) return node;
    const std::string discriminator = list_key(node);
    Json result = discriminator.empty() ? Json::object() : Json::array();
    for (const auto& item : node.items()) {
      if (discriminator.empty()) {
        result[item.key()] = with_lists(item.value());
      } else {
        Json entry = {{discriminator, item.key().substr(discriminator.size() + 1)}};
        entry.update(with_lists(item.value()));
        result.push_back(entry);
      }
    }
    return result;
  }

  Json json_;
};

void move_all_ways(SupportMotionSpec& motion) {
  motion.x.emplace();
  motion.y.emplace();
  motion.z.emplace();
}

}  // namespace

Scene scene_with_every_part() {
  Scene scene;
  scene.sliding_mass.emplace().friction.emplace();
  scene.sliding_mass->at_corner.emplace();
  scene.sliding_joints.emplace_back().support = SupportType::pin;  // one that needs no mass
  scene.sliding_joints.back().friction.emplace();
  scene.sliding_joints.back().at_corner.emplace();
  scene.sliding_joints.back().x.emplace();
  scene.sliding_joints.back().pitch.emplace();
  move_all_ways(scene.sliding_joints.back().motion.emplace());
  scene.sliding_joints.back().pulley.emplace();
  for (SupportSpec* support : {&scene.start, &scene.end}) {
    support->motion.emplace().angle.emplace();
    move_all_ways(*support->motion);
    support->feed.emplace();
    support->held_tension.emplace();
    support->drum.emplace();
    support->end_stop.emplace();
  }
  scene.bearings.emplace_back().type = BearingType::spring;
  scene.bearings.back().to.emplace();
  scene.blocks.emplace_back();
  scene.spin.emplace().drives.emplace_back();
  scene.flow.emplace().nodes.emplace_back();
  scene.loads.emplace_back();
  scene.vehicles.push_back({.name = "train", .axles = {AxleSpec{}}});
  scene.contact.emplace().joints = AtSupport::rebound;
  scene.point_masses.emplace_back();
  scene.beam.sections.emplace_back().drag.emplace();
  PlaceSpec& place = scene.places.emplace_back();
  place.name = "here";
  place.end.emplace();
  scene.initial_velocity.emplace();
  scene.drag.emplace();
  scene.fluid.emplace();
  scene.ground.emplace().friction.emplace();
  scene.integrator.atol_by_kind.emplace();
  return scene;
}

/// A line needs an end: whoever writes a curve means one of a certain length.
bool is_line_without_end(const Json& json) {
  const auto part = [](const Json& of, const char* key) {
    return of.is_object() && of.contains(key) ? of.at(key) : Json();
  };
  const Json curve = part(part(json, "beam"), "curve");
  return curve.is_object() && !curve.contains("end") && curve.value("type", Json("line")) == "line";
}

/// A beam has one section all along, or several.
void refuse_two_kinds_of_sections(const Json& json) {
  const bool both = json.is_object() && json.contains("beam") && json.at("beam").is_object() &&
                    json.at("beam").contains("section") && json.at("beam").contains("sections");
  if (!both) return;
  throw InvalidInput("/beam/section", "this key",
                     "each piece of /beam/sections has a section: leave out one of the two");
}

/// Whether an integrator is asked for by the accuracy alone. Throws InvalidInput where other keys stand beside it.
bool asks_for_accuracy(const Json& integrator) {
  if (!integrator.is_object() || !integrator.contains("accuracy")) return false;
  for (const auto& [key, value] : integrator.items()) {
    if (key == "accuracy") continue;
    throw InvalidInput("/integrator/" + key, excerpt(value),
                       "\"accuracy\" chooses the integrator: leave out one of the two");
  }
  return true;
}

std::vector<std::string> known_keys(const std::string& part) { return keys_of(KeyTree().tree().at(part)); }

Scene scene_from_json(Json json) {
  if (is_assembly(json)) return assembly_from_json(std::move(json));
  const bool in_time = !json.is_object() || !json.contains("analysis") || json.at("analysis") != "statics";
  const bool left_out =
      in_time && json.is_object() && (!json.contains("integrator") || json.at("integrator") == Json::object());
  const bool asked_for = in_time && json.is_object() && !left_out && asks_for_accuracy(json.at("integrator"));
  const bool automatic = left_out || asked_for || (in_time && json.is_object() && json.at("integrator") == "auto");
  if (automatic && !asked_for) json.erase("integrator");
  if (json.is_object() && json.contains("integrator") && json.at("integrator").is_string()) {
    throw InvalidInput("/integrator", excerpt(json.at("integrator")),
                       "it must be \"auto\", or an object like {\"type\": \"dopri5\"}");
  }
  if (json.is_object() && json.contains("integrator") && json.at("integrator").is_object() &&
      json.at("integrator").value("type", Json()) == "auto") {
    throw InvalidInput("/integrator/type", "\"auto\"",
                       "what the scene chooses has no options: write \"integrator\": \"auto\", or name a method");
  }
  refuse_two_kinds_of_sections(json);
  const bool endless = is_line_without_end(json);
  const Reader reader(std::move(json));
  if (endless) {
    throw InvalidInput("/beam/curve/end", InvalidInput::missing,
                       "it must be an array of numbers [m], where the line ends");
  }
  Scene scene;
  scene.integrator.automatic = automatic;
  visit_options(reader, scene);
  const bool published = scene.setting != SceneSetting::standard;
  if (published) {  // the same keys, and others for those left out
    scene = scene_in(scene.setting);
    scene.integrator.automatic = automatic;
    visit_options(reader, scene);
  }
  try {
    place_at_corners(scene);
    if (automatic && !(published && left_out)) {
      scene.integrator = automatic_integrator(scene, scene.integrator.accuracy);
    }
    validate(scene);
  } catch (const InvalidInput& error) {
    throw InvalidInput(reader.in_file(error.field), error.value, error.allowed);
  }
  return scene;
}

namespace {

/// Which keys of what the beam is of a scene leaves out, "a, b and c".
std::string left_out_of_material(const Json& scene) {
  const auto part = [](const Json& of, const char* key) {
    return of.is_object() && of.contains(key) ? of.at(key) : Json::object();
  };
  const Json beam = part(scene, "beam"), material = part(beam, "material");
  std::vector<std::string> keys;
  bool sized = false;
  const auto look_at = [&](const Json& section, const std::string& key) {
    const Json type = section.value("type", Json("circle"));
    if (type == "stiffness" || type == "rope" || type == "chain") return;
    sized = true;
    if ((type == "circle" || type == "tube") && !section.contains("radius")) keys.push_back(key + "/radius");
  };
  if (const Json pieces = part(beam, "sections"); pieces.is_array()) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      look_at(part(pieces[i], "section"), "/beam/sections/" + std::to_string(i) + "/section");
    }
  } else {
    look_at(part(beam, "section"), "/beam/section");
  }
  for (const char* key : {"density", "youngs_modulus"}) {
    if (sized && !material.contains(key) && !material.contains("name")) {
      keys.push_back(std::string("/beam/material/") + key);
    }
  }
  std::string text;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == keys.size() ? " and " : ", ") + keys[i];
  }
  return text;
}

}  // namespace

Scene parse_scene(std::string_view text) {
  const Json json = parse_json(text);
  Scene scene = scene_from_json(json);
  if (scene.setting == SceneSetting::standard && !scene.assembly) scene.assumed = left_out_of_material(json);
  return scene;
}

Scene read_scene(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  return naming_file(file, [&] { return parse_scene(text); });
}

/// How tables of motions are read.
void fill_motions(Scene& scene) {
  const auto fill = [](std::optional<SupportMotionSpec>& motion) {
    if (!motion) return;
    motion->displacement = smooth_by_default(motion->displacement);
    for (auto* part : {&motion->angle, &motion->x, &motion->y, &motion->z}) {
      if (*part) *part = smooth_by_default(**part);
    }
  };
  fill(scene.start.motion);
  fill(scene.end.motion);
  for (SlidingJointSpec& joint : scene.sliding_joints) fill(joint.motion);
}

Json scene_to_json(const Scene& scene) {
  if (scene.assembly) return assembly_to_json(scene);
  Scene filled = scene;
  filled.integrator.automatic = false;  // what was chosen, as one may write it
  filled.beam.quadrature_points = quadrature_points(scene);
  filled.beam.polynomial_points = points_of_polynomials(scene);
  filled.beam.axial_strain = axial_strain(scene);
  filled.beam.compression = compression(scene);
  if (filled.beam.compression == Compression::none) filled.beam.slack_over = slack_over(scene);
  if (auto& mass = filled.sliding_mass) mass->separation_distance = separation_distance(scene, *mass);
  for (SlidingJointSpec& joint : filled.sliding_joints) joint.separation_distance = separation_distance(scene, joint);
  fill_motions(filled);
  filled.length_control.end_merge = end_merge(scene);
  filled.length_control.lower = merge_below(scene);
  if (auto& atol = filled.integrator.atol_by_kind) atol = with_defaults(*atol, scene);
  filled.length_control.cut = cut_policy(scene);
  filled.length_control.merge = merge_policy(scene);
  filled.weights = weight_transport(scene);
  filled.beam.axis = axis_form(scene);
  filled.statics.joints = static_joints(scene);
  if (filled.spin) filled.spin->rate = initial_spin(scene);
  if (filled.flow) filled.flow->velocity = initial_velocity(scene);
  Writer writer;
  visit_options(writer, std::as_const(filled));
  Json json = writer.json();
  if (!scene.beam.sections.empty()) json.at("beam").erase("section");
  return json;
}

}  // namespace vlbeam
