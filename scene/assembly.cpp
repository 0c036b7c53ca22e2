#include "scene/assembly.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "core/geometry/vec.hpp"
#include "scene/assembly_names.hpp"
#include "scene/derived.hpp"
#include "scene/on_elements.hpp"

namespace vlbeam {
namespace {

void check_name(const std::string& at, const std::string& name, std::vector<std::string>& taken) {
  const auto allowed = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == ' '; };
  constexpr std::array reserved{"t", "energy", "momentum", "angular_momentum"};
  if (name.empty() || !std::ranges::all_of(name, allowed)) {
    refuse(at, "\"" + name + "\"", "it must be letters, digits, spaces and underscores");
  }
  if (std::ranges::find(reserved, name) != reserved.end()) {
    refuse(at, "\"" + name + "\"", "the whole has a quantity of that name: take another one");
  }
  if (std::ranges::find(taken, name) != taken.end()) {
    refuse(at, "\"" + name + "\"", "there are two of that name: each beam, body and link needs one of its own");
  }
  taken.push_back(name);
}

}  // namespace

std::string key_in_assembly(std::size_t which, const std::string& key) {
  const std::string entry = "/beams/" + std::to_string(which);
  if (key.starts_with("/beam/")) return entry + key.substr(5);
  const std::string first = key.substr(1, key.find('/', 1) - 1);
  const auto among = [&](const auto& keys) { return std::ranges::find(keys, first) != keys.end(); };
  return among(keys_of_one_beam) || among(keys_of_whole_or_beam) ? entry + key : key;
}

int elements_of(const Scene& whole, std::size_t which) {
  const AssemblySpec& parts = *whole.assembly;
  const int drawn = parts.beams[which].scene.beam.elements;
  if (whole.beam.elements == parts.elements) return drawn;
  const double share = static_cast<double>(whole.beam.elements) / parts.elements;
  return std::max(1, static_cast<int>(std::lround(share * drawn)));
}

Scene beam_scene(const Scene& whole, std::size_t which) {
  const AssemblySpec& parts = *whole.assembly;
  Scene scene = parts.beams[which].scene;
  scene.setting = whole.setting;
  scene.title = parts.beams[which].name;
  scene.dimension = whole.dimension;
  scene.gravity = whole.gravity;
  scene.gravity_ramp = whole.gravity_ramp;
  scene.analysis = whole.analysis;
  scene.statics = whole.statics;
  scene.statics.control = LoadControl::load;  // of the whole alone
  scene.integrator = whole.integrator;
  scene.duration = whole.duration;
  scene.output = whole.output;
  scene.output.extremes = false;
  for (const LinkSpec& link : parts.links) {  // what a link holds needs a node of its own
    for (const LinkEndSpec& end : link.between) {
      if (end.of == LinkEndSpec::Of::joint && end.which == which) scene.length_control.end_merge.emplace(0);
    }
  }
  if (whole.analysis == Analysis::statics) {  // joints keep their places on the beam
    if (scene.sliding_mass) {
      scene.sliding_joints = sliding_joints(scene);
      scene.sliding_mass.reset();
    }
    for (SlidingJointSpec& joint : scene.sliding_joints) joint.x.emplace();
  }
  const int elements = elements_of(whole, which);
  if (elements != scene.beam.elements) scene = on_elements(scene, elements);
  const Scene& longest = parts.beams[parts.longest].scene;
  if (const int more = quadrature_points(whole) - quadrature_points(longest); more != 0) {
    scene.beam.polynomial_points = points_of_polynomials(scene) + more;
    scene.beam.quadrature_points = quadrature_points(scene) + more;
  }
  return scene;
}

Scene scene_of_beam(const Scene& whole, const std::string& beam) {
  if (beam.empty() || !whole.assembly) return whole;
  const auto& beams = whole.assembly->beams;
  const auto at = std::ranges::find(beams, beam, &AssemblySpec::Beam::name);
  return at == beams.end() ? whole : beam_scene(whole, static_cast<std::size_t>(at - beams.begin()));
}

Scene whole_scene(AssemblySpec parts) {
  for (std::size_t i = 0; i < parts.beams.size(); ++i) {
    if (beam_length(parts.beams[i].scene) > beam_length(parts.beams[parts.longest].scene)) parts.longest = i;
  }
  Scene whole = parts.beams[parts.longest].scene;
  parts.elements = whole.beam.elements;
  whole.start = whole.end = {};
  whole.sliding_mass.reset();
  whole.sliding_joints.clear();
  whole.blocks.clear();
  whole.contact.reset();
  whole.spin.reset();
  whole.loads.clear();
  whole.point_masses.clear();
  whole.places.clear();
  whole.initial_velocity.reset();
  whole.assembly = std::make_shared<const AssemblySpec>(std::move(parts));
  return whole;
}

std::array<Point, 3> axes_of(const Point& rotation_degrees) {
  const Eigen::Vector3d turn = Eigen::Map<const Eigen::Vector3d>(rotation_degrees.data()) * std::numbers::pi / 180;
  const double angle = turn.norm();
  std::array<Point, 3> axes{Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}};
  if (angle == 0) return axes;
  const Eigen::Vector3d n = turn / angle;
  const double c = portable::cos(angle), s = portable::sin(angle);
  for (Point& axis : axes) {
    const Eigen::Vector3d e = Eigen::Map<const Eigen::Vector3d>(axis.data());
    const Eigen::Vector3d turned = c * e + s * n.cross(e) + (1 - c) * n.dot(e) * n;  // Rodrigues
    axis = {turned[0], turned[1], turned[2]};
  }
  return axes;
}

Point place_on_body(const BodySpec& body, const Point& at) {
  const auto axes = axes_of(body.rotation);
  Point place = body.position;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < 3; ++i) place[c] += at[i] * axes[i][c];
  }
  return place;
}

std::string place_text(const Point& place, int dimension) {
  std::string text = "[";
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c)
    text += (c > 0 ? ", " : "") + six_digits(place[c]);
  return text + "]";
}

void check_names(const AssemblySpec& parts) {
  std::vector<std::string> taken;
  const auto check = [&taken](const char* list, const auto& entries) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      check_name(std::string(list) + std::to_string(i) + "/name", entries[i].name, taken);
    }
  };
  check("/beams/", parts.beams);
  check("/bodies/", parts.bodies);
  check("/links/", parts.links);
}

}  // namespace vlbeam
