// A drill stem that is fed through a rotary table and a guide while it spins: what the shaft element VLBSE (2017) is
// for. Its overhang grows, and the whirl of its unbalanced bit passes through resonance.
#include "studies/harness/study.hpp"
#include "mechanics/flow/flow_room.hpp"
#include "mechanics/spin/spin_room.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/elementary.hpp"
#include "mechanics/flow/moving_mesh.hpp"
#include "mechanics/flow/steady_flow.hpp"
#include "mechanics/spin/circular_shaft.hpp"
#include "mechanics/spin/spin_unknowns.hpp"

namespace vlbeam {
namespace drill_stem {
namespace {

constexpr int D = 3;
using Vector = Vec<double, D>;

/// The stem from the table, at depth 0, to the bit.
struct Stem {
  CircularShaft shaft;
  double guide, overhang;  ///< depth of the guide, and of the bit below it at t = 0 [m]
  double feed;             ///< [m/s]
  double spin;             ///< of the table [rad/s]
  double torque;           ///< of the soil on the bit, once it is fully there [N m]
  double ramp;             ///< [s]
  double unbalance;        ///< force at the bit that turns with the table [N]
  double duration;         ///< [s]

  explicit Stem(const Json& json)
      : shaft{.radius = json.at("radius"),
              .density = json.at("density"),
              .youngs_modulus = json.at("youngs_modulus"),
              .poisson_ratio = json.at("poisson_ratio"),
              .damping = 0},
        guide(json.at("guide")),
        overhang(json.at("overhang")),
        feed(json.at("feed")),
        spin(json.at("spin")),
        torque(json.at("torque")),
        ramp(json.at("ramp")),
        unbalance(json.at("unbalance")),
        duration(json.at("duration")) {
    shaft.check();
  }
};

/// `elements` of them, a third between table and guide, which the stem flows through; the others grow with the
/// overhang.
BeamModel<D> model_of(const Stem& stem, int elements, bool ledger) {
  const int guide = elements / 3;
  BeamModel<D> model;
  model.section = stem.shaft.section();
  spin_in(model).section = stem.shaft.spin();
  flow_in(model).motion = MeshMotion({{0, steadily(0, -stem.feed)},
                                      {guide, steadily(stem.guide, -stem.feed)},
                                      {elements, steadily(stem.guide + stem.overhang, 0)}});
  model.start = Support<D>::pin();
  model.held_nodes = {{guide, Support<D>::slide(Vector::UnitZ())}};
  spin_in(model).drives = {{0, steadily(0, stem.spin)}};
  auto turning = [=](double t) -> Vector {
    return stem.unbalance * Vector(portable::cos(stem.spin * t), portable::sin(stem.spin * t), 0);
  };
  auto soil = [=](double t) {
    const double s = std::min(1.0, t / stem.ramp);
    return -stem.torque * s * s * (3 - 2 * s);
  };
  model.loads.points = {{.node = elements, .force = turning}};
  spin_in(model).torques.points = {{.node = elements, .torque = soil}};
  flow_in(model).books = ledger;
  return model;
}

Eigen::VectorXd at_rest(const BeamSystem<D>& beam, const Stem& stem, double t = 0) {
  return straight_state<D>(beam, Vector::Zero(), Vector::UnitZ(), 1, stem.feed, stem.spin, t);
}

struct Sample {
  double overhang;   ///< [m]
  double whirl;      ///< distance of the bit from the axis [m]
  double twist;      ///< angle of the bit behind the table [rad]
  double frequency;  ///< the lowest, of the overhang as it is [Hz]
};

std::vector<Sample> feed(const Stem& stem, int elements, int steps, int samples) {
  const BeamModel<D> model = model_of(stem, elements, false);
  BeamSystem<D> beam(model, straight_chain(model));
  moving_mesh_of(beam).check_motion(stem.duration);
  std::vector<Sample> history;
  std::vector<double> times;
  for (int i = 0; i <= samples; ++i) times.push_back(stem.duration * i / samples);
  beam.on_sample = [&](const Eigen::VectorXd& y, double t) {
    const Vector bit = position<D>(y.data(), elements);
    const double angle = y[angle_of(beam, elements)] - y[angle_of(beam, 0)];
    BeamSystem<D> frozen(model, straight_chain(model));
    const auto modes = frequencies(eigenvalues(linear_flows(frozen, at_rest(frozen, stem, t), t).axis));
    history.push_back({stem.overhang + stem.feed * t, portable::hypot(bit[0], bit[1]), -angle, modes.front()});
  };
  IntegrationOptions options;
  options.type = IntegrationMethod::generalized_alpha;
  options.generalized_alpha.step = stem.duration / steps;
  SolverCounters counters;
  double t = 0;
  Eigen::VectorXd y = at_rest(beam, stem);
  integrate(beam, y, t, stem.duration, times, options, counters);
  return history;
}

/// What the ledger misses, over what passed.
struct Gap {
  double energy, mass, momentum, spin_momentum;
  double mesh;  ///< work of moving the guide's node along the stem, over the energy that passed
};

Gap ledger(const Stem& stem, int elements, double duration) {
  const BeamModel<D> model = model_of(stem, elements, true);
  BeamSystem<D> beam(model, straight_chain(model));
  Eigen::VectorXd y = at_rest(beam, stem);
  const auto before = beam.observe(y, 0, own_points);
  IntegrationOptions options;
  options.type = IntegrationMethod::fehlberg78;
  options.tolerances = {1e-9, 1e-11};
  SolverCounters counters;
  double t = 0;
  integrate(beam, y, t, duration, {}, options, counters);
  const auto after = beam.observe(y, t, own_points);
  const EnergyBalance book = model.balance().of(y);
  const double passed = std::abs(book.ends) + std::abs(book.loads);
  return {
      .energy = std::abs(after.energy.total() - before.energy.total() - book.ends - book.loads - book.mesh) / passed,
      .mass = std::abs(after.mass - before.mass - book.mass) / book.mass,
      .momentum = (after.momentum - before.momentum - book.impulse).norm() / book.impulse.norm(),
      .spin_momentum = std::abs(after.momentum_about_axis - before.momentum_about_axis - book.impulse_about_axis) /
                       std::abs(book.impulse_about_axis),
      .mesh = std::abs(book.mesh) / passed};
}

StudyReport run(const StudyContext& context) {
  const Stem stem(context.config.at("stem"));
  const auto counts = context.config.at("elements").get<std::vector<int>>();
  const int steps = context.config.at("steps"), samples = context.config.at("samples");
  const auto histories = context.sweep(
      counts, [&](int n) { return feed(stem, n, steps, samples); }, [](int n) { return n; });
  StudyReport report;
  Table table{.name = "feed",
              .caption =
                  "Overhang [m], whirl of the bit [m], its angle behind the table [rad], lowest frequency of the "
                  "overhang [Hz]",
              .columns = {"elements", "overhang", "whirl", "twist", "frequency"},
              .curve = true};
  std::vector<Sample> coarser;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    report.cases.push_back({.options = {{"elements", counts[i]}}, .results = {}, .failure = histories[i].failure});
    if (!histories[i]) continue;
    double largest = 0, change = 0;
    for (std::size_t k = 0; k < histories[i]->size(); ++k) {
      const Sample& at = (*histories[i])[k];
      table.rows.push_back({counts[i], at.overhang, at.whirl, at.twist, at.frequency});
      largest = std::max(largest, at.whirl);
      if (!coarser.empty()) change = std::max(change, std::abs(at.whirl - coarser[k].whirl));
    }
    report.cases.back().results = {{"largest_whirl", largest}, {"twist_at_the_end", histories[i]->back().twist}};
    if (!coarser.empty()) report.measured["change_n" + std::to_string(counts[i])] = change / largest;
    const auto& last = histories[i]->back();
    const double length = stem.guide + last.overhang;
    report.measured["twist_over_static_n" + std::to_string(counts[i])] =
        last.twist / (stem.torque * length / stem.shaft.spin().GIp);
    coarser = *histories[i];
  }
  report.tables.push_back(std::move(table));

