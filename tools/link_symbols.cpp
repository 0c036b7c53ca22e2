#include "tools/link_symbols.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/geometry/elementary.hpp"
#include "scene/assembly.hpp"
#include "scene/derived.hpp"

namespace vlbeam {
namespace {

using Pair = std::array<double, 2>;

constexpr const char* axis_names = "xyz";

/// A point turned by a rotation vector [degrees] (Rodrigues).
Point turned(const Point& p, const Point& rotation) {
  Point w{};
  for (std::size_t c = 0; c < 3; ++c) w[c] = rotation[c] * std::numbers::pi / 180;
  const double angle = std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
  if (angle == 0) return p;
  for (double& c : w) c /= angle;
  const Point across{w[1] * p[2] - w[2] * p[1], w[2] * p[0] - w[0] * p[2], w[0] * p[1] - w[1] * p[0]};
  const double along = w[0] * p[0] + w[1] * p[1] + w[2] * p[2];
  const double c = portable::cos(angle), s = portable::sin(angle);
  Point result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = c * p[i] + s * across[i] + (1 - c) * along * w[i];
  return result;
}

/// One instant of an assembly on the axes of the picture.
class Instant {
 public:
  Instant(const RunFile& run, std::size_t sample, const Configuration* shapes, std::size_t across, std::size_t up,
          std::size_t frame, std::vector<Symbol>& symbols)
      : run_(run),
        parts_(*run.scene.assembly),
        sample_(sample),
        shapes_(shapes),
        across_(across),
        up_(up),
        frame_(frame),
        symbols_(symbols) {}

  void add_all() {
    for (const BodySpec& body : parts_.bodies) {
      const Point center = vector(body.name + ".position");
      for (const BodyPointSpec& point : body.points) add(Symbol::Kind::rod, center, place_on(body, point.at));
    }
    for (const LinkSpec& link : parts_.links) add_link(link);
  }

 private:
  double number(const std::string& name) const { return run_.column(find_quantity(run_.scene, name))[sample_]; }
  Point vector(const std::string& name) const {
    Point value{};
    for (std::size_t c = 0; c < static_cast<std::size_t>(run_.scene.dimension); ++c) {
      value[c] = number(name + "." + axis_names[c]);
    }
    return value;
  }
  Point place_on(const BodySpec& body, const Point& at) const {
    Point rotation{};
    if (!body.inertia.empty() && run_.scene.dimension == 2) rotation[2] = number(body.name + ".angle");
    if (!body.inertia.empty() && run_.scene.dimension == 3) rotation = vector(body.name + ".rotation");
    const Point center = vector(body.name + ".position"), arm = turned(at, rotation);
    return {center[0] + arm[0], center[1] + arm[1], center[2] + arm[2]};
  }
  Point place_of(const LinkEndSpec& end) const {
    if (end.of == LinkEndSpec::Of::ground) return end.place;
    if (end.of == LinkEndSpec::Of::body) return place_on(parts_.bodies[end.which], end.place);
    const std::string& beam = parts_.beams[end.which].name;
    if (end.of == LinkEndSpec::Of::joint) return vector(beam + ".joint " + std::to_string(end.joint) + ".place");
    const Configuration& shape = shapes_[end.which];
    if (end.of == LinkEndSpec::Of::beam_start) return shape.r.front();
    if (end.of == LinkEndSpec::Of::beam_end) return shape.r.back();
    // nodes keep their material points, not their numbers
    const Scene scene = beam_scene(run_.scene, end.which);
    const double x = end.joint * beam_length(scene) / scene.beam.elements;
    const auto nearest = std::ranges::min_element(shape.x, {}, [x](double node) { return std::abs(node - x); });
    return shape.r[static_cast<std::size_t>(nearest - shape.x.begin())];
  }

  void add_link(const LinkSpec& link) {
    const Point from = place_of(link.between[0]), to = place_of(link.between[1]);
    const bool on_ground =
        std::ranges::any_of(link.between, [](const LinkEndSpec& end) { return end.of == LinkEndSpec::Of::ground; });
    switch (link.type) {
      case LinkType::spring:
        return add(Symbol::Kind::coil, from, to);
      case LinkType::distance:
        return add(Symbol::Kind::rod, from, to);
      case LinkType::rail: {
        const Point at = link.between[0].of == LinkEndSpec::Of::ground ? to : from;
        const Point& along = link.direction;
        return add(Symbol::Kind::rail, at, {at[0] + along[0], at[1] + along[1], at[2] + along[2]});
      }
      case LinkType::clamp:
        return add(on_ground ? Symbol::Kind::clamp : Symbol::Kind::block, from, from);
      case LinkType::pin:
      case LinkType::slide:
        return add(on_ground ? Symbol::Kind::pin : Symbol::Kind::hinge, from, from);
    }
  }

  void add(Symbol::Kind kind, const Point& at, const Point& other) {
    const Pair a{at[across_], at[up_]}, b{other[across_], other[up_]};
    Pair way{b[0] - a[0], b[1] - a[1]};
    const double size = portable::hypot(way[0], way[1]);
    way = size > 0 ? Pair{way[0] / size, way[1] / size} : Pair{0, -1};
    symbols_.push_back({kind, a, way, b, frame_});
  }

  const RunFile& run_;
  const AssemblySpec& parts_;
  std::size_t sample_;
  const Configuration* shapes_;  ///< of its beams, in order
  std::size_t across_, up_, frame_;
  std::vector<Symbol>& symbols_;
};

}  // namespace

std::vector<Symbol> link_symbols(const RunFile& run, const std::vector<Configuration>& shapes, std::size_t across,
                                 std::size_t up) {
  std::vector<Symbol> symbols;
  if (!run.scene.assembly) return symbols;
  const std::size_t beams = run.scene.assembly->beams.size();
  for (std::size_t first = 0, frame = 0; first + beams <= shapes.size(); first += beams, ++frame) {
    const auto at = std::ranges::find_if(run.t, [&](double t) { return at_same_time(t, shapes[first].t); });
    if (at == run.t.end()) continue;
    Instant(run, static_cast<std::size_t>(at - run.t.begin()), &shapes[first], across, up, frame, symbols).add_all();
  }
  return symbols;
}

}  // namespace vlbeam
