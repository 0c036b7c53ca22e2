#pragma once

#include <algorithm>
#include <cmath>

#include "scene/scene.hpp"
#include "studies/exact_solutions/problem.hpp"
#include "studies/harness/study.hpp"

namespace vlbeam::exact_solutions {

/// A straight beam of ALE-ANCF elements, moved by generalized-alpha.
inline Scene moving_beam(int elements, const Section& section, const Point& end, double step, double rho_inf = 0.9) {
  Scene scene;
  scene.gravity = {};
  scene.beam.curve.end = end;
  scene.beam.section = section;
  scene.beam.strain_law = StrainLaw::green;
  scene.beam.compression = Compression::full;
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.elements = elements;
  scene.integrator = {};
  scene.integrator.type = IntegratorType::generalized_alpha;
  scene.integrator.step = step;
  scene.integrator.rho_inf = rho_inf;
  scene.integrator.newton = NewtonKind::full;
  return scene;
}

inline Section section_of(double EA, double EI, double rhoA) {
  return {.type = Section::Type::stiffness, .EA = EA, .EI = EI, .rhoA = rhoA};
}

/// A load at a material point that travels.
inline LoadSpec travelling(double force, double from, double rate, const Point& direction = {0, -1, 0}) {
  return {.at = LoadPlace::point,
          .x = {.value = from, .rate = rate},
          .magnitude = {.value = force},
          .direction = direction,
          .turn = {}};
}

/// A load of no size, whose place is sampled.
inline LoadSpec probe(double x) { return travelling(1e-200, x, 0); }

/// Of those of a run the sample nearest to t: outputs are chosen so that it is there.
inline const Sample& sample_near(const RunResult& result, double t) {
  return *std::ranges::min_element(result.samples, {}, [t](const Sample& sample) { return std::abs(sample.t - t); });
}

}  // namespace vlbeam::exact_solutions