  const double short_duration = context.config.at("ledger_duration");
  const Gap gap = ledger(stem, counts.front(), short_duration);
  report.cases.push_back({.options = {{"ledger", short_duration}, {"elements", counts.front()}},
                          .results = {{"energy", gap.energy},
                                      {"mass", gap.mass},
                                      {"momentum", gap.momentum},
                                      {"spin_momentum", gap.spin_momentum},
                                      {"mesh", gap.mesh}}});
  report.measured["ledger_energy"] = gap.energy;
  report.measured["ledger_mass"] = gap.mass;
  report.measured["ledger_momentum"] = gap.momentum;
  report.measured["ledger_spin_momentum"] = gap.spin_momentum;
  report.figures = {{"feed",
                     "Whirl of the bit and twist of the stem while the overhang grows",
                     "feed.gp",
                     {{"folder", context.folder.string()},
                      {"turns", std::to_string(stem.spin / (2 * std::numbers::pi))},
                      {"finest", std::to_string(counts.back())},
                      {"coarsest", std::to_string(counts.front())}}}};
  return report;
}

}  // namespace
}  // namespace drill_stem

Study drill_stem_study();

Study drill_stem_study() {
  return {.name = "drill_stem", .title = "A spinning drill stem fed through its guide", .run = drill_stem::run};
}

}  // namespace vlbeam
