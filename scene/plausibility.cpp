#include "scene/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <sstream>

#include "scene/build.hpp"
#include "scene/corners.hpp"
#include "scene/derived.hpp"
#include "scene/section_data.hpp"
#include "scene/sections.hpp"
#include "scene/slack.hpp"
#include "scene/vehicles.hpp"

namespace vlbeam {
namespace {

constexpr double large_strains = 0.1, large_strains_of_ropes = 0.3;  // nylon breaks there
constexpr double lightest = 10;                                      // [kg/m^3], of foams
constexpr double force_noise = 1e-3;                                 // of the largest axial force
constexpr std::size_t least_samples = 8;
constexpr double enlarged = 1.1;  // of friction by the swing of what it goes by

template <class... Parts>
std::string text_of(const Parts&... parts) {
  std::ostringstream text;
  text.precision(3);
  (text << ... << parts);
  return text.str();
}

/// In statics samples are equilibria, whose time is their number.
std::string when(const Scene& scene, double t) {
  return scene.analysis == Analysis::statics ? text_of("equilibrium ", t) : text_of("t = ", t, " s");
}

void check_strain(const Scene& scene, const RunResult& result, std::vector<Warning>& warnings) {
  const bool slackens = compression(scene) == Compression::none;  // shorter, it is folded rather than strained
  const auto largest = [slackens](const Sample& sample) {
    const auto& [least, most] = sample.strains.axial_strain;
    return std::max(slackens ? 0 : std::abs(least), std::abs(most));
  };
  const auto at = std::ranges::max_element(result.samples, {}, largest);
  const double large = is_rope(scene.beam) ? large_strains_of_ropes : large_strains;
  if (!(largest(*at) > large)) return;
  const auto strained = std::ranges::count_if(result.samples, [&](const Sample& s) { return largest(s) > large; });
  const std::string message = text_of("the beam is strained by ", 100 * largest(*at), " % at ", when(scene, at->t));
  // a wrong unit strains the beam as long as anything pulls at it
  if (2 * strained < std::ssize(result.samples)) {
    warnings.push_back({WarningKind::large_strain, message + ", for a while: by what strikes or jerks it there",
                        "/beam/material/damping takes waves out; the strain laws know no limit of the material"});
    return;
  }
  const Section::Type type = main_section(scene.beam).type;
  warnings.push_back({WarningKind::large_strain, message,
                      type == Section::Type::circle
                          ? "is /beam/material/youngs_modulus in Pa, and /beam/section/radius in m?"
                      : type == Section::Type::stiffness ? "is /beam/section/EA in N?"
                      : has_sizes(type) ? "is /beam/material/youngs_modulus in Pa, and /beam/section in m?"
                                        : "is /beam/section/diameter in m?"});
}

void check_material(const Scene& scene, std::vector<Warning>& warnings) {
  if (scene.assumed.empty()) return;
  warnings.push_back({WarningKind::assumed_material,
                      text_of("the scene leaves out ", scene.assumed, ": that of a soft beam is taken (a radius of ",
                              BeamSpec{}.section.radius, " m, ", BeamSpec{}.material.density, " kg/m^3, ",
                              BeamSpec{}.material.youngs_modulus, " Pa)"),
                      "give all of them"});
}

void check_section(const Scene& scene, std::vector<Warning>& warnings) {
  if (main_section(scene.beam).type != Section::Type::circle) return;
  const double radius = main_section(scene.beam).radius, length = standard_length(scene);
  if (radius > length) {
    warnings.push_back(
        {WarningKind::thick_elements,
         text_of("the section's radius, ", radius, " m, is larger than the elements' length, ", length, " m"),
         "is /beam/section/radius in m? else fewer elements"});
  }
  const double density = named(scene.beam.material).density;
  if (density < lightest) {
    warnings.push_back(
        {WarningKind::light_material,
         text_of("a density of ", density, " kg/m^3 is less than that of foam; light beams take many steps"),
         "is /beam/material/density in kg/m^3?"});
  }
}

/// Compressed by more than Euler's load of one element between hinges, a beam folds between its nodes. A rope that goes
/// slack is not compressed, but for what damps it.
void check_compression(const Scene& scene, const RunResult& result, std::vector<Warning>& warnings) {
  if (compression(scene) == Compression::none) return;
  double least = 0, largest = 0, at = 0;
  for (const Sample& sample : result.samples) {
    const auto& [low, high] = sample.strains.axial_force;
    if (low < least) at = sample.t;
    least = std::min(least, low);
    largest = std::max({largest, std::abs(low), std::abs(high)});
  }
  const double length = standard_length(scene);
  const double bears = std::numbers::pi * std::numbers::pi * build_section(scene.beam).stiffness.EI / (length * length);
  if (!(-least > bears + force_noise * largest)) return;
  warnings.push_back(
      {WarningKind::buckled_elements,
       text_of("the beam is compressed by up to ", -least, " N, at ", when(scene, at), ", and an element of it bears ",
               bears, " N before it buckles: it is slack, and folds more finely than its elements"),
       bears > 0 ? "more elements, or material damping"
                 : "a rope bears no compression: keep it taut, or give it /beam/section/EI"});
}

/// Friction goes by the size of the force across the beam: where that swings it is larger than by its mean.
void check_friction(const Scene& scene, const RunResult& result, std::vector<Warning>& warnings) {
  const auto joints = sliding_joints(scene);
  const auto warn = [&](const std::string& message) {
    warnings.push_back(
        {WarningKind::ringing_friction,
         message + ": a vibration of the beam " + (scene.beam.material.damping > 0 ? "" : "that nothing damps ") +
             "decides how far it slides",
         scene.beam.material.damping > 0 ? "more /beam/material/damping, or more elements" : "/beam/material/damping"});
  };
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (!joints[i].friction) continue;
    const FrictionPressure seen = i < result.pressures.size() ? result.pressures[i] : FrictionPressure{};
    if (seen.way > 0) {
      if (!(seen.size > enlarged * seen.mean)) continue;
      warn(text_of("the force across the beam at ", joint_key(scene, i),
                   ", by which friction goes, swings: its size is ", seen.size, " N on average, and it pushes with ",
                   seen.mean, " N"));
      continue;
    }
    if (result.samples.size() < least_samples) continue;
    const auto normal = [&](const Sample& sample) -> const JointSample* {
      const auto& joint = sample.joints.empty() ? sample.joint : sample.joints[i].on_beam;
      return joint ? &*joint : nullptr;
    };
    double sum = 0, swing = 0;
    int count = 0;
    const JointSample* before = nullptr;
    for (const Sample& sample : result.samples) {
      const JointSample* const now = normal(sample);
      if (now == nullptr) break;
      sum += now->normal;
      if (before != nullptr) swing += std::abs(now->normal - before->normal);
      before = now;
      ++count;
    }
    if (count < static_cast<int>(least_samples) || !(swing > sum)) continue;
    warn(text_of("the force across the beam at ", joint_key(scene, i),
                 ", by which friction goes, swings from sample to sample by ", swing / (count - 1),
                 " N about a mean of ", sum / count, " N"));
  }
}

/// A corner that is rounded off next to a joint was most likely meant for it.
void check_corners(const Scene& scene, std::vector<Warning>& warnings) {
  if (!may_have_corners(scene.beam.curve)) return;
  const auto drawn = drawn_axis<3>(scene.beam.curve);
  const auto joints = sliding_joints(scene);
  const auto& breaks = drawn.breaks();
  for (const double at : rounded_corners(scene, drawn)) {
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const double beside = std::abs(joints[i].position - at);
      if (!(beside < standard_length(scene))) continue;
      const auto& among = scene.beam.curve.type == CurveType::polyline ? breaks : drawn.kinks();
      const auto which =
          std::ranges::lower_bound(among, at) - among.begin() + (scene.beam.curve.type == CurveType::polyline ? 0 : 1);
      warnings.push_back(
          {WarningKind::rounded_corner,
           text_of("the rope's corner at ", at, " m is rounded off, for ", joint_key(scene, i), " is ", beside,
                   " m beside it: the rope is shorter than it is drawn"),
           text_of("\"position\": {\"corner\": ", which, "}, and slopes that are free or equal-stretch")});
    }
  }
}

