#include "io/assembly_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "io/nearest.hpp"
#include "io/scene_json.hpp"
#include "scene/assembly_names.hpp"
#include "scene/automatic_integrator.hpp"
#include "scene/derived.hpp"
#include "scene/names.hpp"
#include "scene/options.hpp"
#include "scene/validate.hpp"

namespace vlbeam {
namespace {

/// Keys beside /beam that an entry of /beams may have.
constexpr auto of_beams = [] {
  std::array<const char*, keys_of_one_beam.size() + keys_of_whole_or_beam.size()> keys{};
  std::ranges::copy(keys_of_whole_or_beam, std::ranges::copy(keys_of_one_beam, keys.begin()).out);
  return keys;
}();

bool is_of_beams(const std::string& key) { return std::ranges::find(of_beams, key) != of_beams.end(); }

/// Reads the keys of one object, and refuses those that nobody has asked for.
class ObjectFields {
 public:
  ObjectFields(const Json& json, std::string at) : json_(json), at_(std::move(at)) {
    if (!json.is_object()) throw InvalidInput(at_, excerpt(json), "it must be an object");
  }
  ~ObjectFields() = default;
  ObjectFields(const ObjectFields&) = delete;
  ObjectFields& operator=(const ObjectFields&) = delete;

  const Json* find(const std::string& key) {
    known_.push_back(key);
    return json_.contains(key) ? &json_.at(key) : nullptr;
  }
  const Json& need(const std::string& key, const std::string& allowed) {
    if (const Json* found = find(key)) return *found;
    throw InvalidInput(at_ + "/" + key, InvalidInput::missing, "it must be " + allowed);
  }
  std::string text(const std::string& key) {
    const Json& value = need(key, "a string");
    if (!value.is_string()) throw InvalidInput(at_ + "/" + key, excerpt(value), "it must be a string");
    return value.get<std::string>();
  }
  void number(const std::string& key, const char* unit, double& value) {
    const Json* const found = find(key);
    if (found == nullptr) return;
    if (!found->is_number()) {
      throw InvalidInput(at_ + "/" + key, excerpt(*found), std::string("it must be a number [") + unit + "]");
    }
    value = found->get<double>();
  }
  void point(const std::string& key, const char* unit, int size, Point& value) {
    if (const Json* const found = find(key)) value = point_from(*found, at_ + "/" + key, unit, size);
  }
  /// A number in the plane, three in space.
  void turn(const std::string& key, const char* unit, int dimension, Point& value) {
    if (dimension == 3) return point(key, unit, 3, value);
    number(key, unit, value[2]);
  }
  void end(const std::string& who) const {
    for (const auto& item : json_.items()) {
      if (std::ranges::find(known_, item.key()) != known_.end()) continue;
      throw InvalidInput(at_ + "/" + item.key(), "an unknown key",
                         "the nearest known key is \"" + nearest_of(item.key(), known_) + "\" (" + who +
                             " has: " + quoted_list(known_) + ")");
    }
  }
  static Point point_from(const Json& json, const std::string& at, const char* unit, int size) {
    const auto count = static_cast<std::size_t>(size);
    const bool right = json.is_array() && json.size() == count &&
                       std::ranges::all_of(json, [](const Json& item) { return item.is_number(); });
    if (!right) {
      throw InvalidInput(at, excerpt(json),
                         "it must be an array of " + std::to_string(size) + " numbers [" + unit + "]");
    }
    Point point{};
    for (std::size_t i = 0; i < count; ++i) point[i] = json[i].get<double>();
    return point;
  }

