#include "scene/assembly.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "core/geometry/vec.hpp"
#include "scene/derived.hpp"

namespace vlbeam {
std::string key_in_assembly(std::size_t which, const std::string& key) {
  const std::string entry = "/beams/" + std::to_string(which);
  if (key.starts_with("/beam/")) return entry + key.substr(5);
  for (const char* own : {"/supports", "/sliding_mass", "/sliding_joints", "/blocks", "/contact", "/point_masses",
                          "/loads", "/places", "/length_control", "/drag", "/fluid", "/spin"}) {
    if (key.starts_with(own)) return entry + key;
  }
  return key;
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
  if (whole.beam.elements != parts.elements) {
    const double share = static_cast<double>(whole.beam.elements) / parts.elements;
    scene.beam.elements = std::max(1, static_cast<int>(std::lround(share * scene.beam.elements)));
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

}  // namespace vlbeam
