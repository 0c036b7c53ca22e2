#include "scene/build_loads.hpp"

#include <algorithm>
#include <numbers>

#include "core/geometry/elementary.hpp"
#include "mechanics/frames/frame_sections.hpp"
#include "scene/build.hpp"
#include "scene/section_data.hpp"
#include "scene/time_function.hpp"

namespace vlbeam {
namespace {

/// A force may turn about `axis`, a unit vector.
template <int D>
PointLoad<D> build_load(const LoadSpec& spec, const Vec<double, D>& axis, Analysis analysis) {
  const TimeFunction magnitude = acting(spec.magnitude, analysis), x = beside_loads(spec.x, analysis);
  PointLoad<D> load;
  if (spec.at == LoadPlace::node) load.node = spec.node;
  if (spec.at == LoadPlace::point) load.x = [x](double t) { return x(t).value; };
  auto size = [magnitude](double t) { return magnitude(t).value; };
  if (spec.type == LoadType::follower) load.follower = size;
  if (D == 2 && spec.type == LoadType::moment) load.moment = size;
  if (spec.type == LoadType::force) {
    const Vec<double, D> direction = Eigen::Map<const Vec<double, D>>(spec.direction.data()).normalized();
    const TimeFunction turn = beside_loads(spec.turn, analysis);
    load.force = [=](double t) -> Vec<double, D> {
      const double angle = turn(t).value, c = portable::cos(angle), s = portable::sin(angle);
      if constexpr (D == 2) {
        return size(t) * Vec<double, D>(c * direction[0] - s * direction[1], s * direction[0] + c * direction[1]);
      } else {
        return size(t) *
               (c * direction + s * axis.cross(direction) + (1 - c) * axis.dot(direction) * axis);  // Rodrigues
      }
    };
  }
  return load;
}

/// A moment in space. One that follows has the components of its axis at the section as it was built.
SectionMoment build_moment(const Scene& scene, const LoadSpec& spec) {
  Vec<double, 3> direction = vector_of<3>(spec.direction).normalized();
  if (spec.follows) {
    const ChainState<3> built = build_shape<3>(scene);
    const Vec<double, 3> t = slope<3>(built.q.data(), spec.node).normalized(),
                         y = sections_of(built).now[static_cast<std::size_t>(spec.node)].direction;
    direction = Vec<double, 3>(t.dot(direction), y.dot(direction), t.cross(y).dot(direction));
  }
  return {spec.node == scene.beam.elements ? -1 : spec.node, direction, spec.follows,
          [magnitude = acting(spec.magnitude, scene.analysis)](double t) { return magnitude(t).value; }};
}

/// Material coordinate at t = 0 of where a load acts; of one on the whole beam its start [m].
double initial_place(const LoadSpec& spec, const std::vector<double>& nodes) {
  switch (spec.at) {
    case LoadPlace::node:
      return nodes[static_cast<std::size_t>(std::clamp(spec.node, 0, static_cast<int>(nodes.size()) - 1))];
    case LoadPlace::point:
      return time_function(spec.x)(0).value;
    case LoadPlace::beam:
      break;
  }
  return 0;
}

template <class Value>
void add_to(std::function<Value(double t)>& sum, const std::function<Value(double t)>& more) {
  if (!sum) {
    sum = more;
  } else {
    sum = [before = sum, more](double t) -> Value { return before(t) + more(t); };
  }
}

}  // namespace

template <int D>
BeamLoads<D> build_loads(const Scene& scene) {
  BeamLoads<D> result;
  if (scene.fluid && scene.fluid->density > 0 && scene.beam.sections.empty()) {
    const double area = scene.fluid->area.value_or(displaced_area(scene.beam.section));
    const Vec<double, D> lift = -scene.fluid->density * area * vector_of<D>(scene.gravity);
    const TimeFunction share = acting({.value = 1, .ramp = scene.gravity_ramp}, scene.analysis);
    result.loads.line_force = [share, lift](double t) -> Vec<double, D> { return share(t).value * lift; };
  }
  if (scene.loads.empty()) return result;
  const Axis<D> axis = build_axis<D>(scene);
  const std::vector<double> nodes = place_nodes(scene, axis.breaks()).x;
  for (const LoadSpec& spec : scene.loads) {
    const double x = std::clamp(initial_place(spec, nodes), 0.0, axis.length());
    PointLoad<D> load = build_load<D>(spec, axis.tangent(x).normalized(), scene.analysis);
    if (spec.type == LoadType::torque) {
      const std::function<double(double t)> torque = [size = acting(spec.magnitude, scene.analysis)](double t) {
        return size(t).value;
      };
      if (spec.at == LoadPlace::beam) {
        add_to(result.torques.line, torque);
        continue;
      }
      result.torques.points.push_back({load.node, load.x, torque});
    }
    if constexpr (D == 3) {
      if (spec.type == LoadType::moment) result.moments.push_back(build_moment(scene, spec));
    }
    if (spec.at == LoadPlace::beam) {
      add_to(result.loads.line_force, load.force);
    } else {
      result.loads.points.push_back(std::move(load));
    }
  }
  return result;
}

template BeamLoads<2> build_loads(const Scene&);
template BeamLoads<3> build_loads(const Scene&);

}  // namespace vlbeam
