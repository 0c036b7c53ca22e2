// Frequencies of what runs along its axis, of a column under a follower force, and of shafts; twists of shafts.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/geometry/elementary.hpp"
#include "mechanics/flow/flow_room.hpp"
#include "mechanics/flow/steady_flow.hpp"
#include "scene/stretch.hpp"
#include "studies/exact_solutions/balance.hpp"
#include "studies/exact_solutions/motion.hpp"
#include "studies/moving_string/transverse.hpp"
#include "studies/torsion/angle_flow.hpp"

namespace vlbeam::exact_solutions {
namespace {

/// Frequencies [rad per L/c] of a string or a beam that runs at v: lengths over L, F = rhoA = 1, EI = k^2.
std::vector<double> moving_frequencies(double v, double k, int elements, double EA, std::size_t most) {
  BeamModel<3> model;
  model.section.rhoA = 1;
  model.section.stiffness = {EA, k * k};
  const double stretch = stretch_under(1, EA);
  flow_in(model).motion = MeshMotion({{0, steadily(0, -v / stretch)}, {elements, steadily(1 / stretch, -v / stretch)}});
  model.start = model.end = Support<3>::pin();
  flow_in(model).books = false;
  BeamSystem<3> beam(model, straight_chain(model));
  const Eigen::VectorXd guess = straight_state<3>(beam, Vec<double, 3>::Zero(), Vec<double, 3>::UnitX(), stretch, v, 0);
  const auto found =
      frequencies(eigenvalues(moving_string::transverse(linear_flows(beam, steady_state(beam, guess, 0, true)))));
  std::vector<double> omega;
  for (const double f : found) omega.push_back(2 * pi * f);
  omega.resize(std::min(omega.size(), most));
  return omega;
}

/// Eigenvalues of a cantilever of L = EI = rhoA = 1 under the force p that follows the tangent at its end.
std::vector<std::complex<double>> beck(double p, int elements, double EA) {
  BeamModel<2> model;
  model.section.rhoA = 1;
  model.section.stiffness = {EA, 1};
  flow_in(model).motion = MeshMotion({{0, steadily(0, 0)}, {elements, steadily(1, 0)}});
  model.start = Support<2>::direction_clamp({1, 0});
  model.loads.points = {{.node = elements, .follower = [p](double) { return -p; }}};
  flow_in(model).books = false;
  BeamSystem<2> beam(model, straight_chain(model));
  const Eigen::VectorXd guess =
      straight_state<2>(beam, Vec<double, 2>::Zero(), Vec<double, 2>::UnitX(), stretch_under(-p, EA), 0, 0);
  return eigenvalues(linear_flows(beam, steady_state(beam, guess, 0, true)).axis);
}

/// The load beyond which it flutters, with the frequency there.
std::array<double, 2> flutter(int elements, double EA) {
  constexpr double growing = 1e-3;  // [1/s], where the load is 2e-7 beyond the critical one
  double low = 15, high = 25;
  for (int i = 0; i < 32; ++i) {
    const double p = (low + high) / 2;
    (growth_rate(beck(p, elements, EA)) < growing ? low : high) = p;
  }
  return {low, 2 * pi * frequencies(beck(low, elements, EA)).front()};
}

Problem on_meshes(const FamilyData& data, const std::string& family, const std::string& name, Known known,
                  std::function<std::vector<double>(int elements, double EA)> values) {
  Problem problem{
      .family = family, .name = name, .refined = "elements", .levels = data.levels(), .known = {}, .run = {}};
  problem.scale = std::ranges::max(known.values);
  problem.known = std::move(known);
  problem.run = [values = std::move(values), EA = data.number("inextensible")](double elements, double /*share*/) {
    Found found{.values = values(static_cast<int>(elements), EA)};
    const std::vector<double> stiffer = values(static_cast<int>(elements), 2 * EA);
    for (std::size_t i = 0; i < stiffer.size(); ++i) found.values[i] = beyond(found.values[i], stiffer[i]);
    return found;
  };
  problem.order = data.number("order");
  problem.floor = data.number("floor");
  return problem;
}

/// The shaft of reference/exact/torsion.py.
struct Shaft {
  double length, GIp, rhoIp;

