// Cables without bending stiffness: hanging between two points, with a weight or over rings, and their frequencies.
#include <cmath>
#include <memory>

#include "core/geometry/elementary.hpp"
#include "studies/exact_solutions/balance.hpp"
#include "studies/harness/study.hpp"

namespace vlbeam::exact_solutions {
namespace {

/// A cable of a length under its weight of 1 N/m, between (0, 0) and `to`: from the arc of that length it starts.
Scene hung_cable(int elements, double EA, Stretching law, double length, const Point& to, AxialStrain strain) {
  Scene scene = beam_at_rest(elements, EA, 0, to, strain);
  scene.gravity = {0, -1, 0};
  const double chord = portable::hypot(to[0], to[1]);
  double low = 1e-3, high = pi;  // half of the arc's angle: sin(half)/half = chord/length
  for (int i = 0; i < 100; ++i) {
    const double half = (low + high) / 2;
    (portable::sin(half) / half > chord / length ? low : high) = half;
  }
  const double half = low, radius = length / (2 * half), tilt = portable::atan2(to[1], to[0]);
  // the centre is above the chord by R cos(half); the arc runs below it
  const double rise = radius * portable::cos(half);
  scene.beam.curve = {.type = CurveType::arc,
                      .center = {to[0] / 2 - rise * portable::sin(tilt), to[1] / 2 + rise * portable::cos(tilt), 0},
                      .radius = radius,
                      .from_degrees = (tilt - half) / degree - 90,
                      .to_degrees = (tilt + half) / degree - 90};
  scene.beam.rest_shape = RestShape::as_built;
  scene.beam.strain_law = strain_law_of(law);
  scene.start.type = scene.end.type = SupportType::pin;
  scene.statics.steps = 4;
  return scene;
}

struct Cable {
  std::string law;
  Stretching stretching = Stretching::none;
  double EA = 0, length = 0;
  Point to{};
};

Cable cable_of(const FamilyData& data, const std::string& reference) {
  const Json& given = data.exact.of(reference).at("parameters");
  Cable cable{.law = given.at("law")};
  cable.stretching = stretching_of(cable.law);
  cable.EA = cable.stretching == Stretching::none ? data.number("inextensible") : given.at("EA").get<double>();
  cable.length = given.at("length");
  cable.to = {given.at("width"), given.at("height"), 0};
  return cable;
}

AxialStrain sampled_if(bool inextensible) { return inextensible ? AxialStrain::lobatto : AxialStrain::full; }

}  // namespace

Problems catenaries(const FamilyData& data) {
  Problems problems;
  for (const std::string height : {"0", "0.3"}) {
    for (const std::string law : {"inextensible", "engineering", "green"}) {
      const std::string reference = "catenary, " + law + ", ends at heights 0 and " + height;
      const Cable cable = cable_of(data, reference);
      const bool inextensible = cable.stretching == Stretching::none;
      const auto axis = std::make_shared<KnownAxis>(
          Piece{.law = cable.stretching,
                .EA = cable.EA,
                .pull = {data.exact.number(reference, "H"), -data.exact.number(reference, "V_left")},
                .weight = 1,
                .length = cable.length});
      Balance balance{.scene =
                          [=](int n, double EA) {
                            return hung_cable(n, EA, cable.stretching, cable.length, cable.to,
                                              sampled_if(inextensible));
                          },
                      .values =
                          [](const Scene& scene, const RunResult& result) {
                            const auto middle = static_cast<std::size_t>(scene.beam.elements) / 2;
                            const Point& r = result.configurations.back().r[middle];
                            // supports pull outwards and upwards, the end of the beam is pulled by H
                            const auto& forces = result.samples.back().reactions;
                            return std::vector<double>{forces[1].position[0], forces[0].position[1],
                                                       forces[1].position[1], r[0], r[1]};
                          },
                      .axis = [axis](const Scene&, const RunResult&, double x, std::size_t) { return axis->at(x); },
                      .EA = cable.EA,
                      .inextensible = inextensible};
      problems.push_back(on_meshes(data, "catenary", law + ", rise " + height,
                                   data.exact.known(reference, {"H", "V_left", "V_right", "middle"}),
                                   std::move(balance), cable.length));
    }
  }
  return problems;
}

Problems sliding_weights(const FamilyData& data) {
  Problems problems;
  for (const std::string law : {"inextensible", "engineering", "green"}) {
    const std::string reference = "weight that slides on a cable, " + law;
    const Cable cable = cable_of(data, reference);
    const bool inextensible = cable.stretching == Stretching::none;
    const double P = data.exact.parameter(reference, "P"), s = data.exact.number(reference, "s"),
                 H = data.exact.number(reference, "H");
    const auto ring = data.exact.list(reference, "ring");
    const auto before = std::make_shared<KnownAxis>(
        Piece{.law = cable.stretching, .EA = cable.EA, .pull = {H, -P / 2 - s}, .weight = 1, .length = s});
    const auto behind = std::make_shared<KnownAxis>(Piece{.law = cable.stretching,
                                                          .EA = cable.EA,
                                                          .pull = {H, P / 2},
                                                          .weight = 1,
                                                          .length = cable.length - s,
                                                          .start = {ring[0], ring[1]}});
    Balance balance{
        .scene =
            [=](int n, double EA) {
              Scene scene = hung_cable(n, EA, cable.stretching, cable.length, cable.to, sampled_if(inextensible));
              SlidingJointSpec& joint = scene.sliding_joints.emplace_back();
              joint.mass = P;  // gravity is 1
              joint.position = s;
              joint.slopes = JointSlopes::equal_stretch;
              return scene;
            },
        .values =
            [](const Scene&, const RunResult& result) {
              const Sample& sample = result.samples.back();
              return std::vector<double>{sample.reactions[1].position[0], *sample.joint_position,
                                         (*sample.mass_position)[0], (*sample.mass_position)[1]};
            },
        .axis = [=](const Scene&, const RunResult& result, double x,
                    std::size_t element) { return before_joint(result, element) ? before->at(x) : behind->at(x - s); },
        .EA = cable.EA,
        .inextensible = inextensible};
    Problem problem = on_meshes(data, "sliding weight", law, data.exact.known(reference, {"H", "s", "ring"}),
                                std::move(balance), cable.length);
    problem.levels = data.levels(inextensible ? "elements" : "elements_elastic");
    problems.push_back(std::move(problem));
  }
  return problems;
}

Problems three_weights(const FamilyData& data) {
  const std::string reference = "three weights on a string over two rings";
  const double outer = data.exact.parameter(reference, "ends"), middle = data.exact.parameter(reference, "middle"),
               distance = data.exact.parameter(reference, "distance"), leg = 1.5;
  Balance balance{.scene =
                      [=](int n, double EA) {
                        Scene scene = beam_at_rest(n, EA, 0, {distance / 2 + leg, 0, 0}, AxialStrain::lobatto);
                        scene.beam.curve.start = {-distance / 2 - leg, 0, 0};
                        scene.beam.section.rhoA = 1e-6;
                        for (const double x : {leg, leg + distance}) {
                          SlidingJointSpec& ring = scene.sliding_joints.emplace_back();
                          ring.support = SupportType::pin;
                          ring.position = x;
                          ring.slopes = JointSlopes::equal_stretch;
                        }
                        scene.loads = {force_at(0, outer, {0, -1, 0}), force_at(n / 2, middle, {0, -1, 0}),
                                       force_at(n, outer, {0, -1, 0})};
                        return scene;
                      },
                  .values =
                      [](const Scene&, const RunResult& result) {
                        const Point& place = result.samples.back().flow->loads[1];
                        return std::vector<double>{place[0], place[1]};
                      },
                  .EA = data.number("inextensible"),
                  .inextensible = true};
  // straight on every mesh: the node of the weight has two slopes
  return {on_meshes(data, "three weights", "1, 1.2 and 1 N", data.exact.known(reference, {"middle"}),
                    std::move(balance), distance)};
}

Problems hanging_chains(const FamilyData& data) {
  Problems problems;
  for (const std::string mass : {"0", "1"}) {
    const std::string reference = "hanging chain, " + mass + " kg at its end";
    const double rho = data.exact.parameter(reference, "rho"), g = data.exact.parameter(reference, "g");
    Balance balance{.scene =
                        [=](int n, double EA) {
                          Scene scene = beam_at_rest(n, EA, 0, {0, -1, 0}, AxialStrain::full);
                          scene.gravity = {0, -g, 0};
                          scene.beam.section.rhoA = rho;
                          scene.start.type = SupportType::pin;
                          if (mass != "0") scene.point_masses = {{.node = n, .mass = std::stod(mass)}};
                          scene.statics = {.steps = 1, .frequencies = 4, .joints = {}};
                          return scene;
                        },
                    .values =
                        [](const Scene&, const RunResult& result) {
                          std::vector<double> omega;
                          for (const double f : result.frequencies) omega.push_back(2 * pi * f);
                          return omega;
                        },
                    .EA = data.number("inextensible"),
                    .inextensible = true};
    Problem problem = on_meshes(data, "hanging chain", mass + " kg at its end", data.exact.known(reference, {"omega"}),
                                std::move(balance), 1);
    problem.scale = problem.known.values.back();
    problem.order = 0;  // six in the end: the equation is of second order
    problems.push_back(std::move(problem));
  }
  return problems;
}

}  // namespace vlbeam::exact_solutions
