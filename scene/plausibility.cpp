#include "scene/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "scene/build.hpp"
#include "scene/derived.hpp"

namespace vlbeam {
namespace {

constexpr double large_strains = 0.1;
constexpr double lightest = 10;       // [kg/m^3], of foams
constexpr double force_noise = 1e-3;  // of the largest axial force
constexpr std::size_t least_samples = 8;

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
  const auto largest = [](const Sample& sample) {
    const auto& [least, most] = sample.strains.axial_strain;
    return std::max(std::abs(least), std::abs(most));
  };
  const auto at = std::ranges::max_element(result.samples, {}, largest);
  if (!(largest(*at) > large_strains)) return;
  const Section::Type type = scene.beam.section.type;
  warnings.push_back(
      {WarningKind::large_strain, text_of("the beam is strained by ", 100 * largest(*at), " % at ", when(scene, at->t)),
       type == Section::Type::circle      ? "is /beam/material/youngs_modulus in Pa, and /beam/section/radius in m?"
       : type == Section::Type::rectangle ? "is /beam/material/youngs_modulus in Pa, and /beam/section in m?"
                                          : "is /beam/section/EA in N?"});
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
  if (scene.beam.section.type != Section::Type::circle) return;
  const double radius = scene.beam.section.radius, length = standard_length(scene);
  if (radius > length) {
    warnings.push_back(
        {WarningKind::thick_elements,
         text_of("the section's radius, ", radius, " m, is larger than the elements' length, ", length, " m"),
         "is /beam/section/radius in m? else fewer elements"});
  }
  const double density = scene.beam.material.density;
  if (density < lightest) {
    warnings.push_back(
        {WarningKind::light_material,
         text_of("a density of ", density, " kg/m^3 is less than that of foam; light beams take many steps"),
         "is /beam/material/density in kg/m^3?"});
  }
}

/// Compressed by more than Euler's load of one element between hinges, a beam folds between its nodes.
void check_compression(const Scene& scene, const RunResult& result, std::vector<Warning>& warnings) {
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

void check_friction(const Scene& scene, const RunResult& result, std::vector<Warning>& warnings) {
  if (scene.beam.material.damping > 0 || result.samples.size() < least_samples) return;
  const auto joints = sliding_joints(scene);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (!joints[i].friction) continue;
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
    warnings.push_back({WarningKind::ringing_friction,
                        text_of("the force across the beam at ", joint_key(scene, i),
                                ", by which friction goes, swings from sample to sample by ", swing / (count - 1),
                                " N about a mean of ", sum / count,
                                " N: a vibration of the beam that nothing damps decides how far it slides"),
                        "/beam/material/damping"});
  }
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

}  // namespace

std::vector<Warning> implausible(const Scene& scene, const RunResult& result) {
  std::vector<Warning> warnings;
  check_material(scene, warnings);
  check_section(scene, warnings);
  if (result.samples.empty()) return warnings;
  check_strain(scene, result, warnings);
  check_compression(scene, result, warnings);
  check_friction(scene, result, warnings);
  check_stability(scene, result, warnings);
  return warnings;
}

}  // namespace vlbeam
