// Beads on wires that are nearly rigid: straight, circular, and straight and turning.

#include "core/geometry/elementary.hpp"
#include "studies/exact_solutions/motion.hpp"

namespace vlbeam::exact_solutions {

Problems straight_wires(const FamilyData& data) {
  const std::string reference = "bead on a straight wire";
  const double angle = data.exact.parameter(reference, "inclination") * pi / 180;
  const auto times = data.exact.of(reference).at("parameters").at("t").get<std::vector<double>>();
  Problem problem{.family = "straight wire",
                  .name = "30 degrees",
                  .refined = "stiffness",
                  .levels = data.levels("stiffness"),
                  .known = data.exact.known(reference, {"s"}),
                  .run = {}};
  problem.run = [=, start = data.exact.parameter(reference, "s_0"), step = data.number("step")](double stiffness,
                                                                                                double share) {
    Scene scene = moving_beam(8, section_of(100 * stiffness, stiffness, 1e-3),
                              {portable::cos(angle), -portable::sin(angle), 0}, step / share, 0.5);
    scene.gravity = {0, -9.81, 0};
    scene.start.type = scene.end.type = SupportType::clamp;
    scene.sliding_mass.emplace().mass = 1e-3;
    scene.sliding_mass->position = start;
    scene.duration = times.back();
    scene.output.interval = times.front();
    const RunResult result = StudyContext::simulate_to_the_end(scene);
    Found found;
    for (const double t : times) found.values.push_back(*sample_near(result, t).joint_position);
    return found;
  };
  judge_in_motion(problem, data, 10);
  return {problem};
}

Problems circular_wires(const FamilyData& data) {
  Problems problems;
  for (const std::string& degrees : data.config.at("from_degrees").get<std::vector<std::string>>()) {
    const std::string reference = "bead on a circular wire, from " + degrees + " degrees below the horizontal";
    const double radius = data.exact.parameter(reference, "radius"), mass = data.exact.parameter(reference, "mass"),
                 start = data.exact.parameter(reference, "start");
    const auto times = data.exact.of(reference).at("parameters").at("t").get<std::vector<double>>();
    Problem problem{.family = "circular wire",
                    .name = degrees + " degrees",
                    .refined = "elements",
                    .levels = data.levels(),
                    .known = data.exact.known(reference, {"angle"}),
                    .run = {}};
    problem.run = [=, stiffness = data.number("stiffness"), step = data.number("step")](double elements, double share) {
      Scene scene = moving_beam(static_cast<int>(elements), section_of(stiffness, stiffness, 1), {}, step / share, 0.5);
      scene.gravity = {0, -9.81, 0};
      scene.beam.axial_strain = AxialStrain::full;
      scene.beam.curve = {.type = CurveType::arc, .radius = radius, .from_degrees = 180, .to_degrees = 360};
      scene.start = scene.end = {.type = SupportType::clamp, .clamp = ClampType::full};
      scene.sliding_mass.emplace().mass = mass;
      scene.sliding_mass->position = radius * start;
      scene.length_control.end_merge = 0;
      scene.duration = times.back();
      scene.output.interval = times.front();
      const RunResult result = StudyContext::simulate_to_the_end(scene);
      Found found;
      for (const double t : times) {
        found.values.push_back(*sample_near(result, t).joint_position / radius - start);
      }
      return found;
    };
    problem.scale = pi;  // of the whole wire
    problem.at_least = true;
    judge_in_motion(problem, data, 100);
    problems.push_back(std::move(problem));
  }
  return problems;
}

Problems rotating_wires(const FamilyData& data) {
  Problems problems;
  for (const std::string plane : {"vertical plane", "without gravity"}) {
    const std::string reference = "bead on a wire that turns, " + plane;
    const double w = data.exact.parameter(reference, "w"), start = data.exact.parameter(reference, "r_0"),
                 mass = data.exact.parameter(reference, "mass"), g = data.exact.parameter(reference, "g"),
                 until = data.exact.parameter(reference, "t");
    Problem problem{.family = "rotating wire",
                    .name = plane,
                    .refined = "stiffness",
                    .levels = data.levels("stiffness"),
                    .known = data.exact.known(reference, {"r"}),
                    .run = {}};
    problem.run = [=, step = data.number("step")](double stiffness, double share) {
      Scene scene = moving_beam(8, section_of(stiffness, stiffness, 1e-2), {1.6, 0, 0}, step / share, 0.5);
      scene.gravity = {0, -g, 0};
      scene.start.type = SupportType::clamp;
      scene.start.motion = SupportMotionSpec{.displacement = {}, .angle = TimeSpec{.rate = w}};
      scene.initial_velocity = InitialVelocitySpec{.rotation = w};
      scene.sliding_mass.emplace().mass = mass;
      scene.sliding_mass->position = start;
      scene.duration = until;
      scene.output.interval = until / 4;
      return Found{.values = {*StudyContext::simulate_to_the_end(scene).samples.back().joint_position}};
    };
    judge_in_motion(problem, data, 10);
    problems.push_back(std::move(problem));
  }
  return problems;
}

}  // namespace vlbeam::exact_solutions
