// Ropes that are drawn over guides with friction, and weights that swing on them.

#include "core/geometry/elementary.hpp"
#include "scene/shape.hpp"
#include "studies/exact_solutions/motion.hpp"

namespace vlbeam::exact_solutions {
namespace {

constexpr const char* in_mass = "1/mass of rope";

/// A motion of a ring or a support from where it is at first.
TimeSpec to_place(double distance, double ramp) { return {.value = distance, .ramp = ramp}; }

}  // namespace

/// A rope that starts straight; its guides are moved to their places, then its end is drawn on.
Problems capstans(const FamilyData& data) {
  const std::string reference = "capstan, three guides";
  const Json& given = data.exact.of(reference).at("parameters");
  const auto points = given.at("points").get<std::vector<std::array<double, 2>>>();
  const auto friction = given.at("friction").get<std::vector<double>>();
  const double pull = given.at("T_0");
  Problem problem{.family = "capstan",
                  .name = "three guides",
                  .refined = in_mass,
                  .levels = data.levels("lightness"),
                  .known = data.exact.known(reference, {"tensions"}),
                  .run = {}};
  problem.known.names.erase(problem.known.names.begin());  // the first is the load
  problem.known.values.erase(problem.known.values.begin());
  problem.known.errors.erase(problem.known.errors.begin());
  problem.run = [=, step = data.number("step")](double lightness, double share) {
    constexpr int elements = 14;
    constexpr double lead = 2.5, behind = 1.5, ramp = 0.5;  // [m], [m], [s]
    const double start = points[1][0] - lead, end = points[1][0] + 2 + behind;
    Scene scene = moving_beam(elements, section_of(1e4, 0, 1 / lightness), {end, points[0][1], 0}, step / share, 0);
    scene.beam.curve.start = {start, points[0][1], 0};
    scene.constraints = Constraints::multipliers;
    LoadSpec load{.node = 0, .x = {}, .magnitude = {.value = pull, .ramp = 0.1}, .direction = {-1, 0, 0}, .turn = {}};
    scene.loads = {load};
    for (std::size_t k = 0; k < friction.size(); ++k) {
      SlidingJointSpec& ring = scene.sliding_joints.emplace_back();
      const double x = points[1][0] + static_cast<double>(k);
      ring.support = SupportType::pin;
      ring.position = x - start;
      ring.slopes = JointSlopes::free;
      ring.friction = AxialFriction{friction[k], 1e-3};
      const double dx = points[k + 1][0] - x, dy = points[k + 1][1] - points[0][1], way = portable::hypot(dx, dy);
      if (way > 0) ring.motion = SupportMotionSpec{.direction = {dx, dy, 0}, .displacement = to_place(way, ramp)};
    }
    // the end is drawn on a line that passes its place after a second, on the move
    scene.end.type = SupportType::pin;
    const double dx = points[4][0] - end, dy = points[4][1] - points[0][1];
    scene.end.motion =
        SupportMotionSpec{.direction = {dx, dy, 0}, .displacement = {.rate = portable::hypot(dx, dy), .ramp = ramp}};
    scene.duration = 1;
    scene.output.interval = 0.05;
    scene.output.configurations = {scene.duration};
    const RunResult result = StudyContext::simulate_to_the_end(scene);
    Found found;
    const Sample& last = result.samples.back();
    for (std::size_t k = 0; k < friction.size(); ++k) {
      // behind a guide the tension of the leg's first element
      const double x = *last.joints[k].position;
      double tension = 0;
      for (const ShapePoint& point : points_along(scene, result.configurations.back(), 2)) {
        if (point.x > x + 1e-9) {
          tension = point.tension;
          break;
        }
      }
      found.values.push_back(tension);
    }
    return found;
  };
  problem.steps = true;
  problem.order = 1;
  problem.scale = problem.known.values.back();
  problem.floor = data.number("floor");
  problem.cost = 20;
  return {problem};
}

Problems elastic_pendulums(const FamilyData& data) {
  Problems problems;
  for (const std::string law : {"green", "engineering"}) {
    const std::string reference = "elastic pendulum, " + law;
    const Json& given = data.exact.of(reference).at("parameters");
    const auto start = given.at("start").get<std::array<double, 2>>();
    const auto times = given.at("t").get<std::vector<double>>();
    Problem problem{.family = "elastic pendulum",
                    .name = law,
                    .refined = "steps",
                    .levels = data.levels("steps"),
                    .known = data.exact.known(reference, {"places"}),
                    .run = {}};
    problem.run = [=, EA = given.at("EA").get<double>(), mass = given.at("mass").get<double>(),
                   g = given.at("g").get<double>(), rhoA = data.number("rope")](double steps, double /*share*/) {
      Scene scene = moving_beam(2, section_of(EA, 0, rhoA), {start[0], start[1], 0}, times.back() / steps);
      scene.beam.strain_law = law == "green" ? StrainLaw::green : StrainLaw::engineering;
      scene.gravity = {0, -g, 0};
      scene.start.type = SupportType::pin;
      scene.point_masses = {{.node = 2, .mass = mass}};
      scene.duration = times.back();
      scene.output.interval = times.front();
      const RunResult result = StudyContext::simulate_to_the_end(scene);
      Found found;
      for (const double t : times) {
        const Point& end = sample_near(result, t).end;
        found.values.insert(found.values.end(), {end[0], end[1]});
      }
      return found;
    };
    problem.order = data.number("order");
    problem.floor = data.number("floor");
    problem.cost = 5;
    problems.push_back(std::move(problem));
  }
  return problems;
}

Problems hoisted_pendulums(const FamilyData& data) {
  const std::string reference = "hoisted pendulum, inextensible";
  const Json& given = data.exact.of(reference).at("parameters");
  const auto start = given.at("start").get<std::array<double, 2>>();
  const auto times = given.at("t").get<std::vector<double>>();
  Problem problem{.family = "hoisted pendulum",
                  .name = "inextensible",
                  .refined = "steps",
                  .levels = data.levels("steps"),
                  .known = data.exact.known(reference, {"places"}),
                  .run = {}};
  problem.run = [=, EA = data.number("inextensible"), mass = given.at("mass").get<double>(),
                 g = given.at("g").get<double>(), speed = given.at("speed").get<double>(),
                 ramp = given.at("ramp").get<double>(), rhoA = data.number("rope")](double steps, double /*share*/) {
    Found found;
    for (const int doubled : {0, 1}) {
      constexpr int elements = 4;
      // all damping that the method has for what rings along the rope, which hangs from it at once
      Scene scene = moving_beam(elements, section_of(EA * (1 + doubled), 0, rhoA), {start[0], start[1], 0},
                                times.back() / steps, 0);
      scene.gravity = {0, -g, 0};
      scene.start.type = SupportType::pin;
      scene.start.feed = TimeSpec{.rate = -speed, .ramp = ramp};
      scene.point_masses = {{.node = elements, .mass = mass}};
      scene.duration = times.back();
      scene.output.interval = times.front();
      const RunResult result = StudyContext::simulate_to_the_end(scene);
      std::vector<double> places;
      for (const double t : times) {
        const Point& end = sample_near(result, t).end;
        places.insert(places.end(), {end[0], end[1]});
      }
      for (std::size_t i = 0; i < places.size() && doubled == 1; ++i)
        found.values[i] = beyond(found.values[i], places[i]);
      if (doubled == 0) found.values = places;
    }
    return found;
  };
  problem.order = data.number("order");
  problem.floor = data.number("floor");
  problem.cost = 50;
  return {problem};
}

}  // namespace vlbeam::exact_solutions
