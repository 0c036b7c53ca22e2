#include "scene/section_sample.hpp"

#include <numbers>

#include "core/geometry/elementary.hpp"
#include "mechanics/frames/frame_unknowns.hpp"
#include "mechanics/motion/parts/material_point.hpp"
#include "mechanics/rooms.hpp"
#include "scene/bearings.hpp"
#include "scene/build.hpp"
#include "scene/derived.hpp"
#include "scene/run_support.hpp"
#include "scene/section_forces.hpp"
#include "scene/vehicles.hpp"

namespace vlbeam {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// The material coordinate of a joint while it is on the beam [m].
template <int D>
std::optional<double> mark_of(const BeamSystem<D>& system, const Eigen::VectorXd& y, int joint) {
  if (!system.on_beam(joint)) return {};
  return y[system.loose() != nullptr ? system.dofs().mark() : system.place_of(joint).mark];
}

/// Looks at the sections of one state.
template <int D>
class SectionsSeen {
 public:
  SectionsSeen(const Scene& scene, const BeamSystem<D>& system, const Eigen::VectorXd& y, const Configuration& shape)
      : scene_(scene), system_(system), y_(y), shape_(shape), sections_(scene, shape) {}

  void look_at_beam(SectionSample& sample) const {
    const auto slope_at = [this](const Point& slope) { return beam_angle<D>(scene_, vector_of<D>(slope)); };
    const auto* const kink = shape_.kink_at(0);
    sample.angles = {slope_at(kink != nullptr ? kink->r_x : shape_.r_x.front()), slope_at(shape_.r_x.back())};
    const bool frames = !shape_.moments.empty(), bends = system_.model().section.bends() || frames;
    if (!bends && !sections_.has_stress()) return;
    const auto extremes = sections_.extremes();
    if (bends) {
      sample.axial = extremes.axial;
      sample.moment = extremes.moment;
    }
    if (bends && !frames) sample.shear = extremes.shear;
    if (frames) sample.torque = extremes.torque;
    if (sections_.has_stress()) sample.stress = extremes.stress;
  }

  /// Of an end whose place is held, by its reaction; of a winch by what that says.
  std::optional<double> tension(bool at_start, const OuterForces<D>& forces,
                                const std::optional<WinchSample>& winch) const {
    if (winch) return winch->tension;
    const SupportType type = (at_start ? scene_.start : scene_.end).type;
    if (type != SupportType::clamp && type != SupportType::pin) return {};
    const Vec<double, D> reaction = forces.supports[at_start ? 0 : 1].template head<D>();
    const Vec<double, D> tangent = vector_of<D>(at_start ? shape_.r_x.front() : shape_.r_x.back()).normalized();
    return (at_start ? -1 : 1) * reaction.dot(tangent);
  }

  std::optional<PlaceSample> look_at(const PlaceSpec& place) const {
    std::optional<double> x = place.x;
    if (place.end) x = *place.end == BeamEnd::start ? shape_.x.front() : shape_.x.back();
    if (place.joint) x = mark_of(system_, y_, *place.joint);
    if (!x) return {};
    const auto seen = sections_.place(*x);
    if (!seen) return {};
    PlaceSample sample{point_of<D>(seen->r), point_of<D>(seen->v), beam_angle<D>(scene_, seen->r_x), seen->force};
    if (place.joint) {
      if (const auto mass = system_.mass_motion(y_, *place.joint)) {
        sample.position = point_of<D>(mass->r);
        sample.velocity = point_of<D>(mass->v);
      }
    }
    return sample;
  }

 private:
  const Scene& scene_;
  const BeamSystem<D>& system_;
  const Eigen::VectorXd& y_;
  const Configuration& shape_;
  SectionForces<D> sections_;
};

}  // namespace

template <int D>
double beam_angle(const Scene& scene, const Vec<double, D>& r_x) {
  if constexpr (D == 2) {
    return degrees * portable::atan2(r_x[1], r_x[0]);
  } else {
    const Vec<double, 3> gravity = vector_of<3>(scene.gravity);
    const Vec<double, 3> up = gravity.isZero(0) ? Vec<double, 3>(0, 0, 1) : Vec<double, 3>(-gravity.normalized());
    return degrees * portable::atan2(r_x.dot(up), r_x.cross(up).norm());
  }
}