 private:
  const Json& json_;
  std::string at_;
  std::vector<std::string> known_;
};

const Json& array_at(const Json& json, const std::string& key) {
  static const Json none = Json::array();
  if (!json.contains(key)) return none;
  const Json& value = json.at(key);
  if (!value.is_array()) throw InvalidInput("/" + key, excerpt(value), "it must be an array of objects");
  return value;
}

/// Refuses a key that no beam of several has.
void check_key(const std::string& at, const std::string& key) {
  static const std::vector<std::string> of_beam = known_keys("beam");
  if (is_of_beams(key) || std::ranges::find(of_beam, key) != of_beam.end()) return;
  std::vector<std::string> known{"name"};
  known.insert(known.end(), of_beam.begin(), of_beam.end());
  known.insert(known.end(), of_beams.begin(), of_beams.end());
  throw InvalidInput(
      at + "/" + key, "an unknown key",
      "the nearest known key is \"" + nearest_of(key, known) + "\" (a beam has: " + quoted_list(known) + ")");
}

/// A function of time, read as one of the options of a scene: the magnitude of a load.
TimeSpec time_from(const Json& json, const std::string& at) {
  const Json scene = {{"beam", {{"curve", {{"end", {1, 0}}}}}},
                      {"loads", {{{"magnitude", json}, {"type", "force"}, {"node", 1}, {"direction", {0, 1}}}}},
                      {"duration", 1}};
  try {
    return scene_from_json(scene).loads.front().magnitude;
  } catch (const InvalidInput& error) {
    const std::string own = "/loads/0/magnitude";
    throw InvalidInput(error.field.starts_with(own) ? at + error.field.substr(own.size()) : at, error.value,
                       error.allowed);
  }
}

Json time_to_json(const TimeSpec& time) {
  Json json = {{"value", time.value}};
  const auto add = [&json](const char* key, double value) {
    if (value != 0) json[key] = value;
  };
  add("rate", time.rate);
  add("acceleration", time.acceleration);
  add("amplitude", time.amplitude);
  add("frequency", time.frequency);
  add("phase_degrees", time.phase_degrees);
  add("ramp", time.ramp);
  add("rate_ramp", time.rate_ramp);
  if (time.until) json["until"] = *time.until;
  if (time.table.empty()) return json;
  json = {{"table", Json::array()}};
  for (const Point& entry : time.table) json["table"].push_back({entry[0], entry[1]});
  if (time.smooth) json["smooth"] = *time.smooth;
  return json;
}

BodySpec body_from(const Json& json, const std::string& at, int dimension) {
  ObjectFields fields(json, at);
  BodySpec body;
  body.name = fields.text("name");
  fields.need("mass", "a number > 0 [kg]");
  fields.number("mass", "kg", body.mass);
  if (const Json* const inertia = fields.find("inertia")) {
    if (inertia->is_number()) {
      body.inertia = {inertia->get<double>()};
    } else {
      const Point three = ObjectFields::point_from(*inertia, at + "/inertia", "kg m^2", dimension == 2 ? 1 : 3);
      body.inertia.assign(three.begin(), three.begin() + (dimension == 2 ? 1 : 3));
    }
  }
  fields.need("position", "an array of " + std::to_string(dimension) + " numbers [m]");
  fields.point("position", "m", dimension, body.position);
  fields.turn("rotation", "degrees", dimension, body.rotation);
  fields.point("velocity", "m/s", dimension, body.velocity);
  fields.turn("angular_velocity", "rad/s", dimension, body.angular_velocity);
  if (const Json* const points = fields.find("points")) {
    if (!points->is_object()) {
      throw InvalidInput(at + "/points", excerpt(*points), "it must be an object: names and places in body axes [m]");
    }
    for (const auto& item : points->items()) {
      body.points.push_back(
          {item.key(), ObjectFields::point_from(item.value(), at + "/points/" + item.key(), "m", dimension)});
    }
  }
  if (const Json* const loads = fields.find("loads")) {
    if (!loads->is_array()) throw InvalidInput(at + "/loads", excerpt(*loads), "it must be an array of objects");
    for (std::size_t i = 0; i < loads->size(); ++i) {
      const std::string own = at + "/loads/" + std::to_string(i);
      ObjectFields of_load((*loads)[i], own);
      BodyLoadSpec& load = body.loads.emplace_back();
      const auto type = from_string<BodyLoadSpec::Type>(of_load.text("type"));
      if (!type)
        throw InvalidInput(own + "/type", excerpt((*loads)[i].at("type")), "it must be \"force\" or \"torque\"");
      load.type = *type;
      load.magnitude = time_from(of_load.need("magnitude", "a function of time: {\"value\": 5}"), own + "/magnitude");
      if (load.type == BodyLoadSpec::Type::force) {
        if (of_load.find("point") != nullptr) load.point = of_load.text("point");
        of_load.point("direction", "-", dimension, load.direction);
      } else if (dimension == 3) {
        of_load.point("direction", "-", 3, load.direction);
      }
      of_load.end("a load of a body");
    }
  }
  fields.end("a body");
  return body;
}

/// Of the names that there are: which one.
std::size_t index_of(const Json& json, const std::string& at, const std::vector<std::string>& names,
                     const std::string& what) {
  const std::string name = json.is_string() ? json.get<std::string>() : "";
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    throw InvalidInput(at, excerpt(json),
                       names.empty() ? "the scene has no " + what
                                     : "it must be the name of a " + what + ": one of " + quoted_list(names));
  }
  return static_cast<std::size_t>(found - names.begin());
}

struct MemberNames {
  std::vector<std::string> beams, bodies;
};

/// The node of a material coordinate [m]; throws InvalidInput where none stands there.
int node_at(double x, const Scene& beam, const std::string& at) {
  constexpr double rounding = 1e-9;  // of an element
  const double l = beam_length(beam) / beam.beam.elements, node = std::round(x / l);
  const bool even =
      std::ranges::none_of(beam.point_masses, [](const PointMassSpec& mass) { return mass.position.has_value(); });
  if (even && node >= 0 && node <= beam.beam.elements && std::abs(x / l - node) < rounding) {
    return static_cast<int>(node);
  }
  throw InvalidInput(at, six_digits(x),
                     even ? "a node must stand there, so a multiple of " + six_digits(l) + " m up to " +
                                six_digits(beam_length(beam)) + " m: other /elements may have one"
                          : "beside point masses at a position nodes do not stand evenly: take {\"node\": k}");
}

LinkEndSpec end_from(const Json& json, const std::string& at, const AssemblySpec& parts, const MemberNames& names,
                     int dimension) {
  const std::string allowed =
      "it must be {\"beam\", \"at\": \"start\", \"end\", {\"node\": k} or {\"x\": m}}, {\"beam\", \"joint\"}, "
      "{\"body\", "
      "\"point\"} or "
      "{\"ground\": place}";
  if (!json.is_object()) throw InvalidInput(at, excerpt(json), allowed);
  ObjectFields fields(json, at);
  LinkEndSpec end;
  if (const Json* const ground = fields.find("ground")) {
    end.of = LinkEndSpec::Of::ground;
    end.place = ObjectFields::point_from(*ground, at + "/ground", "m", dimension);
    fields.end("a place of the ground");
    return end;
  }
  if (const Json* const body = fields.find("body")) {
    end.of = LinkEndSpec::Of::body;
    end.which = index_of(*body, at + "/body", names.bodies, "body");
    if (const Json* const point = fields.find("point")) {
      const auto& points = parts.bodies[end.which].points;
      std::vector<std::string> known;
      for (const BodyPointSpec& one : points) known.push_back(one.name);
      end.place = points[index_of(*point, at + "/point", known, "point of that body")].at;
    }
    fields.end("a place on a body");
    return end;
  }
  const Json* const beam = fields.find("beam");
  if (beam == nullptr) throw InvalidInput(at, excerpt(json), allowed);
  end.which = index_of(*beam, at + "/beam", names.beams, "beam");
  if (const Json* const joint = fields.find("joint")) {
    if (!joint->is_number_integer())
      throw InvalidInput(at + "/joint", excerpt(*joint), "it must be a whole number >= 0");
    end.of = LinkEndSpec::Of::joint;
    end.joint = joint->get<int>();
  } else {
    const Json& where = fields.need("at", "\"start\", \"end\", {\"node\": k} or {\"x\": m}");
    if (where == "start") {
      end.of = LinkEndSpec::Of::beam_start;
    } else if (where == "end") {
      end.of = LinkEndSpec::Of::beam_end;
    } else if (where.is_object() && where.size() == 1 && where.contains("node") &&
               where.at("node").is_number_integer()) {
      end.of = LinkEndSpec::Of::node;
      end.joint = where.at("node").get<int>();
    } else if (where.is_object() && where.size() == 1 && where.contains("x") && where.at("x").is_number()) {
      end.of = LinkEndSpec::Of::node;
      end.joint = node_at(where.at("x").get<double>(), parts.beams[end.which].scene, at + "/at/x");
    } else {
      throw InvalidInput(at + "/at", excerpt(where),
                         "it must be \"start\", \"end\", {\"node\": k} or {\"x\": material coordinate of a node}");
    }
  }
  fields.end("a place on a beam");
  return end;
}

LinkSpec link_from(const Json& json, const std::string& at, const AssemblySpec& parts, const MemberNames& names,
                   int dimension) {
  ObjectFields fields(json, at);
  LinkSpec link;
  link.name = fields.text("name");
  const std::string type = fields.text("type");
  const auto known = from_string<LinkType>(type);
  if (!known) {
    std::vector<std::string> types;
    for (const auto& entry : vlbeam::names(LinkType{})) types.emplace_back(entry.name);
    throw InvalidInput(at + "/type", "\"" + type + "\"", "it must be one of " + quoted_list(types));
  }
  link.type = *known;
  const Json& between = fields.need("between", "an array of two ends");
  if (!between.is_array() || between.size() != 2) {
    throw InvalidInput(at + "/between", excerpt(between), "it must be an array of two ends");
  }
  for (std::size_t i = 0; i < 2; ++i) {
    link.between[i] = end_from(between[i], at + "/between/" + std::to_string(i), parts, names, dimension);
  }
  const auto length = [&] {
    if (fields.find("length") != nullptr) fields.number("length", "m", link.length.emplace());
  };
  if (link.type == LinkType::distance) length();
  if (link.type == LinkType::rail) {
    fields.need("direction", "an array of numbers, along the rail");
    fields.point("direction", "-", dimension, link.direction);
  }
  if (link.type == LinkType::spring) {
    fields.number("stiffness", "N/m", link.stiffness);
    fields.number("damping", "N s/m", link.damping);
    length();
    if (const Json* const tension = fields.find("tension_only")) {
      if (!tension->is_boolean())
        throw InvalidInput(at + "/tension_only", excerpt(*tension), "it must be true or false");
      link.tension_only = tension->get<bool>();
    }
  }
  fields.end("a \"" + type + "\"");
  return link;
}

Json point_json(const Point& point, int dimension) {
  return Json(std::vector<double>(point.begin(), point.begin() + dimension));
}

Json end_json(const LinkEndSpec& end, const AssemblySpec& parts, int dimension) {
  switch (end.of) {
    case LinkEndSpec::Of::ground:
      return {{"ground", point_json(end.place, dimension)}};
    case LinkEndSpec::Of::body: {
      const BodySpec& body = parts.bodies[end.which];
      Json json = {{"body", body.name}};
      const auto at = std::ranges::find(body.points, end.place, &BodyPointSpec::at);
      if (at != body.points.end()) json["point"] = at->name;
      return json;
    }
    case LinkEndSpec::Of::joint:
      return {{"beam", parts.beams[end.which].name}, {"joint", end.joint}};
    case LinkEndSpec::Of::node:
      return {{"beam", parts.beams[end.which].name}, {"at", {{"node", end.joint}}}};
    case LinkEndSpec::Of::beam_start:
    case LinkEndSpec::Of::beam_end:
      break;
  }
  return {{"beam", parts.beams[end.which].name}, {"at", end.of == LinkEndSpec::Of::beam_start ? "start" : "end"}};
}

Json body_json(const BodySpec& body, int d) {
  Json json = {{"name", body.name}, {"mass", body.mass}};
  const auto turn = [d](const Point& point) { return d == 2 ? Json(point[2]) : point_json(point, 3); };
  if (body.inertia.size() == 1) json["inertia"] = body.inertia.front();
  if (body.inertia.size() == 3) json["inertia"] = body.inertia;
  json["position"] = point_json(body.position, d);
  json["velocity"] = point_json(body.velocity, d);
  if (!body.inertia.empty()) {
    json["rotation"] = turn(body.rotation);
    json["angular_velocity"] = turn(body.angular_velocity);
  }
  for (const BodyPointSpec& point : body.points) json["points"][point.name] = point_json(point.at, d);
  for (const BodyLoadSpec& load : body.loads) {
    Json own = {{"type", to_string(load.type)}, {"magnitude", time_to_json(load.magnitude)}};
    if (!load.point.empty()) own["point"] = load.point;
    if (load.type == BodyLoadSpec::Type::force || d == 3) own["direction"] = point_json(load.direction, d);
    json["loads"].push_back(own);
  }
  return json;
}

Json link_json(const LinkSpec& link, const AssemblySpec& parts, int d) {
  Json json = {{"name", link.name}, {"type", to_string(link.type)}, {"between", Json::array()}};
  for (const LinkEndSpec& end : link.between) json["between"].push_back(end_json(end, parts, d));
  if (link.length) json["length"] = *link.length;
  if (link.type == LinkType::rail) json["direction"] = point_json(link.direction, d);
  if (link.type == LinkType::spring) {
    json["stiffness"] = link.stiffness;
    json["damping"] = link.damping;
    json["tension_only"] = link.tension_only;
  }
  return json;
}

/// Whether a support holds an end of a beam.
bool holds_an_end(const Json& beam) {
  const Json supports = beam.value("supports", Json::array());
  return !supports.is_array() || std::ranges::any_of(supports, [](const Json& support) {
    return !support.is_object() || support.value("type", Json()) != "free";
  });
}

}  // namespace