/// A ring that something has to hold until the motion starts: what starts is no equilibrium of it.
void check_held_rings(const Scene& scene, const RunResult& result, std::vector<Warning>& warnings) {
  if (!starts_in_equilibrium(scene) || !is_rope(scene.beam)) return;
  const auto& seen = result.samples.front().equilibrium;
  const auto joints = sliding_joints(scene);
  const bool ring = std::ranges::any_of(joints, [](const SlidingJointSpec& joint) {
    return joint.support == SupportType::pin && !joint.x && !joint.friction;
  });
  double largest = 0;
  for (const double force : result.samples.front().strains.axial_force) largest = std::max(largest, std::abs(force));
  if (!ring || !seen || !(std::abs(seen->holding_force) > force_noise * largest)) return;
  warnings.push_back(
      {WarningKind::held_ring,
       text_of("the equilibrium that the motion starts from is none of the rings: until t = 0 ",
               std::abs(seen->holding_force), " N hold the rope in one, and then it is let go"),
       "another position of the ring on the rope, or \"statics\": {\"joints\": \"held\"} if it is meant so"});
}

/// Of the last equilibrium, or of that from which a motion starts.
void check_stability(const Scene& scene, const RunResult& result, std::vector<Warning>& warnings) {
  const Sample& seen = scene.analysis == Analysis::statics ? result.samples.back() : result.samples.front();
  if (!seen.equilibrium || seen.equilibrium->negative_pivots > 0 || seen.equilibrium->hidden_pivots == 0) return;
  warnings.push_back({WarningKind::hidden_stability,
                      text_of("rounding hides whether the equilibrium is stable: in ", seen.equilibrium->hidden_pivots,
                              " directions the energy hardly changes, against what the axis resists"),
                      "a smaller EA, fewer elements, or a support that holds the beam"});
}

/// Friction of the ground is against a velocity, which an equilibrium has not.
void check_ground(const Scene& scene, std::vector<Warning>& warnings) {
  if (scene.analysis != Analysis::statics || !scene.ground || !scene.ground->friction) return;
  warnings.push_back(
      {WarningKind::no_ground_friction,
       "in an equilibrium nothing slides: the friction of the ground does nothing, and the beam pulls at "
       "its support as on a smooth one",
       "leave /ground/friction out, or lower the beam in a motion"});
}

}  // namespace

std::vector<Warning> implausible(const Scene& scene, const RunResult& result) {
  std::vector<Warning> warnings;
  check_material(scene, warnings);
  check_section(scene, warnings);
  check_corners(scene, warnings);
  check_ground(scene, warnings);
  if (result.samples.empty()) return warnings;
  check_strain(scene, result, warnings);
  check_compression(scene, result, warnings);
  check_friction(scene, result, warnings);
  check_stability(scene, result, warnings);
  std::ranges::copy(lifting_wheels(scene, result), std::back_inserter(warnings));
  if (!scene.statics.joints) check_held_rings(scene, result, warnings);
  return warnings;
}

}  // namespace vlbeam