  explicit Shaft(const References& exact) {
    const std::string reference = "torsion, fixed-fixed";
    const double radius = exact.parameter(reference, "radius"), J = pi * portable::pow(radius, 4) / 2;
    length = exact.parameter(reference, "length");
    GIp = exact.parameter(reference, "G") * J;
    rhoIp = exact.parameter(reference, "density") * J;
  }
  LinearMotion flow(int elements, const std::string& ends, AngleField field) const {
    BeamSection section{.rhoA = 1, .stiffness = {1e6, 1}};
    return torsion::angle_flow(section, {.rhoIp = rhoIp, .GIp = GIp}, length, elements, ends != "free-free",
                               ends == "fixed-fixed", 0, Formulation::variational, field);
  }
};

}  // namespace

Problems moving_strings(const FamilyData& data) {
  Problems problems;
  for (const std::string v : {"0", "0.3", "0.6"}) {
    const std::string reference = "moving string, v = " + v + " c";
    problems.push_back(
        on_meshes(data, "moving string", "v = " + v + " c", data.exact.known(reference, {"frequencies"}, 2),
                  [speed = std::stod(v)](int n, double EA) { return moving_frequencies(speed, 0, n, EA, 2); }));
  }
  return problems;
}

Problems moving_beams(const FamilyData& data) {
  Problems problems;
  for (const std::string k : {"0.1", "0.5"}) {
    for (const std::string v : {"0", "0.3", "0.6", "1.02"}) {
      const std::string reference = "moving beam, k = " + k + ", v = " + v + " c";
      problems.push_back(on_meshes(data, "moving beam", "k = " + k + ", v = " + v + " c",
                                   data.exact.known(reference, {"frequencies"}, 2),
                                   [speed = std::stod(v), bending = std::stod(k)](int n, double EA) {
                                     return moving_frequencies(speed, bending, n, EA, 2);
                                   }));
    }
  }
  return problems;
}

Problems beck_columns(const FamilyData& data) {
  Problems problems;
  for (const std::string p : {"0", "5", "10", "15", "20"}) {
    problems.push_back(on_meshes(data, "Beck's column", "p = " + p,
                                 data.exact.known("Beck's column, p = " + p, {"omega"}, 2),
                                 [load = std::stod(p)](int n, double EA) {
                                   Scene scene = beam_at_rest(n, EA, 1, {1, 0, 0}, AxialStrain::full);
                                   scene.start.type = SupportType::clamp;
                                   if (load > 0) {
                                     scene.loads = {force_at(n, -load, {})};
                                     scene.loads[0].type = LoadType::follower;
                                   }
                                   scene.statics = {.steps = 4, .frequencies = 2, .joints = {}};
                                   const auto found = StudyContext::simulate_to_the_end(scene).frequencies;
                                   return std::vector<double>{2 * pi * found.at(0), 2 * pi * found.at(1)};
                                 }));
  }
  problems.push_back(on_meshes(data, "Beck's column", "critical load",
                               data.exact.known("Beck's column, critical load", {"load"}),
                               [](int n, double EA) { return std::vector<double>{flutter(n, EA)[0]}; }));
  problems.back().floor = 1e-7;  // of where growth is seen
  return problems;
}

Problems torsional_frequencies(const FamilyData& data) {
  Problems problems;
  const Shaft shaft(data.exact);
  for (const std::string ends : {"fixed-fixed", "fixed-free", "free-free"}) {
    const std::string reference = "torsion, " + ends;
    const auto values = [=](int elements, AngleField field, std::size_t most) {
      const LinearMotion flow = shaft.flow(elements, ends, field);
      const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(flow.K, flow.M, Eigen::EigenvaluesOnly);
      std::vector<double> found;
      for (Eigen::Index i = ends == "free-free" ? 1 : 0; found.size() < most; ++i) {
        found.push_back(std::sqrt(solver.eigenvalues()[i]) / (2 * pi));
      }
      return found;
    };
    Problem problem{.family = "torsion",
                    .name = ends + ", cubic angles",
                    .refined = "elements",
                    .levels = data.levels(),
                    .known = data.exact.known(reference, {"exact"}, 2),
                    .run = [values](double n, double /*share*/) {
                      return Found{.values = values(static_cast<int>(n), AngleField::hermite, 2)};
                    }};
    problem.scale = problem.known.values.back();
    problem.order = data.number("order");
    problem.floor = data.number("floor");
    problems.push_back(problem);
    // what linear elements with consistent mass have is a closed form, too, on one mesh
    problem.name = ends + ", linear angles, discrete";
    problem.levels = {data.exact.parameter(reference, "elements")};
    problem.known = data.exact.known(reference, {"consistent"});
    problem.run = [values](double n, double /*share*/) {
      return Found{.values = values(static_cast<int>(n), AngleField::linear, 4)};
    };
    problem.order = 0;
    problems.push_back(std::move(problem));
  }
  return problems;
}

Problems point_torques(const FamilyData& data) {
  Problems problems;
  const Shaft shaft(data.exact);
  for (const std::string ends : {"fixed-fixed", "fixed-free"}) {
    const std::string reference = "torsion, " + ends + ", point torque";
    const Json& given = data.exact.of(reference).at("parameters");
    const double torque = given.at("torque"), a = given.at("a");
    const auto places = given.at("x").get<std::vector<double>>();
    Problem problem{.family = "point torque",
                    .name = ends,
                    .refined = "elements",
                    .levels = data.levels(),
                    .known = data.exact.known(reference, {"twist"}),
                    .run = {}};
    problem.run = [=](double elements, double /*share*/) {
      const Eigen::MatrixXd K = shaft.flow(static_cast<int>(elements), ends, AngleField::linear).K;
      const auto node = [&](double x) { return std::lround(x * elements) - 1; };  // the first angle is held
      Eigen::VectorXd load = Eigen::VectorXd::Zero(K.rows());
      load[node(a)] = torque;
      const Eigen::VectorXd twist = Eigen::PartialPivLU<Eigen::MatrixXd>(K).solve(load);
      Found found;
      for (const double x : places) found.values.push_back(twist[node(x)]);
      return found;
    };
    problem.scale = std::ranges::max(problem.known.values);
    problem.floor = data.number("floor");
    problems.push_back(std::move(problem));
  }
  return problems;
}

Problems moving_torques(const FamilyData& data) {
  Problems problems;
  for (const std::string beta : {"0.4", "1", "1.6"}) {
    const std::string reference = "torsion, torque that moves at " + beta + " c";
    const auto taus = data.exact.of(reference).at("parameters").at("tau").get<std::vector<double>>();
    Problem problem{.family = "moving torque",
                    .name = beta + " c",
                    .refined = "elements",
                    .levels = data.levels(),
                    .known = data.exact.known(reference, {"twist_at_0.3", "twist_at_0.55"}),
                    .run = {}};
    problem.run = [=, speed = std::stod(beta), steps = data.number("steps")](double elements, double /*share*/) {
      Section section = section_of(1e4, 1, 1);
      section.GIp = section.rhoIp = 1;
      const int n = static_cast<int>(elements);
      Scene scene = moving_beam(n, section, {1, 0, 0}, 1 / (steps * elements));
      scene.dimension = 3;
      scene.start.type = scene.end.type = SupportType::pin;
      scene.spin.emplace().drives = {{0, {}}, {n, {}}};
      LoadSpec load = travelling(1, 0, speed);
      load.type = LoadType::torque;
      scene.loads = {load};
      scene.duration = taus.back();
      scene.output.interval = taus.back();
      scene.output.configurations = taus;
      const RunResult result = StudyContext::simulate_to_the_end(scene);
      Found found;
      for (const double place : {0.3, 0.55}) {
        for (const Configuration& shape : result.configurations) {
          found.values.push_back(shape.angles[static_cast<std::size_t>(std::lround(place * elements))]);
        }
      }
      return found;
    };
    problem.cost = 5;
    problems.push_back(std::move(problem));
  }
  return problems;
}

}  // namespace vlbeam::exact_solutions