bool is_assembly(const Json& json) {
  return json.is_object() && (json.contains("beams") || json.contains("bodies") || json.contains("links"));
}

Scene assembly_from_json(Json json) {
  const Json beams = array_at(json, "beams"), bodies = array_at(json, "bodies"), links = array_at(json, "links");
  if (beams.empty()) throw InvalidInput("/beams", InvalidInput::missing, "it must be an array of at least one beam");
  if (json.contains("beam")) {
    throw InvalidInput("/beam", "this key", "the scene has /beams: write the beam as one of them");
  }
  for (const char* key : {"beams", "bodies", "links"}) json.erase(key);
  for (const char* key : keys_of_one_beam) {
    if (!json.contains(key)) continue;
    throw InvalidInput(std::string("/") + key, "this key",
                       "with several beams it belongs to one of them: write it into an entry of /beams");
  }
  const Json integrator = json.contains("integrator") ? json.at("integrator") : Json("auto");
  const bool in_time = !json.contains("analysis") || json.at("analysis") != "statics";
  const bool left_out = in_time && (integrator == Json("auto") || integrator == Json::object());
  const bool asked = in_time && integrator.is_object() && integrator.contains("accuracy");
  if (left_out || asked) {
    json["integrator"] = {{"type", "generalized-alpha"}};
    if (json.contains("duration") && json.at("duration").is_number()) {
      json["integrator"]["step"] = json.at("duration").get<double>() / 1000;
    }
  }
  Json control;  // of the whole: a beam alone may have no load to scale
  if (!in_time && json.contains("statics") && json.at("statics").is_object()) {
    control = json.at("statics").value("control", Json("load"));
    json["statics"].erase("control");
  }
  AssemblySpec parts;
  MemberNames names;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const std::string at = "/beams/" + std::to_string(i);
    const Json& entry = beams[i];
    if (!entry.is_object()) throw InvalidInput(at, excerpt(entry), "it must be an object");
    if (!entry.contains("name") || !entry.at("name").is_string()) {
      throw InvalidInput(at + "/name", entry.contains("name") ? excerpt(entry.at("name")) : InvalidInput::missing,
                         "it must be a string");
    }
    Json scene = json;
    scene["beam"] = Json::object();
    for (const auto& item : entry.items()) {
      if (item.key() == "name") continue;
      check_key(at, item.key());
      (is_of_beams(item.key()) ? scene[item.key()] : scene["beam"][item.key()]) = item.value();
    }
    const bool floats = !in_time && !holds_an_end(entry);
    if (floats) scene["supports"] = {{{"at", "start"}, {"type", "pin"}}};  // links hold it
    try {
      parts.beams.push_back({entry.at("name").get<std::string>(), scene_from_json(scene)});
      if (floats) parts.beams.back().scene.start = {};
    } catch (const InvalidInput& error) {
      const std::string first = error.field.substr(0, error.field.find('/', 1));
      const bool of_whole = !first.empty() && !entry.contains(first.substr(1)) && json.contains(first.substr(1));
      throw InvalidInput(of_whole ? error.field : key_in_assembly(i, error.field), error.value, error.allowed);
    }
    names.beams.push_back(parts.beams.back().name);
  }
  const int dimension = parts.beams.front().scene.dimension;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    parts.bodies.push_back(body_from(bodies[i], "/bodies/" + std::to_string(i), dimension));
    names.bodies.push_back(parts.bodies.back().name);
  }
  check_names(parts);
  for (std::size_t i = 0; i < links.size(); ++i) {
    parts.links.push_back(link_from(links[i], "/links/" + std::to_string(i), parts, names, dimension));
  }
  Scene whole = whole_scene(std::move(parts));
  if (!control.is_null()) {
    const auto named = control.is_string() ? from_string<LoadControl>(control.get<std::string>()) : std::nullopt;
    if (!named) throw InvalidInput("/statics/control", excerpt(control), "it must be \"load\" or \"arc-length\"");
    whole.statics.control = *named;
  }
  if (left_out || asked) {
    whole.integrator = {};
    whole.integrator.automatic = true;
    double accuracy = whole.integrator.accuracy;
    if (asked) {
      ObjectFields fields(integrator, "/integrator");
      fields.number("accuracy", "-", accuracy);
      fields.end("an integrator that \"accuracy\" chooses");
      const Range range = Range::closed(finest_accuracy, coarsest_accuracy);
      if (!range.contains(accuracy)) {
        throw InvalidInput("/integrator/accuracy", number_text(accuracy), "it must be a number" + range.text());
      }
    }
    whole.integrator = automatic_integrator(whole, accuracy);
  }
  validate(whole);
  return whole;
}