std::vector<PlaceSpec> resolved_places(const Scene& scene) {
  std::vector<PlaceSpec> places = scene.places;
  for (PlaceSpec& place : places) {
    if (!place.point_mass) continue;
    const InitialNodes nodes = place_nodes(scene, build_axis<3>(scene).breaks());
    place.x = nodes.x[static_cast<std::size_t>(nodes.masses[static_cast<std::size_t>(*place.point_mass)])];
  }
  return places;
}

template <int D>
Configuration shape_of(const Scene& scene, const BeamSystem<D>& system, const Eigen::VectorXd& y, double t,
                       const OuterForces<D>& forces) {
  Configuration shape = configuration_of(system.chain(y, t), t, weight_transport(scene));
  if constexpr (D == 3 && has_room("frames")) {
    if (has_frames(scene)) {
      for (const auto& [a, b] : frames_of(system)->moments(y.data())) {
        shape.moments.push_back({Point{a.y, a.z, a.torsion}, Point{b.y, b.z, b.torsion}});
      }
    }
  }
  for (const JointPlace& place : system.places()) shape.actions.push_back({y[place.mark]});
  if (system.loose() != nullptr && system.on_beam(0)) {
    shape.actions.push_back({*mark_of(system, y, 0), point_of<D>(-forces.on_masses.front())});
  }
  for (const PointMass& mass : system.model().masses.points) shape.actions.push_back({mass.x});
  for (const AxleSample& axle : axle_samples(scene, system, y, t, forces)) {
    if (axle.force) shape.actions.push_back({axle.x, pushed_down(scene, *axle.force)});
  }
  if (const auto bearings = bearing_samples(scene, system, y, forces); !bearings.empty()) {
    for (std::size_t i = 0; i < bearings.size(); ++i) {
      shape.actions.push_back({scene.bearings[i].x, bearings[i].force});
    }
  }
  if (scene.flow) {
    for (const FlowSpec::Guide& guide : scene.flow->nodes) {
      if (guide.support != SupportType::free) shape.actions.push_back({shape.x[static_cast<std::size_t>(guide.node)]});
    }
  }
  if (system.model().loads.points.empty()) return shape;
  const ChainView<D> beam = system.view(y.data(), y.data() + system.coordinates());
  for (const PointLoad<D>& load : system.model().loads.points) {
    const double x = load.place(beam, t);
    if (!load.acts_at(x, beam)) continue;
    const auto at = point_at<double, D>(beam.kinematics(beam.element_at(x)), x);
    shape.actions.push_back({x, point_of<D>(load.force_on(at.r_x, t))});
  }
  return shape;
}

template <int D>
std::shared_ptr<const SectionSample> section_sample(const Scene& scene, const std::vector<PlaceSpec>& places,
                                                    const BeamSystem<D>& system, const Eigen::VectorXd& y,
                                                    const Configuration& shape, const OuterForces<D>& forces,
                                                    const std::array<std::optional<WinchSample>, 2>& winches) {
  const SectionsSeen<D> seen(scene, system, y, shape);
  auto sample = std::make_shared<SectionSample>();
  seen.look_at_beam(*sample);
  sample->tension = {seen.tension(true, forces, winches[0]), seen.tension(false, forces, winches[1])};
  for (const PlaceSpec& place : places) sample->places.push_back(seen.look_at(place));
  sample->bearings = bearing_samples(scene, system, y, forces);
  sample->axles = axle_samples(scene, system, y, shape.t, forces);
  return sample;
}

template double beam_angle<2>(const Scene&, const Vec<double, 2>&);
template double beam_angle<3>(const Scene&, const Vec<double, 3>&);
template Configuration shape_of(const Scene&, const BeamSystem<2>&, const Eigen::VectorXd&, double,
                                const OuterForces<2>&);
template Configuration shape_of(const Scene&, const BeamSystem<3>&, const Eigen::VectorXd&, double,
                                const OuterForces<3>&);
template std::shared_ptr<const SectionSample> section_sample(const Scene&, const std::vector<PlaceSpec>&,
                                                             const BeamSystem<2>&, const Eigen::VectorXd&,
                                                             const Configuration&, const OuterForces<2>&,
                                                             const std::array<std::optional<WinchSample>, 2>&);
template std::shared_ptr<const SectionSample> section_sample(const Scene&, const std::vector<PlaceSpec>&,
                                                             const BeamSystem<3>&, const Eigen::VectorXd&,
                                                             const Configuration&, const OuterForces<3>&,
                                                             const std::array<std::optional<WinchSample>, 2>&);

}  // namespace vlbeam
