// Natural frequencies of a string and a beam that move along their axis between two supports (the first example of the
// shaft element VLBSE, 2017).
#include "studies/harness/study.hpp"
#include "mechanics/flow/flow_room.hpp"
#include "mechanics/spin/spin_room.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "io/files.hpp"
#include "mechanics/spin/circular_shaft.hpp"
#include "scene/stretch.hpp"
#include "studies/moving_string/transverse.hpp"

namespace vlbeam {
namespace moving_string {
namespace {

constexpr int D = 3;
using Vector = Vec<double, D>;
constexpr double negligible_growth = 1e-2;  // [1/s], rounding of eigenvalues that only oscillate

/// What lies between the supports, and how it is modelled.
struct SupportedSpan {
  CircularShaft shaft;
  double length = 1;      ///< [m]
  double tension = 1000;  ///< [N]
  double speed = 40;      ///< [m/s]
  int elements = 4;
  bool bends = true;
  bool spins = false;     ///< with the angles of the shaft element
  double stiffening = 1;  ///< of EA alone: towards the linear theory, which knows no stretch
};

/// `span` between two pins; its nodes stand still in space and move along the beam.
BeamModel<D> model_of(const SupportedSpan& span) {
  BeamModel<D> model;
  model.section = span.shaft.section();
  model.section.stiffness.EA *= span.stiffening;
  if (!span.bends) model.section.stiffness.EI = 0;
  if (span.spins) spin_in(model).section = span.shaft.spin();
  const double stretch = stretch_under(span.tension, model.section.stiffness.EA);
  flow_in(model).motion = MeshMotion({{0, steadily(0, -span.speed / stretch)},
                                      {span.elements, steadily(span.length / stretch, -span.speed / stretch)}});
  model.start = model.end = Support<D>::pin();
  flow_in(model).books = false;
  if (span.spins) spin_in(model).drives = {{0, steadily(0, 0)}, {span.elements, steadily(0, 0)}};
  return model;
}

Eigen::VectorXd straight(const BeamSystem<D>& beam, const SupportedSpan& span) {
  return straight_state<D>(beam, Vector::Zero(), Vector::UnitX(),
                           stretch_under(span.tension, beam.model().section.stiffness.EA), span.speed, 0);
}

struct Modes {
  std::array<double, 3> frequency;  ///< of one transverse plane, NaN where there are fewer [Hz]
  double growth;                    ///< [1/s]
};

Modes modes_of(const SupportedSpan& span) {
  const BeamModel<D> model = model_of(span);
  BeamSystem<D> beam(model, straight_chain(model));
  const Eigen::VectorXd y = steady_state(beam, straight(beam, span), 0, true);
  const auto values = eigenvalues(transverse(linear_flows(beam, y)));
  const auto found = frequencies(values);
  Modes modes{{}, growth_rate(values)};
  for (std::size_t i = 0; i < modes.frequency.size(); ++i) {
    modes.frequency[i] = i < found.size() ? found[i] : std::numeric_limits<double>::quiet_NaN();
  }
  return modes;
}

/// Deflection of the middle node, at equal intervals, after the inner nodes were given a transverse velocity.
std::vector<double> deflections(const SupportedSpan& span, double velocity, double interval, int samples) {
  const BeamModel<D> model = model_of(span);
  BeamSystem<D> beam(model, straight_chain(model));
  Eigen::VectorXd y = straight(beam, span);
  for (int k = 1; k < span.elements; ++k) position<D>(y.data() + beam.coordinates(), k)[1] = velocity;
  std::vector<double> times, result;
  for (int i = 0; i <= samples; ++i) times.push_back(i * interval);
  beam.on_sample = [&](const Eigen::VectorXd& at, double) {
    result.push_back(position<D>(at.data(), span.elements / 2)[1]);
  };
  IntegrationOptions options;
  options.type = IntegrationMethod::dopri5;
  options.tolerances = {1e-8, 1e-10};
  SolverCounters counters;
  double t = 0;
  integrate(beam, y, t, times.back(), times, options, counters);
  return result;
}

CircularShaft shaft_from(const Json& json) {
  CircularShaft shaft{
      .radius = json.at("radius"), .density = json.at("density"), .youngs_modulus = json.at("youngs_modulus")};
  shaft.check();
  return shaft;
}

Json or_null(double x) { return std::isfinite(x) ? Json(x) : Json(); }

class Report {
 public:
  explicit Report(const StudyContext& context)
      : context_(context),
        reference_(parse_json(
            read_text(context.folder.parent_path().parent_path() / "reference" / "moving_beam_frequencies.json"))) {
    const Json& span = context.config.at("span");
    base_.shaft = shaft_from(span);
    base_.length = span.at("length");
    base_.tension = span.at("tension");
    base_.speed = span.at("speed");
  }

