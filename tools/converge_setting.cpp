#include "tools/converge_setting.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "io/json.hpp"
#include "scene/automatic_integrator.hpp"
#include "scene/derived.hpp"
#include "scene/on_elements.hpp"
#include "scene/validate.hpp"
#include "tools/converge.hpp"

namespace vlbeam {
namespace {

constexpr double least_rtol = 1e-14;  // as /integrator/rtol allows: rounding

// Accuracies of an automatic integrator that refinement starts from, so that time errs less than the mesh: tolerances
// of 1e-9 for dopri5 and of 1e-7 of the length for generalized-alpha.
constexpr double explicit_start = 2e-8, implicit_start = 1e-5;

}  // namespace

std::string setting_text(const Scene& scene, const Setting& s) {
  const std::string text = std::to_string(s.elements) + " elements, " + std::to_string(s.points) + " quadrature points";
  return scene.analysis == Analysis::statics ? text : text + ", " + accuracy_name(scene) + " " + six_digits(s.accuracy);
}

Scene to_converge(const Scene& scene) {
  if (!scene.integrator.automatic || scene.analysis != Analysis::dynamics) return scene;
  Scene start = scene;
  // the coarser start decides: as fine as dopri5 starts, no implicit method could compete
  start.integrator = automatic_integrator(scene, implicit_start);
  if (start.integrator.type != IntegratorType::generalized_alpha) {
    start.integrator = automatic_integrator(scene, explicit_start);
  }
  start.integrator.automatic = false;
  return start;
}

Setting setting_of(const Scene& given) {
  const Scene scene = to_converge(given);
  return {scene.beam.elements, quadrature_points(scene),
          has_step(scene) ? scene.integrator.step : scene.integrator.rtol};
}

Scene on_mesh(const Scene& scene, int elements, int points) {
  Scene changed = on_elements(scene, elements);
  changed.beam.quadrature_points = points;
  changed.beam.polynomial_points = points_of_polynomials(scene) + points - quadrature_points(scene);
  return changed;
}

Scene with_tolerance(const Scene& scene, double share) {
  Scene changed = scene;
  IntegratorSpec& integrator = changed.integrator;
  // where the longest step allowed holds, the tolerance alone would refine nothing
  if (integrator.adaptive) integrator.step = std::min(integrator.step * portable::cbrt(share), scene.duration);
  if (integrator.automatic) {  // by it steps follow turns and ramps
    integrator.accuracy =
        std::clamp(integrator.accuracy * portable::pow(share, 2.0 / 3), finest_accuracy, coarsest_accuracy);
  }
  integrator.rtol = std::max(integrator.rtol * share, least_rtol);
  integrator.atol *= share;
  if (auto& atol = integrator.atol_by_kind) {
    atol->length *= share;
    atol->velocity *= share;
    if (atol->angle) *atol->angle *= share;
    if (atol->spin) *atol->spin *= share;
  }
  return changed;
}

Scene with_setting(const Scene& given, const Setting& setting) {
  const Scene scene = to_converge(given);
  Scene changed = on_mesh(scene, setting.elements, setting.points);
  if (scene.analysis == Analysis::statics) {
    // no steps
  } else if (has_step(scene)) {
    changed.integrator.step = setting.accuracy;
  } else {
    changed = with_tolerance(changed, setting.accuracy / scene.integrator.rtol);
    changed.integrator.rtol = setting.accuracy;  // without rounding
  }
  validate(changed);
  return changed;
}

}  // namespace vlbeam
