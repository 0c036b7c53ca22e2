#include "scene/bearings.hpp"

#include <algorithm>
#include <string>

#include "core/error.hpp"
#include "mechanics/bearings/held_points.hpp"
#include "mechanics/bearings/point_springs.hpp"
#include "mechanics/rooms.hpp"
#include "scene/across.hpp"
#include "scene/build.hpp"
#include "scene/corners.hpp"
#include "scene/derived.hpp"
#include "scene/names.hpp"
#include "scene/options.hpp"
#include "scene/run_support.hpp"
#include "scene/shared_checks.hpp"

namespace vlbeam {
namespace {

bool is_spring(const BearingSpec& bearing) { return bearing.type == BearingType::spring; }

template <int D>
std::vector<Vec<double, D>> held_directions(const BearingSpec& bearing, const Vec<double, D>& tangent) {
  if (bearing.type != BearingType::pin) return across<D>(tangent);
  std::vector<Vec<double, D>> directions;
  for (int c = 0; c < D; ++c) directions.push_back(Vec<double, D>::Unit(c));
  return directions;
}

template <int D>
PointSpring<D> spring_of(const BearingSpec& bearing, const Vec<double, D>& drawn) {
  PointSpring<D> spring{.x = bearing.x,
                        .place = drawn,
                        .stiffness = bearing.stiffness,
                        .damping = bearing.damping,
                        .tension_only = bearing.tension_only};
  if (bearing.to) {
    spring.place = vector_of<D>(*bearing.to);
    spring.length = bearing.length.value_or((drawn - spring.place).norm());
  } else if (bearing.direction != Point{}) {
    spring.along = vector_of<D>(bearing.direction).normalized();
  }
  return spring;
}

void check_spring(const BearingSpec& bearing, const std::string& at, const Axis<3>& axis) {
  const bool along = bearing.direction != Point{};
  if (bearing.stiffness == 0 && bearing.damping == 0) {
    refuse(at + "/stiffness", "0", "with no damping either, the spring does nothing: it must be > 0 [N/m]");
  }
  if (bearing.to && along) refuse(at + "/direction", "this key", "a spring with \"to\" bears along its own line");
  if (bearing.length && !bearing.to) {
    refuse(at + "/length", "this key", "it is that of a spring with \"to\", the place of its other end");
  }
  if (bearing.tension_only && !bearing.to && !along) {
    refuse(at + "/tension_only", "true", "the spring needs a line that it pulls along: \"to\", or \"direction\"");
  }
  const double apart = bearing.to ? (vector_of<3>(*bearing.to) - axis.position(bearing.x)).norm() : 1;
  if (!(apart > corner_rounding * axis.length())) {
    refuse(at + "/to", "the point that the spring holds",
           "the spring needs a line to bear along: another place, or leave it out");
  }
}

void check_held(const Scene& scene, std::size_t which, const std::string& at) {
  const BearingSpec& bearing = scene.bearings[which];
  const std::string what = "a " + std::string(to_string(bearing.type)) + " at x = " + six_digits(bearing.x) + " m";
  if (scene.analysis == Analysis::dynamics && !takes_links(scene.integrator.type)) {
    refuse(at + "/type", what,
           "it goes together with explicit integrators and \"generalized-alpha\": take one, or a \"spring\"");
  }
  const auto joints = sliding_joints(scene);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (joint_slopes(scene, joints[i]) != JointSlopes::continuous) {
      refuse(joint_key(scene, i) + "/slopes", quoted(joint_slopes(scene, joints[i])),
             "a kink that passes over " + what + " strikes it: it must be \"continuous\", or take a \"spring\"");
    }
    if (joints[i].friction) {
      refuse(joint_key(scene, i) + "/friction", "this key",
             "it does not go together with " + what + ": leave it out, or take a \"spring\"");
    }
    if (joints[i].pitch) {
      refuse(joint_key(scene, i) + "/pitch", "this key",
             "a nut does not go together with " + what + ": take a \"spring\"");
    }
  }
  if (scene.length_control.velocities == VelocityTransfer::conservative && !joints.empty()) {
    refuse("/length_control/velocities", "\"conservative\"",
           "with " + what + " it must be \"nodal\" or \"projected\": momentum is not kept");
  }
}

}  // namespace

std::string bearing_name(const Scene& scene, std::size_t which) {
  const std::string& name = scene.bearings[which].name;
  return name.empty() ? std::to_string(which) : name;
}

