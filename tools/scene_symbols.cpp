#include "tools/scene_symbols.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/elementary.hpp"
#include "scene/assembly.hpp"
#include "scene/derived.hpp"
#include "scene/shape.hpp"
#include "scene/time_function.hpp"

namespace vlbeam {
namespace {

using Pair = std::array<double, 2>;

constexpr int fine_intervals = 12;     // an element, along which places on the beam are looked up
constexpr double along_gravity = 0.7;  // a beam this steep has its ground beyond its end, not below it

Pair unit(Pair v) {
  const double size = portable::hypot(v[0], v[1]);
  return size > 0 ? Pair{v[0] / size, v[1] / size} : Pair{};
}
double dot(Pair a, Pair b) { return a[0] * b[0] + a[1] * b[1]; }

/// One shape on the axes of the picture.
class Picture {
 public:
  Picture(const Scene& scene, const Configuration& shape, std::size_t across, std::size_t up, std::size_t frame,
          std::vector<Symbol>& symbols)
      : scene_(scene),
        shape_(shape),
        points_(points_along(scene, shape, fine_intervals)),
        across_(across),
        up_(up),
        frame_(frame),
        symbols_(symbols) {
    const Pair down = flat(scene.gravity);
    if (down != Pair{}) down_ = unit(down);
  }

  void add_all() {
    add_support(scene_.start, points_.front(), 1);
    add_support(scene_.end, points_.back(), -1);
    for (const BearingSpec& bearing : scene_.bearings) add_bearing(bearing);
    for (const LoadSpec& load : scene_.loads) add_load(load);
    for (const VehicleSpec& vehicle : scene_.vehicles) add_vehicle(vehicle);
  }

 private:
  Pair flat(const Point& p) const { return {p[across_], p[up_]}; }
  void add(Symbol::Kind kind, Pair at, Pair way, Pair other = {}) {
    symbols_.push_back({kind, at, way, other, frame_});
  }

  const ShapePoint& point_at(double x) const {
    return *std::ranges::min_element(points_, {}, [x](const ShapePoint& point) { return std::abs(point.x - x); });
  }
  bool on_beam(double x) const { return x >= points_.front().x && x <= points_.back().x; }

  /// Across a tangent, down.
  Pair below(Pair tangent) const {
    const Pair normal{-tangent[1], tangent[0]};
    return dot(normal, down_) < 0 ? Pair{tangent[1], -tangent[0]} : normal;
  }

  /// `inward` is 1 where the axis leads into the beam.
  void add_support(const SupportSpec& support, const ShapePoint& end, double inward) {
    const Pair slope = unit(flat(end.r_x)), outward{-inward * slope[0], -inward * slope[1]};
    const Pair at = flat(end.r);
    if (support.pays_out()) return add(Symbol::Kind::winch, at, outward);
    switch (support.type) {
      case SupportType::clamp:
        return add(Symbol::Kind::clamp, at, outward);
      case SupportType::pin:
        return add(Symbol::Kind::pin, at, std::abs(dot(slope, down_)) > along_gravity ? outward : down_);
      case SupportType::slide:
        return add(Symbol::Kind::roller, at, below(slope));
      case SupportType::free:
        return;
    }
  }

  void add_bearing(const BearingSpec& bearing) {
    const ShapePoint& point = point_at(bearing.x);
    const Pair at = flat(point.r);
    if (bearing.type == BearingType::pin) return add(Symbol::Kind::pin, at, down_);
    if (bearing.type == BearingType::roller) return add(Symbol::Kind::roller, at, below(unit(flat(point.r_x))));
    if (bearing.to)
      return add(Symbol::Kind::hanger, at, unit({flat(*bearing.to)[0] - at[0], flat(*bearing.to)[1] - at[1]}),
                 flat(*bearing.to));
    const Pair along = unit(flat(bearing.direction));
    if (along == Pair{}) return add(Symbol::Kind::spring, at, down_);
    add(Symbol::Kind::spring, at, dot(along, down_) < 0 ? Pair{-along[0], -along[1]} : along);
  }