void add_assembly_schema(Json& scene) {
  Json& properties = scene["properties"];
  const auto typed = [](const char* type, const std::string& description) {
    return Json{{"type", type}, {"description", description}};
  };
  const auto object = [](const Json& own, const Json& required) {
    return Json{{"type", "object"}, {"properties", own}, {"required", required}, {"additionalProperties", false}};
  };
  const auto vector = [](const std::string& description) {
    return Json{{"type", "array"},
                {"items", {{"type", "number"}}},
                {"minItems", 2},
                {"maxItems", 3},
                {"description", description}};
  };
  const auto number = [&](const std::string& description) { return typed("number", description); };
  const auto turn = [](const std::string& description) {
    return Json{{"anyOf", {{{"type", "number"}}, {{"type", "array"}, {"items", {{"type", "number"}}}}}},
                {"description", description}};
  };
  const auto list = [](const Json& items, const std::string& description) {
    return Json{{"type", "array"}, {"items", items}, {"minItems", 1}, {"description", description}};
  };
  const Json name = typed("string", "its name, in quantities and links: letters, digits, spaces and underscores");

  const auto as = [](const std::string& pointer, const std::string& at) {
    return Json{{"$ref", "#" + pointer}, {"description", "as " + at}};
  };
  Json beam = {{"name", name}};
  for (const auto& item : properties.at("beam").at("properties").items()) {
    beam[item.key()] = as("/properties/beam/properties/" + item.key(), "/beam/" + item.key());
  }
  for (const char* key : of_beams) beam[key] = as(std::string("/properties/") + key, std::string("/") + key);
  properties["beams"] =
      list(object(beam, {"name", "curve"}),
           "several beams, in place of /beam: the keys of /beam, and of its own supports, joints, point "
           "masses, loads and places");
  const Json load =
      object({{"type", {{"enum", {"force", "torque"}}, {"description", "what it is"}}},
              {"point", typed("string", "of a force: a point of the body; if not given its center of mass")},
              {"magnitude", as("/properties/loads/items/properties/magnitude", "/loads/N/magnitude")},
              {"direction", vector("of a force, or axis of a torque in space")}},
             {"type", "magnitude"});
  properties["bodies"] = list(
      object(
          {{"name", name},
           {"mass", {{"type", "number"}, {"exclusiveMinimum", 0}, {"description", "mass [kg]"}}},
           {"inertia", turn("about the center of mass: a number in the plane, in space three about the body axes, its "
                            "main ones; none: a point mass [kg m^2]")},
           {"position", vector("of the center of mass at t = 0 [m]")},
           {"rotation", turn("of the body axes at t = 0: a number in the plane, in space a rotation vector [degrees]")},
           {"velocity", vector("of the center of mass at t = 0 [m/s]")},
           {"angular_velocity", turn("at t = 0, in space: a number in the plane, three in space [rad/s]")},
           {"points",
            {{"type", "object"},
             {"additionalProperties", vector("a place in body axes [m]")},
             {"description", "named places of the body, for links and loads"}}},
           {"loads", list(load, "forces at its points, and torques")}},
          {"name", "mass", "position"}),
      "rigid bodies and point masses beside the beams");
  const Json node =
      object({{"node", {{"type", "integer"}, {"minimum", 0}, {"description", "of a beam without joints"}}}}, {"node"});
  const Json material = object(
      {{"x", {{"type", "number"}, {"minimum", 0}, {"description", "material coordinate of a node [m]"}}}}, {"x"});
  const Json end =
      object({{"beam", typed("string", "name of a beam")},
              {"at", {{"anyOf", {{{"enum", {"start", "end"}}}, node, material}}, {"description", "where on the beam"}}},
              {"joint", {{"type", "integer"}, {"minimum", 0}, {"description", "of its sliding joints, from 0"}}},
              {"body", typed("string", "name of a body")},
              {"point", typed("string", "one of its points; if not given its center of mass")},
              {"ground", vector("a place in space [m]")}},
             Json::array());
  Json types = Json::array();
  for (const auto& entry : names(LinkType{})) types.push_back(entry.name);
  properties["links"] = list(
      object({{"name", name},
              {"type",
               {{"enum", types},
                {"description",
                 "two points are one (pin), and directions keep their angle (clamp); a joint carries "
                 "a point (slide); two points keep their distance; a spring; a point stays on a line "
                 "of the ground (rail)"}}},
              {"between",
               {{"type", "array"}, {"items", end}, {"minItems", 2}, {"maxItems", 2}, {"description", "what it ties"}}},
              {"stiffness", number("of a spring [N/m]")},
              {"damping", number("of a spring [N s/m]")},
              {"length", number("of a spring at which it bears nothing; if not given that at t = 0 [m]")},
              {"tension_only", typed("boolean", "a spring that does not push")},
              {"direction", vector("of a rail")}},
             {"name", "type", "between"}),
      "what ties beams, bodies and the ground to each other");
  Json& required = scene["required"];
  required.erase(std::remove(required.begin(), required.end(), "beam"), required.end());
  scene["anyOf"] = {{{"required", {"beam"}}}, {{"required", {"beams"}}}};
}

Json assembly_to_json(const Scene& whole) {
  const AssemblySpec& parts = *whole.assembly;
  Scene shared = whole;
  shared.assembly.reset();
  Json json = scene_to_json(shared);
  json.erase("beam");
  json.erase("weights");  // as each beam has them by default
  for (const char* key : of_beams) json.erase(key);
  for (std::size_t i = 0; i < parts.beams.size(); ++i) {
    const Json scene = scene_to_json(beam_scene(whole, i));
    Json entry = {{"name", parts.beams[i].name}};
    entry.update(scene.at("beam"));
    for (const char* key : of_beams) {
      if (scene.contains(key)) entry[key] = scene.at(key);
    }
    json["beams"].push_back(entry);
  }
  for (const BodySpec& body : parts.bodies) json["bodies"].push_back(body_json(body, whole.dimension));
  for (const LinkSpec& link : parts.links) json["links"].push_back(link_json(link, parts, whole.dimension));
  return json;
}

}  // namespace vlbeam