void validate_bearings(const Scene& scene) {
  if (scene.bearings.empty()) return;
  const Axis<3> axis = build_axis<3>(scene);
  for (std::size_t i = 0; i < scene.bearings.size(); ++i) {
    const BearingSpec& bearing = scene.bearings[i];
    const std::string at = "/bearings/" + std::to_string(i);
    if (!is_plain_name(bearing.name)) {
      refuse(at + "/name", "\"" + bearing.name + "\"", "it must be letters, digits and underscores");
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (bearing_name(scene, k) == bearing_name(scene, i)) {
        refuse(at + "/name", "\"" + bearing_name(scene, i) + "\"", "another support has that name");
      }
    }
    const bool inside = bearing.x > 0 && bearing.x < axis.length();
    if (!inside && !(is_spring(bearing) && bearing.x <= axis.length())) {
      refuse(at + "/at/x", number_text(bearing.x),
             is_spring(bearing)
                 ? "it must be on the beam, at most " + number_text(axis.length()) + " [m]"
                 : "it must be between the ends of the beam: more than 0 and less than " + number_text(axis.length()) +
                       " [m]; supports of the ends are {\"at\": \"start\"} and {\"at\": \"end\"}");
    }
    if (flows(scene))
      refuse(at, "this support", "with \"flow\" and rotary inertia, supports stand at nodes: /flow/nodes");
    if (fed(scene)) refuse(at, "this support", "beside a winch beam comes and goes at the ends alone: take a ring");
    if (is_spring(bearing)) {
      check_spring(bearing, at, axis);
      if (scene.integrator.type == IntegratorType::energy_momentum && scene.analysis == Analysis::dynamics) {
        refuse(at + "/type", "\"spring\"", "energy-momentum knows none: take any other integrator");
      }
    } else {
      check_held(scene, i, at);
    }
  }
}

template <int D>
void add_bearings([[maybe_unused]] const Scene& scene, [[maybe_unused]] const Axis<D>& axis,
                  [[maybe_unused]] BeamModel<D>& model) {
  if constexpr (has_room("bearings")) {
    std::vector<HeldPoint<D>> held;
    std::vector<PointSpring<D>> springs;
    for (const BearingSpec& bearing : scene.bearings) {
      const Vec<double, D> drawn = axis.position(bearing.x);
      if (is_spring(bearing)) {
        springs.push_back(spring_of<D>(bearing, drawn));
      } else {
        held.push_back({bearing.x, drawn, held_directions<D>(bearing, axis.tangent(bearing.x).normalized())});
      }
    }
    if (!held.empty()) model.rooms.push_back(std::make_shared<const HeldPoints<D>>(std::move(held)));
    if (!springs.empty()) model.parts.push_back(std::make_shared<const PointSprings<D>>(std::move(springs)));
  }
}

template <int D>
std::vector<BearingSample> bearing_samples(const Scene& scene, const BeamSystem<D>& system, const Eigen::VectorXd& y,
                                           const OuterForces<D>& forces) {
  std::vector<BearingSample> samples;
  if constexpr (has_room("bearings")) {
    if (scene.bearings.empty()) return samples;
    const auto* const springs = part_of<PointSprings<D>>(system.model());
    const ChainView<D> beam = system.view(y.data(), y.data() + system.coordinates());
    const auto& links = system.links().all();
    std::size_t spring = 0, link = 0;
    for (const BearingSpec& bearing : scene.bearings) {
      const int k = beam.element_at(bearing.x);
      const PointMotion<double, D> at = point_at<double, D>(beam.kinematics(k), bearing.x);
      Vec<double, D> force = Vec<double, D>::Zero();
      if (is_spring(bearing)) {
        force = springs->all()[spring++].template force<double>(at.r, at.v);
      } else {
        while (!links[link].place) ++link;
        for (; link < links.size() && links[link].place == bearing.x; ++link) {
          force += forces.links[link] * *links[link].along;
        }
      }
      samples.push_back({point_of<D>(at.r), point_of<D>(force)});
    }
  }
  return samples;
}

template void add_bearings(const Scene&, const Axis<2>&, BeamModel<2>&);
template void add_bearings(const Scene&, const Axis<3>&, BeamModel<3>&);
template std::vector<BearingSample> bearing_samples(const Scene&, const BeamSystem<2>&, const Eigen::VectorXd&,
                                                    const OuterForces<2>&);
template std::vector<BearingSample> bearing_samples(const Scene&, const BeamSystem<3>&, const Eigen::VectorXd&,
                                                    const OuterForces<3>&);

}  // namespace vlbeam