  StudyReport operator()() {
    four_elements();
    order();
    reference_speeds();
    speeds();
    histories();
    const GnuplotVariables variables{{"folder", context_.folder.string()}};
    report_.figures = {{"figure3", "Midpoint deflection of the moving string, 4 elements", "figure3.gp", variables},
                       {"figure4", "Midpoint deflection of the moving beam, 4 elements", "figure4.gp", variables},
                       {"speed", "Frequencies against the speed, to beyond the critical one", "speed.gp", variables},
                       {"order", "Error of the first frequency against the number of elements", "order.gp", variables}};
    return std::move(report_);
  }

 private:
  static std::string name_of(const SupportedSpan& span) { return span.bends ? "beam" : "string"; }

  SupportedSpan with(int elements, bool bends, double stiffening = 1) const {
    SupportedSpan span = base_;
    span.elements = elements;
    span.bends = bends;
    span.stiffening = stiffening;
    return span;
  }

  /// Runs the cases; one that fails is reported and its outcome empty.
  std::vector<Outcome<Modes>> run(const std::vector<SupportedSpan>& cases, const char* group) {
    auto outcomes = context_.sweep(cases, modes_of, [](const SupportedSpan& span) { return span.elements; });
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const SupportedSpan& span = cases[i];
      if (outcomes[i] && group == std::string("speeds")) continue;  // a curve
      StudyCase item{.options = {{"group", group},
                                 {"model", name_of(span)},
                                 {"youngs_modulus", span.shaft.youngs_modulus},
                                 {"speed", span.speed},
                                 {"elements", span.elements},
                                 {"spin", span.spins},
                                 {"stiffening", span.stiffening}},
                     .results = {},
                     .failure = outcomes[i].failure};
      if (outcomes[i]) {
        item.results = {{"f1", or_null(outcomes[i]->frequency[0])}, {"growth", outcomes[i]->growth}};
      }
      report_.cases.push_back(std::move(item));
    }
    return outcomes;
  }

  /// Linearised about the stretched moving state, and about one stretched next to nothing: the linear theory.
  void four_elements() {
    const double stiffening = context_.config.at("stiffening");
    std::vector<SupportedSpan> cases;
    for (const bool bends : {false, true}) {
      for (const double factor : {1.0, stiffening}) cases.push_back(with(4, bends, factor));
      cases.push_back(with(4, bends));
      cases.back().spins = true;
    }
    const auto outcomes = run(cases, "four elements");
    Table table{.name = "four_elements",
                .caption =
                    "First frequency [Hz], four elements: about the state stretched by the tension, and in the limit "
                    "of the linear theory",
                .columns = {"model", "spin", "stiffening", "f1"}};
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (!outcomes[i]) continue;
      const double f = outcomes[i]->frequency[0];
      table.rows.push_back({name_of(cases[i]), cases[i].spins ? "yes" : "no", cases[i].stiffening, f});
      const std::string key = name_of(cases[i]) + (cases[i].spins ? "_spin" : cases[i].stiffening > 1 ? "_linear" : "");
      report_.measured[key + "_f1_n4"] = f;
    }
    for (const char* model : {"string", "beam"}) {
      const std::string key = model;
      if (!report_.measured.contains(key + "_f1_n4") || !report_.measured.contains(key + "_spin_f1_n4")) continue;
      report_.measured[key + "_changed_by_spin"] =
          std::abs(report_.measured.at(key + "_spin_f1_n4") - report_.measured.at(key + "_f1_n4"));
    }
    report_.tables.push_back(std::move(table));
  }

