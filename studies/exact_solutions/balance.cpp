#include "studies/exact_solutions/balance.hpp"

#include <cmath>

#include "studies/harness/study.hpp"

namespace vlbeam::exact_solutions {

Found in_balance(const Balance& balance, int elements) {
  Found found;
  Differences off;
  for (const int doubled : {0, 1}) {
    if (doubled == 1 && !balance.inextensible) break;
    const Scene scene = balance.scene(elements, balance.EA * (1 + doubled));
    const RunResult result = StudyContext::simulate_to_the_end(scene);
    const std::vector<double> values = balance.values(scene, result);
    Differences differ;
    if (balance.axis) {
      differ = differences(scene, result.configurations.back(),
                           [&](double x, std::size_t element) { return balance.axis(scene, result, x, element); });
    }
    if (doubled == 0) {
      found.values = values;
      off = differ;
      continue;
    }
    for (std::size_t i = 0; i < values.size(); ++i) found.values[i] = beyond(found.values[i], values[i]);
    off = beyond(off, differ);
  }
  if (balance.axis) {
    found.displacement = off.displacement();
    found.slope = off.slope();
  }
  return found;
}

Problem on_meshes(const FamilyData& data, const std::string& family, const std::string& name, Known known,
                  Balance balance, double length) {
  Problem problem{
      .family = family, .name = name, .refined = "elements", .levels = data.levels(), .known = {}, .run = {}};
  problem.known = std::move(known);
  problem.run = [balance = std::move(balance), length](double level, double /*share*/) {
    Found found = in_balance(balance, count(level));
    found.displacement /= length * std::sqrt(length);
    found.slope /= std::sqrt(length);
    return found;
  };
  problem.scale = length;
  problem.order = 4;
  problem.floor = data.number("floor");
  return problem;
}

Scene beam_at_rest(int elements, double EA, double EI, const Point& end, AxialStrain strain) {
  Scene scene;
  scene.analysis = Analysis::statics;
  scene.gravity = {};
  scene.beam.curve.end = end;
  scene.beam.section = {.type = Section::Type::stiffness, .EA = EA, .EI = EI, .rhoA = 1};
  scene.beam.strain_law = StrainLaw::green;
  scene.beam.compression = Compression::full;
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.elements = elements;
  scene.beam.axial_strain = strain;
  return scene;
}

LoadSpec force_at(int node, double force, const Point& direction) {
  return {.node = node, .x = {}, .magnitude = {.value = force}, .direction = direction, .turn = {}};
}

Stretching stretching_of(const std::string& law) {
  return law == "green" ? Stretching::green : law == "engineering" ? Stretching::engineering : Stretching::none;
}

StrainLaw strain_law_of(Stretching law) {
  return law == Stretching::engineering ? StrainLaw::engineering : StrainLaw::green;
}

bool before_joint(const RunResult& result, std::size_t element) {
  const Configuration& shape = result.configurations.back();
  return shape.x[element + 1] <= *result.samples.back().joint_position + 1e-12;
}

}  // namespace vlbeam::exact_solutions
