// Beams that are made to follow a chosen motion: errors in space and in time against it, with a mark that travels.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/element/quadrature.hpp"
#include "core/length_control/chain_motion.hpp"
#include "io/scene_json.hpp"
#include "scene/build.hpp"
#include "scene/derived.hpp"
#include "scene/run_support.hpp"
#include "studies/manufactured/body_force.hpp"
#include "tools/scene_sweep.hpp"

namespace vlbeam {
namespace manufactured {
namespace {

/// Weights along the beam.
enum class WeightsOf {
  units,
  smooth,  ///< Bernstein coefficients of the cubics through one smooth W(x) and its slope at the nodes
  uneven,  ///< the same four unequal ones in every element
};
constexpr auto names(WeightsOf) {
  return std::to_array<Named<WeightsOf>>(
      {{WeightsOf::units, "units"}, {WeightsOf::smooth, "smooth"}, {WeightsOf::uneven, "uneven"}});
}

/// One run: a scene whose only joint or inner guide is the mark.
struct Item {
  std::string series;
  double level;  ///< elements, or steps over the whole duration
  WeightsOf weights;
  Scene scene;
};

struct Errors {
  double r, v;  ///< L2 norms along the beam [m sqrt(m), m/s sqrt(m)]
  int steps, events;
};

Weights<double> smooth_weights(double a, double b) {
  const auto value = [](double x) { return 1 + 0.3 * portable::sin(0.8 * x + 0.4); };
  const auto slope = [](double x) { return 0.24 * portable::cos(0.8 * x + 0.4); };
  const double l = b - a;
  return {value(a), value(a) + slope(a) * l / 3, value(b) - slope(b) * l / 3, value(b)};
}

void set_weights(WeightsOf how, ChainState<2>& chain) {
  for (std::size_t k = 0; k < chain.mesh.weights.size(); ++k) {
    Weights<double>& w = chain.mesh.weights[k].w;
    if (how == WeightsOf::uneven) w = {1, 0.8, 1.2, 1};
    if (how == WeightsOf::smooth) w = smooth_weights(chain.mesh.x[k], chain.mesh.x[k + 1]);
  }
}

/// Nodes on the chosen motion, with its velocities.
void follow(const ChosenMotion& motion, ChainState<2>& chain) {
  for (int k = 0; k <= chain.mesh.last(); ++k) {
    const double x = chain.mesh.x[static_cast<std::size_t>(k)], rate = chain.mark_rate(k);
    const auto r = [&](int by_x, int by_t) { return motion.derivative(x, 0, by_x, by_t); };
    position<2>(chain.q.data(), k) = r(0, 0);
    slope<2>(chain.q.data(), k) = r(1, 0);
    position<2>(chain.rate.data(), k) = r(0, 1) + rate * r(1, 0);
    slope<2>(chain.rate.data(), k) = r(1, 1) + rate * r(2, 0);
  }
}

Errors errors_of(const ChosenMotion& motion, const ChainState<2>& chain, WeightTransport transport, double t) {
  double r = 0, v = 0;
  for (int k = 0; k < chain.mesh.last(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double x_a = chain.mesh.x[i], l = chain.mesh.x[i + 1] - x_a;
    for (const auto& [u, weight] : gauss_legendre(10)) {
      const double x = x_a + u * l;
      const auto at = motion_at(chain, k, x, transport);
      r += weight * l * (at.r - motion.derivative(x, t, 0)).squaredNorm();
      v += weight * l * (at.v - motion.derivative(x, t, 0, 1)).squaredNorm();
    }
  }
  return {std::sqrt(r), std::sqrt(v), 0, 0};
}

class Report {
 public:
  explicit Report(const StudyContext& context)
      : context_(context), motion_(ChosenMotion::from_json(context.config.at("motion"))) {
    for (const Json& series : context.config.at("series")) read(series);
  }

  StudyReport operator()() {
    const auto outcomes = context_.sweep(
        items_, [this](const Item& item) { return run(item); }, [](const Item& item) { return item.level; });
    std::map<std::string, std::vector<std::pair<double, Errors>>> found;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      const Item& item = items_[i];
      StudyCase& one = report_.cases.emplace_back();
      one.options = {{"series", item.series}, {"level", item.level}, {"weights", to_string(item.weights)}};
      if (!outcomes[i]) {
        one.failure = outcomes[i].failure;
        continue;
      }
      const Errors& e = *outcomes[i];
      one.results = {{"position", e.r}, {"velocity", e.v}, {"steps", e.steps}, {"events", e.events}};
      table_.rows.push_back({item.series, item.level, e.r, e.v, e.steps, e.events});
      found[item.series].emplace_back(item.level, e);
      report_.measured["events/" + item.series] = std::max(report_.measured["events/" + item.series], double(e.events));
    }
    for (const auto& [series, errors] : found) judge(series, errors);
    compare_speeds(found);
    std::string run = "|";
    for (const auto& [series, errors] : found) run += series + "|";
    report_.tables = {table_};
    report_.figures = {{.name = "errors",
                        .caption = "Errors in space by the speed of the mark and by the weights, and in time",
                        .script = "errors.gp",
                        .variables = {{"folder", context_.folder.string()}, {"run", run}}}};
    return std::move(report_);
  }

 private:
  void read(const Json& series) {
    for (const Json& level : series.at("levels")) {
      Json scene = context_.config.at("scene");
      const bool in_time = series.contains("elements");
      const double duration = scene.at("duration"), speed = series.at("speed");
      const int elements = in_time ? series.at("elements").get<int>() : level.get<int>();
      scene["beam"]["elements"] = elements;
      if (series.contains("set")) {
        for (const auto& [pointer, value] : series.at("set").items()) assign_option(scene, pointer, value);
      }
      const double at_end = context_.config.at("mark"), start = at_end - speed * duration;
      if (series.at("mark") == "nodes") {
        const double length = scene_from_json(scene).beam.curve.end[0];
        scene["flow"]["nodes"] = {{{"node", 0}},
                                  {{"node", elements / 2}, {"x", {{"value", start}, {"rate", speed}}}},
                                  {{"node", elements}, {"x", {{"value", length}}}}};
      } else {
        scene["sliding_joints"] = {{{"position", start}, {"x", {{"rate", speed}}}}};
      }
      if (in_time) scene["integrator"]["step"] = duration / level.get<double>();
      const auto weights = from_string<WeightsOf>(series.value("weights", "units")).value();
      items_.push_back({series.at("name"), level, weights, scene_from_json(scene)});
    }
  }

  Errors run(const Item& item) const {
    const Scene& scene = item.scene;
    BeamModel<2> model = build_model<2>(scene);
    const Properties of{model.section.stiffness.EA, model.section.stiffness.EI, model.section.rhoA,
                        rest_curvature(scene)};
    model.parts = {std::make_shared<BodyForce>(Forces(motion_, of))};
    ChainState<2> chain = build_chain<2>(scene);
    set_weights(item.weights, chain);
    follow(motion_, chain);
    BeamSystem<2> system(model, chain);
    int events = 0;
    system.on_step = StudyContext::until_interrupted();
    system.on_event = [&events](const EventRecord<2>&) { ++events; };
    Eigen::VectorXd y = system.initial_state();
    double t = 0;
    SolverCounters counters;
    const auto options = integration_options(scene, model.section, system.mesh().shortest());
    if (!integrate(system, y, t, scene.duration, {}, options, counters)) throw std::runtime_error("interrupted");
    Errors errors = errors_of(motion_, system.chain(y, t), model.transport, t);
    errors.steps = static_cast<int>(counters.steps);
    errors.events = events;
    return errors;
  }

  static double rest_curvature(const Scene& scene) {
    return scene.beam.curve.type == CurveType::arc ? 1 / scene.beam.curve.radius : 0;
  }

  void judge(const std::string& series, const std::vector<std::pair<double, Errors>>& errors) {
    for (const bool velocity : {false, true}) {
      std::vector<double> levels, of;
      for (const auto& [level, e] : errors) {
        levels.push_back(level);
        of.push_back(velocity ? e.v : e.r);
      }
      const std::string name = series + (velocity ? "/velocity" : "/position");
      report_.fits.push_back(fit_order(name, levels, of, {.rule = level_rule_of(context_.config, name)}));
      report_.measured["finest/" + name] = of.back();
      report_.measured["order/" + name] = report_.fits.back().slope;
    }
  }

  /// Errors of a moving mark beside those of a resting one on the same mesh.
  void compare_speeds(const std::map<std::string, std::vector<std::pair<double, Errors>>>& found) {
    for (const auto& [resting, moving] :
         context_.config.at("beside").get<std::map<std::string, std::vector<std::string>>>()) {
      double most = 0;
      for (const std::string& name : moving) {
        for (std::size_t i = 0; i < found.at(resting).size(); ++i) {
          most = std::max(most, std::abs(found.at(name)[i].second.r / found.at(resting)[i].second.r - 1));
        }
      }
      report_.measured["beside/" + resting] = most;
    }
  }

  const StudyContext& context_;
  ChosenMotion motion_;
  std::vector<Item> items_;
  Table table_{.name = "errors",
               .caption = "L2 norms of the errors of position [m sqrt(m)] and velocity at the end",
               .columns = {"series", "level", "position", "velocity", "steps", "events"}};
  StudyReport report_;
};

StudyReport run(const StudyContext& context) { return Report(context)(); }

}  // namespace
}  // namespace manufactured

Study manufactured_study();

Study manufactured_study() {
  return {.name = "manufactured",
          .title = "Do beams that are made to follow a chosen motion follow it, to the order that theory states?",
          .run = manufactured::run};
}

}  // namespace vlbeam
