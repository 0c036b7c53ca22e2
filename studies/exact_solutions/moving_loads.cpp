// A force and a mass that run over a simply supported beam, and loads that turn about it, too.

#include "core/geometry/elementary.hpp"
#include "studies/exact_solutions/motion.hpp"
#include "studies/rotating_load/closed_form.hpp"

namespace vlbeam::exact_solutions {
namespace {

// The deflection by which all are divided [m], of a beam of 1 m with EI = rhoA = 1: small, for the references are
// linear.
constexpr double unit = 1e-6;

/// A beam of 1 m with EI = rhoA = 1 on a pin and a slide.
Scene bridge(double elements, double step) {
  Scene scene = moving_beam(static_cast<int>(elements), section_of(1e4, 1, 1), {1, 0, 0}, step);
  scene.beam.axial_strain = AxialStrain::full;
  scene.start.type = SupportType::pin;
  scene.end.type = SupportType::slide;
  return scene;
}

/// Steps on the whole way: the first mode turns by pi/alpha on it, and the error of its phase grows with the third
/// power.
double steps_at(double alpha, double at_one) {
  constexpr double samples = 8000;  // at equal places, so that they fall on steps
  return samples * std::ceil(at_one * std::max(1.0, portable::pow(alpha, -1.5)) / samples);
}

/// The members of two lists in turn.
void add_names(Known& known, const char* name, std::size_t members) {
  for (std::size_t i = 0; i < members; ++i) known.names.push_back(name + (" " + std::to_string(i + 1)));
}

}  // namespace

Problems moving_forces(const FamilyData& data) {
  Problems problems;
  for (const std::string& alpha : data.config.at("alpha").get<std::vector<std::string>>()) {
    const std::string reference = "force that moves over a beam, alpha = " + alpha;
    const double speed = pi * data.exact.parameter(reference, "alpha");
    const auto places = data.exact.of(reference).at("parameters").at("places").get<std::vector<double>>();
    Problem problem{.family = "moving force",
                    .name = "alpha = " + alpha,
                    .refined = "elements",
                    .levels = data.levels(),
                    .known = data.exact.known(reference, {"middle", "at_0.3"}),
                    .run = {}};
    problem.run = [=, steps = steps_at(speed / pi, data.number("steps"))](double elements, double share) {
      Scene scene = bridge(elements, 1 / speed / (share * steps));
      scene.loads = {travelling(48 * unit, 0, speed), probe(0.5), probe(0.3)};
      scene.duration = 1 / speed;
      scene.output.interval = 0.05 / speed;
      const RunResult result = StudyContext::simulate_to_the_end(scene);
      Found found;
      for (const std::size_t at : {1, 2}) {
        for (const double place : places) {
          found.values.push_back(-sample_near(result, place / speed).flow->loads[at][1] / unit);
        }
      }
      return found;
    };
    problem.at_least = true;
    judge_in_motion(problem, data, 100);
    problems.push_back(std::move(problem));
  }
  return problems;
}

Problems moving_masses(const FamilyData& data) {
  Problems problems;
  for (const Json& given : data.config.at("cases")) {
    const std::string ratio = given[0], alpha = given[1],
                      reference = "mass that moves over a beam, m/(rhoA L) = " + ratio + ", alpha = " + alpha;
    const double mass = data.exact.parameter(reference, "mass_ratio"),
                 speed = pi * data.exact.parameter(reference, "alpha");
    const auto places = data.exact.of(reference).at("parameters").at("places").get<std::vector<double>>();
    Problem problem{.family = "moving mass",
                    .name = "m/(rhoA L) = " + ratio + ", alpha = " + alpha,
                    .refined = "elements",
                    .levels = data.levels(),
                    .known = data.exact.known(reference, {"middle", "under_mass"}),
                    .run = {}};
    problem.run = [=, steps = steps_at(speed / pi, data.number("steps")), from = data.number("from")](double elements,
                                                                                                      double share) {
      Scene scene = bridge(elements, 1 / speed / (share * steps));
      SlidingJointSpec& joint = scene.sliding_joints.emplace_back();
      joint.mass = mass;
      joint.position = from;
      joint.x = TimeSpec{.rate = speed};
      scene.loads = {travelling(48 * unit, from, speed), probe(0.5)};
      // all places are whole multiples of `from`
      scene.duration = (places.back() - from) / speed;
      scene.output.interval = from / speed;
      const RunResult result = StudyContext::simulate_to_the_end(scene);
      Found found;
      for (const std::size_t at : {1, 0}) {
        for (const double place : places) {
          found.values.push_back(-sample_near(result, (place - from) / speed).flow->loads[at][1] / unit);
        }
      }
      return found;
    };
    problem.at_least = true;
    judge_in_motion(problem, data, 100);
    problems.push_back(std::move(problem));
  }
  return problems;
}

Problems rotating_loads(const FamilyData& data) {
  Problems problems;
  constexpr std::array places{0.25, 0.5, 0.75};
  for (const Json& given : data.config.at("cases")) {
    RotatingLoad set{given.at("a"), given.at("k_omega"), given.value("radius", 0.0)};
    const double radius = set.slenderness > 0 ? set.slenderness : 0.01, spin = given.value("spin", 0.0);
    const double EJ = 1, rhoA = 1, rhoIp = rhoA * radius * radius / 2;
    const double speed = set.a * pi * std::sqrt(EJ / rhoA), turning = 2 * pi * set.k_omega * speed;
    set.spin = spin;  // turned while the load is on its way
    Problem problem{.family = "rotating load",
                    .name = given.at("name"),
                    .refined = "elements",
                    .levels = data.levels(),
                    .known = {},
                    .run = {}};
    for (const double place : places) {
      for (const auto u : {closed_form(set, place, place), closed_form(set, place, 0.5)}) {
        problem.known.values.insert(problem.known.values.end(), {u.real(), u.imag()});
      }
    }
    add_names(problem.known, "deflection", problem.known.values.size());
    problem.known.errors.assign(problem.known.values.size(), 1e-8);  // of 400 modes
    problem.run = [=, steps = steps_at(set.a, data.number("steps"))](double elements, double share) {
      Section section = section_of(1e4, EJ, rhoA);
      section.GIp = 1;
      section.rhoIp = rhoIp;
      Scene scene = moving_beam(static_cast<int>(elements), section, {0, 0, 1}, 1 / speed / (share * steps));
      scene.dimension = 3;
      scene.beam.curve.start = {};
      scene.beam.axial_strain = AxialStrain::full;
      scene.start.type = SupportType::pin;
      scene.end.type = SupportType::slide;
      scene.spin.emplace().drives = {{0, {.rate = spin * speed}}};
      scene.spin->rate = spin * speed;
      if (set.slenderness > 0) scene.beam.rotary_inertia = BendingInertia::gyroscopic;
      scene.loads = {travelling(48 * unit, 0, speed, {1, 0, 0}), probe(0.5)};
      scene.loads[0].turn = {.rate = turning};
      scene.duration = 0.75 / speed;
      scene.output.interval = 0.05 / speed;
      const RunResult result = StudyContext::simulate_to_the_end(scene);
      Found found;
      for (const double place : places) {
        for (const std::size_t at : {0, 1}) {
          const Point& r = sample_near(result, place / speed).flow->loads[at];
          found.values.insert(found.values.end(), {r[0] / unit, r[1] / unit});
        }
      }
      return found;
    };
    problem.at_least = true;
    judge_in_motion(problem, data, 300);
    problems.push_back(std::move(problem));
  }
  return problems;
}

}  // namespace vlbeam::exact_solutions