  void order() {
    const double stiffening = context_.config.at("order").at("stiffening");
    std::vector<SupportedSpan> cases;
    for (const bool bends : {false, true}) {
      const Json& levels = context_.config.at("order").at(bends ? "beam" : "string");
      for (const int n : levels.get<std::vector<int>>()) cases.push_back(with(n, bends, stiffening));
    }
    const auto outcomes = run(cases, "order");
    Table table{.name = "order",
                .caption = "Error of the first frequency [Hz] against the exact one of the linear theory",
                .columns = {"model", "elements", "error"}};
    for (const bool bends : {false, true}) {
      std::vector<double> levels, errors;
      for (std::size_t i = 0; i < cases.size(); ++i) {
        if (cases[i].bends != bends || !outcomes[i]) continue;
        levels.push_back(cases[i].elements);
        errors.push_back(std::abs(outcomes[i]->frequency[0] - exact(bends)));
        table.rows.push_back({name_of(cases[i]), cases[i].elements, errors.back()});
      }
      const std::string name = bends ? "beam_f1" : "string_f1";
      if (levels.empty()) continue;
      report_.fits.push_back(fit_order(name, levels, errors, {.rule = level_rule_of(context_.config, name)}));
    }
    report_.tables.push_back(std::move(table));
  }

  /// f1 at the speed of the paper.
  double exact(bool bends) const {
    for (const Json& row : reference_.at("rows")) {
      if (row[0] == 70 && row[1].get<double>() == base_.speed) return row[bends ? 3 : 2];
    }
    throw InvalidInput("/span/speed", std::to_string(base_.speed), "a speed that the reference holds");
  }

  /// Every row of the reference, against the exact frequencies and against four elements of the linear equation.
  void reference_speeds() {
    const Json& sweep = context_.config.at("reference_speeds");
    const int fine = sweep.at("elements");
    std::vector<SupportedSpan> cases;
    std::vector<const Json*> rows;
    for (const Json& row : reference_.at("rows")) {
      for (const int n : {4, fine}) {
        for (const bool bends : {false, true}) {
          if (row[bends ? 3 : 2].is_null()) continue;
          SupportedSpan span = with(n, bends, sweep.at("stiffening"));
          span.shaft.youngs_modulus = row[0].get<double>() * 1e9;
          span.speed = row[1];
          cases.push_back(span);
          rows.push_back(&row);
        }
      }
    }
    const auto outcomes = run(cases, "reference");
    Table table{
        .name = "reference_speeds",
        .caption = "Frequencies [Hz] at the speeds of the reference: exact, four elements, and " + std::to_string(fine),
        .columns = {"model", "youngs_modulus", "speed", "elements", "f1", "f1_exact", "f2", "f2_exact"}};
    double against_elements = 0, against_exact = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (!outcomes[i]) continue;
      const Json& row = *rows[i];
      const bool bends = cases[i].bends;
      const double f1 = outcomes[i]->frequency[0], f2 = outcomes[i]->frequency[1];
      const double exact1 = row[bends ? 3 : 2];
      table.rows.push_back({name_of(cases[i]), cases[i].shaft.youngs_modulus, cases[i].speed, cases[i].elements, f1,
                            exact1, f2, bends ? row[4] : Json(2 * exact1)});
      if (cases[i].elements == 4) {
        against_elements = std::max(against_elements, std::abs(f1 - row[bends ? 7 : 6].get<double>()));
        if (bends) against_elements = std::max(against_elements, std::abs(f2 - row[8].get<double>()));
      } else {
        against_exact = std::max(against_exact, std::abs(f1 - exact1));
      }
    }
    report_.measured["speeds_against_linear_elements"] = against_elements;
    report_.measured["speeds_against_exact"] = against_exact;
    report_.tables.push_back(std::move(table));
  }

