#include "scene/vehicles.hpp"

#include <algorithm>
#include <memory>
#include <string>

#include "core/error.hpp"
#include "mechanics/rooms.hpp"
#include "mechanics/vehicles/vehicles.hpp"
#include "scene/build.hpp"
#include "scene/derived.hpp"
#include "scene/names.hpp"
#include "scene/options.hpp"
#include "scene/run_support.hpp"
#include "scene/shared_checks.hpp"
#include "scene/time_function.hpp"

namespace vlbeam {
namespace {

void check_axle(const AxleSpec& axle, const std::string& at) {
  if (axle.force == 0 && axle.mass == 0 && axle.sprung_mass == 0) {
    refuse(at, "an axle without force and mass",
           "it must have at least one of \"force\", \"mass\" and \"sprung_mass\"");
  }
  if (axle.sprung_mass > 0 && axle.stiffness == 0) {
    refuse(at + "/stiffness", "0", "the sprung mass stands on it: it must be > 0 [N/m]");
  }
  if (axle.sprung_mass == 0 && (axle.stiffness > 0 || axle.damping > 0)) {
    refuse(at + "/sprung_mass", "0", "nothing stands on the spring: it must be > 0 [kg], or leave the spring out");
  }
}

/// Some axle is on the beam at some time.
bool comes(const Scene& scene, const VehicleSpec& vehicle, double length) {
  constexpr int instants = 2000;
  const TimeFunction x = time_function(vehicle.x);
  for (int i = 0; i <= instants; ++i) {
    const double first = x(scene.duration * i / instants).value;
    for (const AxleSpec& axle : vehicle.axles) {
      if (first - axle.distance >= 0 && first - axle.distance <= length) return true;
    }
  }
  return false;
}

void check_company(const Scene& scene) {
  const auto none = [](bool there, const std::string& key, const std::string& value, const std::string& why) {
    if (there) refuse(key, value, "it does not go together with /vehicles: " + why);
  };
  none(scene.analysis == Analysis::statics, "/analysis", "\"statics\"",
       "they roll in time; for a vehicle at rest take /loads at its axles");
  none(starts_in_equilibrium(scene), "/initial_shape", "\"equilibrium\"",
       "they would stand on it; take a gravity_ramp");
  none(scene.spin.has_value(), "/spin", "this key", "leave one of the two out");
  none(flows(scene), scene.flow ? "/flow" : "/beam/rotary_inertia", "this key", "leave one of the two out");
  none(has_frames(scene), "/beam/space_law", "\"frames\"", "take \"scalar\"");
  none(fed(scene), "/supports", "a winch", "the beam must keep its length");
  none(!takes_links(scene.integrator.type), "/integrator/type", quoted(scene.integrator.type),
       "take \"generalized-alpha\" or an explicit method");
}

template <int D>
Vec<double, D> up_of(const Scene& scene) {
  const Vec<double, D> gravity = vector_of<D>(scene.gravity);
  return gravity.isZero(0) ? Vec<double, D>(Vec<double, D>::Unit(D - 1)) : Vec<double, D>(-gravity.normalized());
}

}  // namespace

void validate_vehicles(const Scene& scene) {
  if (scene.vehicles.empty()) return;
  const double length = beam_length(scene);
  for (std::size_t i = 0; i < scene.vehicles.size(); ++i) {
    const VehicleSpec& vehicle = scene.vehicles[i];
    const std::string at = "/vehicles/" + std::to_string(i);
    if (vehicle.name.empty() || !is_plain_name(vehicle.name)) {
      refuse(at + "/name", "\"" + vehicle.name + "\"", "it must be letters, digits and underscores");
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (scene.vehicles[k].name != vehicle.name) continue;
      refuse(at + "/name", "\"" + vehicle.name + "\"", "vehicle " + std::to_string(k) + " has that name");
    }
    if (vehicle.axles.empty()) refuse(at + "/axles", InvalidInput::missing, "a vehicle needs an axle");
    for (std::size_t k = 0; k < vehicle.axles.size(); ++k) {
      check_axle(vehicle.axles[k], at + "/axles/" + std::to_string(k));
    }
    check_time_function(at + "/x", vehicle.x);
  }
  check_company(scene);
  for (std::size_t i = 0; i < scene.vehicles.size(); ++i) {
    if (comes(scene, scene.vehicles[i], length)) continue;
    refuse("/vehicles/" + std::to_string(i) + "/x",
           number_text(time_function(scene.vehicles[i].x)(0).value) + " m at t = 0",
           "no axle is ever on the beam, at 0 to " + number_text(length) + " m, within /duration");
  }
}

template <int D>
void add_vehicles([[maybe_unused]] const Scene& scene, [[maybe_unused]] const Axis<D>& axis,
                  [[maybe_unused]] BeamModel<D>& model) {
  if constexpr (has_room("vehicles")) {
    if (scene.vehicles.empty()) return;
    Axles<D> axles;
    axles.up = up_of<D>(scene);
    axles.before = axles.up.dot(axis.position(0));
    axles.behind = axles.up.dot(axis.position(axis.length()));
    for (const VehicleSpec& vehicle : scene.vehicles) {
      for (const AxleSpec& axle : vehicle.axles) {
        const TimeFunction first = time_function(vehicle.x);
        const auto of_axle = [first, behind = axle.distance](double t) {
          Prescribed at = first(t);
          at.value -= behind;
          return at;
        };
        axles.all.push_back({of_axle, axle.force, axle.mass, axle.sprung_mass, axle.stiffness, axle.damping});
      }
    }
    const auto acting = std::make_shared<const ActingAxles<D>>(std::move(axles));
    model.parts.push_back(acting);
    model.rooms.push_back(std::make_shared<const Vehicles<D>>(acting));
  }
}

template <int D>
std::vector<AxleSample> axle_samples(const Scene& scene, const BeamSystem<D>& system, const Eigen::VectorXd& y,
                                     double t, const OuterForces<D>& forces) {
  std::vector<AxleSample> samples;
  if constexpr (has_room("vehicles")) {
    if (scene.vehicles.empty()) return samples;
    const auto* const acting = part_of<ActingAxles<D>>(system.model());
    const Motion<D> motion = system.motion(y.data(), y.data() + system.coordinates(), nullptr, t);
    const auto& axles = acting->axles();
    std::size_t carried = 0;
    for (std::size_t i = 0; i < axles.all.size(); ++i) {
      AxleSample& sample = samples.emplace_back();
      sample.x = axles.all[i].x(t).value;
      sample.height = axles.all[i].sprung() ? y[acting->height(i)] : acting->road(i, motion.beam, t).first;
      if (!axles.on_beam(i, motion.beam, t)) continue;
      double push = acting->push(i, motion);
      if (axles.all[i].mass > 0) push -= forces.carried[carried++];
      sample.force = push;
    }
  }
  return samples;
}

Point pushed_down(const Scene& scene, double push) {
  return scene.dimension == 2 ? point_of<2>(-push * up_of<2>(scene)) : point_of<3>(-push * up_of<3>(scene));
}

std::vector<Warning> lifting_wheels(const Scene& scene, const RunResult& result) {
  std::vector<Warning> warnings;
  std::size_t which = 0;
  for (const VehicleSpec& vehicle : scene.vehicles) {
    for (std::size_t k = 0; k < vehicle.axles.size(); ++k, ++which) {
      for (const Sample& sample : result.samples) {
        if (!sample.sections || sample.sections->axles.size() <= which) continue;
        const AxleSample& axle = sample.sections->axles[which];
        if (!axle.force || *axle.force >= 0) continue;
        warnings.push_back({WarningKind::lifting_wheel,
                            "the wheel of axle " + std::to_string(k) + " of vehicle \"" + vehicle.name +
                                "\" would lift off at t = " + six_digits(sample.t) +
                                " s, where it pulls at the beam with " + six_digits(-*axle.force) + " N",
                            "wheels stay on the beam here: what comes after that is not how it would go on"});
        break;
      }
    }
  }
  return warnings;
}

template void add_vehicles(const Scene&, const Axis<2>&, BeamModel<2>&);
template void add_vehicles(const Scene&, const Axis<3>&, BeamModel<3>&);
template std::vector<AxleSample> axle_samples(const Scene&, const BeamSystem<2>&, const Eigen::VectorXd&, double,
                                              const OuterForces<2>&);
template std::vector<AxleSample> axle_samples(const Scene&, const BeamSystem<3>&, const Eigen::VectorXd&, double,
                                              const OuterForces<3>&);

}  // namespace vlbeam