  void add_load(const LoadSpec& load) {
    const bool statics = scene_.analysis == Analysis::statics;
    const double magnitude = statics ? load.magnitude.value : time_function(load.magnitude)(shape_.t).value;
    if (magnitude == 0) return;
    if (load.at == LoadPlace::beam) {
      constexpr int arrows = 5;
      for (int i = 0; i < arrows; ++i) {
        const double part = (i + 0.5) / arrows;
        add_force(load, magnitude, points_[static_cast<std::size_t>(part * static_cast<double>(points_.size() - 1))]);
      }
      return;
    }
    if (load.at == LoadPlace::point) {
      const double x = beside_loads(load.x, scene_.analysis)(shape_.t).value;
      if (on_beam(x)) add_force(load, magnitude, point_at(x));
      return;
    }
    // nodes keep their numbers only as long as none is cut in or merged: those of the drawing are places on the beam
    add_force(load, magnitude, point_at(load.node * beam_length(scene_) / scene_.beam.elements));
  }

  void add_force(const LoadSpec& load, double magnitude, const ShapePoint& point) {
    const double sign = magnitude > 0 ? 1 : -1;
    if (load.type == LoadType::moment || load.type == LoadType::torque) {
      return add(Symbol::Kind::moment, flat(point.r), {sign, 0});
    }
    const Pair along = unit(load.type == LoadType::follower ? flat(point.r_x) : flat(load.direction));
    if (along != Pair{}) add(Symbol::Kind::force, flat(point.r), {sign * along[0], sign * along[1]});
  }

  void add_vehicle(const VehicleSpec& vehicle) {
    const double first = beside_loads(vehicle.x, scene_.analysis)(shape_.t).value;
    for (const AxleSpec& axle : vehicle.axles) {
      const double x = first - axle.distance;
      if (!on_beam(x)) continue;
      const ShapePoint& point = point_at(x);
      add(Symbol::Kind::wheel, flat(point.r), below(unit(flat(point.r_x))));
    }
  }

  const Scene& scene_;
  const Configuration& shape_;
  std::vector<ShapePoint> points_;
  std::size_t across_, up_, frame_;
  std::vector<Symbol>& symbols_;
  Pair down_{0, -1};
};

}  // namespace

std::vector<Symbol> symbols_of(const RunFile& run, const std::vector<Configuration>& shapes, std::size_t across,
                               std::size_t up) {
  std::vector<Symbol> symbols;
  std::size_t frame = 0;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (i > 0 && shapes[i].t != shapes[i - 1].t) ++frame;
    const Scene scene = scene_of_beam(run.scene, shapes[i].beam);
    Picture(scene, shapes[i], across, up, frame, symbols).add_all();
  }
  const double down = run.scene.gravity[up];
  if (run.scene.ground && down != 0 && run.scene.gravity[across] == 0) {
    const Pair way{0, down > 0 ? 1.0 : -1.0};
    symbols.push_back({Symbol::Kind::floor, {0, -way[1] * run.scene.ground->height}, way, {}, 0});
  }
  return symbols;
}

Symbol wheel_at(const Scene& scene, const Configuration& shape, Pair at, std::size_t across, std::size_t up,
                std::size_t frame) {
  const std::vector<ShapePoint> points = points_along(scene, shape, fine_intervals);
  const auto far = [&](const ShapePoint& point) {
    return portable::hypot(point.r[across] - at[0], point.r[up] - at[1]);
  };
  const auto nearest = std::ranges::min_element(points, {}, far);
  Pair outside{};
  if (nearest - points.begin() > 1 && points.end() - nearest > 2) {  // a node stands there twice
    const Point &before = nearest[-2].r, &here = nearest->r, &behind = nearest[2].r;
    outside = unit({2 * here[across] - before[across] - behind[across], 2 * here[up] - before[up] - behind[up]});
  }
  return {Symbol::Kind::wheel, at, outside == Pair{} ? Pair{0, 1} : outside, {}, frame};
}

}  // namespace vlbeam
