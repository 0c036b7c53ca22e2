// Beams bent far: by an end moment, by a dead force, by weights on a rod that slides in a sleeve.
#include <cmath>
#include <memory>

#include "core/geometry/elementary.hpp"
#include "studies/exact_solutions/balance.hpp"

namespace vlbeam::exact_solutions {
namespace {

using Vector = std::array<double, 2>;

std::vector<double> end_of(const Scene& /*scene*/, const RunResult& result) {
  const Point& end = result.samples.back().end;
  return {end[0], end[1]};
}

Scene cantilever(int elements, double EA, double EI, Stretching law, AxialStrain strain) {
  Scene scene = beam_at_rest(elements, EA, EI, {1, 0, 0}, strain);
  scene.beam.strain_law = strain_law_of(law);
  scene.start.type = SupportType::clamp;
  return scene;
}

/// The axis of a beam of one piece.
auto all_of(const Piece& piece) {
  return [axis = std::make_shared<KnownAxis>(piece)](const Scene&, const RunResult&, double x, std::size_t) {
    return axis->at(x);
  };
}

/// A point r of a piece that starts at `origin`, in the mirror of the first axis where `side` is -1.
Vector from(const Vector& origin, const Vector& r, double side) { return {origin[0] + side * r[0], origin[1] + r[1]}; }

/// A rod in a sleeve at `origin`: one piece runs on from it, from the material coordinate `a`, the other one back.
AxisPoint in_sleeve(const KnownAxis& on, const KnownAxis& back, const Vector& origin, double a, double x, bool before) {
  if (!before) {
    const AxisPoint p = on.at(x - a);
    return {from(origin, p.r, 1), p.r_x};
  }
  const AxisPoint p = back.at(a - x);  // in the mirror of the first axis, and against x
  return {from(origin, p.r, -1), {p.r_x[0], -p.r_x[1]}};
}

/// A rod of unit bending stiffness through a sleeve at its material point `at`.
Scene through_sleeve(int elements, double EA, const Point& end, double at) {
  Scene scene = beam_at_rest(elements, EA, 1, end, AxialStrain::lobatto);
  SlidingJointSpec& joint = scene.sliding_joints.emplace_back();
  joint.support = SupportType::clamp;
  joint.position = at;
  return scene;
}

}  // namespace

Problems roll_ups(const FamilyData& data) {
  Problems problems;
  for (const std::string name :
       {"green, 1 turn", "green, 0.25 turn", "engineering, 1 turn", "engineering, 0.25 turn"}) {
    for (const bool soft : {false, true}) {
      const std::string reference = "roll-up, " + name + (soft ? "" : ", EA = 4e6");
      const std::string law = data.exact.of(reference).at("parameters").at("law");
      const double EA = data.exact.parameter(reference, "EA"), EI = data.exact.parameter(reference, "EI"),
                   M = data.exact.parameter(reference, "moment");
      const Stretching stretching = stretching_of(law);
      Balance balance{.scene =
                          [=](int n, double stiffness) {
                            Scene scene = cantilever(n, stiffness, EI, stretching, AxialStrain::lobatto);
                            LoadSpec load = force_at(n, M, {1, 0, 0});
                            load.type = LoadType::moment;
                            scene.loads = {load};
                            return scene;
                          },
                      .values = end_of,
                      .axis = all_of({.law = stretching, .EA = EA, .EI = EI, .moment = M}),
                      .EA = EA};
      Problem problem = on_meshes(data, soft ? "soft roll-up" : "roll-up", name, data.exact.known(reference, {"tip"}),
                                  std::move(balance), 1);
      if (name.ends_with(", 1 turn")) problem.levels = data.levels("elements_of_a_whole_turn");
      problems.push_back(std::move(problem));
    }
  }
  return problems;
}

Problems elasticae(const FamilyData& data) {
  Problems problems;
  const auto add = [&](const std::string& family, const std::string& name, const std::string& reference, Stretching law,
                       double EA, double EI, double P) {
    const Known tip = data.exact.known(reference, {"x", "y"});
    Balance balance{.scene =
                        [=](int n, double stiffness) {
                          Scene scene = cantilever(n, stiffness, EI, law, AxialStrain::lobatto);
                          scene.loads = {force_at(n, P, {0, 1, 0})};
                          return scene;
                        },
                    .values = end_of,
                    // the moment at the clamp is that of the force about it
                    .axis = all_of({.law = law, .EA = EA, .EI = EI, .pull = {0, P}, .moment = P * tip.values[0]}),
                    .EA = EA,
                    .inextensible = law == Stretching::none};
    problems.push_back(on_meshes(data, family, name, tip, std::move(balance), 1));
  };
  for (const std::string load : {"1", "2", "5", "10"}) {
    add("elastica", "P L^2/EI = " + load, "elastica, P L^2/EI = " + load, Stretching::none, data.number("inextensible"),
        1, std::stod(load));
  }
  for (const std::string law : {"green", "engineering"}) {
    for (const std::string load : {"1", "4"}) {
      const std::string reference = "elastica, " + law + ", seed beam, P L^2/EI = " + load;
      add("extensible elastica", law + ", P L^2/EI = " + load, reference, stretching_of(law),
          data.exact.parameter(reference, "EA"), data.exact.parameter(reference, "EI"),
          data.exact.parameter(reference, "P"));
    }
  }
  return problems;
}

Problems arm_scales(const FamilyData& data) {
  Problems problems;
  for (const std::string low : {"1.5", "1.3"}) {
    const std::string reference = "arm scale, " + low + " N and 1 N";
    const double incline = data.exact.parameter(reference, "inclination") * degree,
                 length = data.exact.parameter(reference, "length"), P = std::stod(low);
    const double arm = data.exact.number(reference, "low_arm");
    const auto low_end = data.exact.list(reference, "low_end"), high_end = data.exact.list(reference, "high_end");
    const Vector along{portable::cos(incline), portable::sin(incline)};
    const Vector sleeve{arm * along[0], arm * along[1]};
    const auto back = std::make_shared<KnownAxis>(
        Piece{.EI = 1, .pull = {0, -P}, .angle = -incline, .moment = P * low_end[0], .length = arm});
    const auto on = std::make_shared<KnownAxis>(
        Piece{.EI = 1, .pull = {0, -1}, .angle = incline, .moment = -high_end[0], .length = length - arm});
    Balance balance{.scene =
                        [=](int n, double EA) {
                          Scene scene = through_sleeve(n, EA, {length * along[0], length * along[1], 0}, arm);
                          scene.loads = {force_at(0, P, {0, -1, 0}), force_at(n, 1, {0, -1, 0})};
                          return scene;
                        },
                    .values =
                        [sleeve](const Scene&, const RunResult& result) {
                          const Point &start = result.configurations.back().r.front(), &end = result.samples.back().end;
                          return std::vector<double>{*result.samples.back().joint_position, start[0] - sleeve[0],
                                                     start[1] - sleeve[1], end[0] - sleeve[0], end[1] - sleeve[1]};
                        },
                    .axis =
                        [=](const Scene&, const RunResult& result, double x, std::size_t element) {
                          return in_sleeve(*on, *back, sleeve, arm, x, before_joint(result, element));
                        },
                    .EA = data.number("inextensible"),
                    .inextensible = true};
    Problem problem =
        on_meshes(data, "arm scale", low + " N and 1 N",
                  data.exact.known(reference, {"low_arm", "low_end", "high_end"}), std::move(balance), length);
    problem.levels = data.levels(("elements_" + low).c_str());
    problems.push_back(std::move(problem));
  }
  return problems;
}

Problems rods_in_sleeves(const FamilyData& data) {
  Problems problems;
  for (const std::string degrees : {"15", "30", "60"}) {
    const std::string reference = "rod in a sleeve, " + degrees + " degrees";
    const double incline = std::stod(degrees) * degree, outside = data.exact.number(reference, "length");
    const double length = outside * 10 / 7, inside = length - outside;  // three of ten elements are before the sleeve
    const auto end = data.exact.list(reference, "end");
    const Vector along{portable::cos(incline), portable::sin(incline)};
    const Vector sleeve{inside * along[0], inside * along[1]};
    const auto on = std::make_shared<KnownAxis>(
        Piece{.EI = 1, .pull = {0, -1}, .angle = incline, .moment = -end[0], .length = outside});
    const auto back = std::make_shared<KnownAxis>(Piece{.EI = 1, .angle = -incline, .length = inside});
    Balance balance{.scene =
                        [=](int n, double EA) {
                          Scene scene = through_sleeve(n, EA, {length * along[0], length * along[1], 0}, inside);
                          scene.loads = {force_at(n, 1, {0, -1, 0})};
                          return scene;
                        },
                    .values =
                        [=](const Scene&, const RunResult& result) {
                          const Point& tip = result.samples.back().end;
                          return std::vector<double>{length - *result.samples.back().joint_position, tip[0] - sleeve[0],
                                                     tip[1] - sleeve[1]};
                        },
                    .axis =
                        [=](const Scene&, const RunResult& result, double x, std::size_t element) {
                          return in_sleeve(*on, *back, sleeve, inside, x, before_joint(result, element));
                        },
                    .EA = data.number("inextensible"),
                    .inextensible = true};
    problems.push_back(on_meshes(data, "rod in a sleeve", degrees + " degrees",
                                 data.exact.known(reference, {"length", "end"}), std::move(balance), length));
  }
  return problems;
}

}  // namespace vlbeam::exact_solutions