  /// To the critical speed of the string, where all its frequencies vanish: beyond it both its waves run downstream,
  /// and a string between two supports is no well-posed problem. Through that of the beam, which then diverges.
  void speeds() {
    const Json& sweep = context_.config.at("speeds");
    const double critical = std::sqrt(base_.tension / base_.shaft.section().rhoA);
    std::vector<SupportedSpan> cases;
    for (const int n : sweep.at("elements").get<std::vector<int>>()) {
      for (const bool bends : {false, true}) {
        const double to = bends ? sweep.at("to").get<double>() : critical;
        for (double v = 0; v <= to; v += sweep.at("step").get<double>()) {
          cases.push_back(with(n, bends));
          cases.back().speed = v;
        }
      }
    }
    const auto outcomes = run(cases, "speeds");
    Table table{.name = "speeds",
                .caption = "Frequencies [Hz] and growth of a disturbance [1/s] against the speed",
                .columns = {"model", "elements", "speed", "f1", "f2", "growth"},
                .curve = true};
    std::map<std::string, double> last_stable;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (!outcomes[i]) continue;
      const std::string key = name_of(cases[i]) + "_n" + std::to_string(cases[i].elements);
      const auto& f = outcomes[i]->frequency;
      const bool diverges = outcomes[i]->growth > negligible_growth;  // the lowest pair of eigenvalues is then real
      table.rows.push_back({name_of(cases[i]), cases[i].elements, cases[i].speed, diverges ? Json() : or_null(f[0]),
                            or_null(f[diverges ? 0 : 1]), diverges ? outcomes[i]->growth : 0});
      if (!diverges) last_stable[key] = std::max(last_stable[key], cases[i].speed);
      report_.measured[key + "_growth"] = std::max(0.0, outcomes[i]->growth);  // at the highest speed
    }
    for (const auto& [key, speed] : last_stable) report_.measured[key + "_last_stable_speed"] = speed;
    report_.tables.push_back(std::move(table));
  }

  void histories() {
    const Json& history = context_.config.at("history");
    std::vector<SupportedSpan> cases;
    for (const bool bends : {false, true}) {
      for (const bool spins : {false, true}) {
        cases.push_back(with(4, bends));
        cases.back().spins = spins;
      }
    }
    const double interval = history.at("interval");
    const auto outcomes = context_.sweep(cases, [&](const SupportedSpan& span) {
      return deflections(span, history.at("velocity"), interval, history.at("samples"));
    });
    Table table{.name = "history",
                .caption = "Deflection of the middle [m] against time",
                .columns = {"model", "spin", "t", "deflection"},
                .curve = true};
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const std::string name = name_of(cases[i]);
      report_.cases.push_back({.options = {{"group", "history"}, {"model", name}, {"spin", cases[i].spins}},
                               .results = {},
                               .failure = outcomes[i].failure});
      if (!outcomes[i]) continue;
      double largest = 0;
      for (std::size_t k = 0; k < outcomes[i]->size(); ++k) {
        const double w = (*outcomes[i])[k];
        table.rows.push_back({name, cases[i].spins ? "yes" : "no", static_cast<double>(k) * interval, w});
        largest = std::max(largest, std::abs(w));
      }
      report_.measured[name + (cases[i].spins ? "_spin" : "") + "_amplitude"] = largest;
    }
    report_.tables.push_back(std::move(table));
  }

  const StudyContext& context_;
  Json reference_;
  SupportedSpan base_;
  StudyReport report_;
};

StudyReport run(const StudyContext& context) { return Report(context)(); }

}  // namespace
}  // namespace moving_string

Study moving_string_study();

Study moving_string_study() {
  return {.name = "moving_string",
          .title = "Frequencies of a string and a beam that move along their axis",
          .run = moving_string::run};
}

}  // namespace vlbeam
