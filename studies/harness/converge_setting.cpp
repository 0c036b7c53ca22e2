#include "studies/harness/converge_setting.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "scene/automatic_integrator.hpp"
#include "scene/derived.hpp"
#include "scene/validate.hpp"
#include "studies/harness/converge.hpp"
#include "studies/harness/json.hpp"

namespace vlbeam {
namespace {

// Accuracies of an automatic integrator that refinement starts from, so that time errs less than the mesh: tolerances
// of 1e-9 for dopri5 and of 1e-7 of the length for generalized-alpha.
constexpr double explicit_start = 2e-8, implicit_start = 1e-5;

int renumbered(int node, int from, int to, const std::string& field) {
  const long scaled = static_cast<long>(node) * to;
  if (scaled % from != 0) {
    throw InvalidInput(field, std::to_string(node), "it must be a node of " + std::to_string(to) + " elements, too");
  }
  return static_cast<int>(scaled / from);
}

}  // namespace

std::string setting_text(const Scene& scene, const Setting& s) {
  return std::to_string(s.elements) + " elements, " + std::to_string(s.points) + " quadrature points, " +
         accuracy_name(scene) + " " + six_digits(s.accuracy);
}

Scene to_converge(const Scene& scene) {
  if (!scene.integrator.automatic || scene.analysis != Analysis::dynamics) return scene;
  Scene start = scene;
  start.integrator = automatic_integrator(scene, explicit_start);
  if (start.integrator.type == IntegratorType::generalized_alpha) {
    start.integrator = automatic_integrator(scene, implicit_start);
  }
  start.integrator.automatic = false;
  return start;
}

Setting setting_of(const Scene& given) {
  const Scene scene = to_converge(given);
  return {scene.beam.elements, quadrature_points(scene),
          has_step(scene) ? scene.integrator.step : scene.integrator.rtol};
}

Scene with_setting(const Scene& given, const Setting& setting) {
  const Scene scene = to_converge(given);
  Scene changed = scene;
  const int from = scene.beam.elements, to = setting.elements;
  changed.beam.elements = to;
  changed.beam.quadrature_points = setting.points;
  changed.beam.polynomial_points = points_of_polynomials(scene) + setting.points - quadrature_points(scene);
  if (changed.flow) {
    for (auto& guide : changed.flow->nodes) guide.node = renumbered(guide.node, from, to, "/flow/nodes");
  }
  if (changed.spin) {
    for (auto& drive : changed.spin->drives) drive.node = renumbered(drive.node, from, to, "/spin/drives");
  }
  for (LoadSpec& load : changed.loads) {
    if (load.at == LoadPlace::node) load.node = renumbered(load.node, from, to, "/loads");
  }
  for (PointMassSpec& mass : changed.point_masses) mass.node = renumbered(mass.node, from, to, "/point_masses");
  if (has_step(scene)) {
    changed.integrator.step = setting.accuracy;
  } else {
    const double share = setting.accuracy / scene.integrator.rtol;
    // where the longest step allowed holds, the tolerance alone would refine nothing
    if (scene.integrator.adaptive) {
      changed.integrator.step = std::min(scene.integrator.step * portable::cbrt(share), scene.duration);
    }
    changed.integrator.atol *= share;
    if (auto& atol = changed.integrator.atol_by_kind) {
      atol->length *= share;
      atol->velocity *= share;
      if (atol->angle) *atol->angle *= share;
      if (atol->spin) *atol->spin *= share;
    }
    changed.integrator.rtol = setting.accuracy;
  }
  validate(changed);
  return changed;
}

}  // namespace vlbeam
