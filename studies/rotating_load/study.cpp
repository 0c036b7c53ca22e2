// A spinning shaft under a load that moves along it and turns about it (the third example of the shaft element VLBSE,
// 2017, after Katz 2001).
#include "studies/harness/study.hpp"
#include "mechanics/flow/flow_room.hpp"
#include "mechanics/spin/spin_room.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "core/length_control/chain_motion.hpp"
#include "io/files.hpp"
#include "mechanics/flow/moving_mesh.hpp"
#include "mechanics/flow/steady_flow.hpp"
#include "mechanics/spin/circular_shaft.hpp"
#include "scene/options.hpp"
#include "studies/rotating_load/closed_form.hpp"

namespace vlbeam {
namespace rotating_load {
namespace {

constexpr int D = 3;
using Vector = Vec<double, D>;

// The elements behind the load have no length when it comes onto the shaft, those ahead none when it leaves: a run goes
// from `margin` to 1 - `margin` of the way, and its last sample is extrapolated from the two before.
constexpr double margin = 2e-4;
constexpr std::array<const char*, 4> quantities{"load_U1", "load_U2", "middle_U1", "middle_U2"};
constexpr int samples = 100;
constexpr int points = 40;  // of a configuration

struct Case {
  RotatingLoad set;
  int elements;
  int steps;         ///< of the implicit method, on the whole way
  double spin = -1;  ///< of a shaft with rotary inertia [rad/s]; negative for none
};

/// Deflections over P l^3/(48 EJ).
struct History {
  std::vector<std::array<double, 4>> at;                     ///< load at 1/100, 2/100, ... 1 of the length
  std::array<std::vector<std::array<double, 3>>, 4> shapes;  ///< z/l, U1, U2 at each quarter of the way
};

/// Where the material point x is.
Vector place_of(const ChainState<D>& chain, double x) {
  return motion_at(chain, chain.mesh.element_at(x), x, WeightTransport::frozen).r;
}

class Shaft {
 public:
  explicit Shaft(const Json& config)
      : shaft_{.radius = config.at("radius"),
               .density = config.at("density"),
               .youngs_modulus = config.at("youngs_modulus"),
               .poisson_ratio = config.at("poisson_ratio")},
        length_(config.at("length")),
        spin_(config.at("spin")),
        deflection_(config.at("static_deflection").get<double>() * length_) {
    shaft_.check();
  }

  History history(const Case& run) const {
    CircularShaft shaft = shaft_;
    if (run.set.slenderness > 0) shaft.radius = run.set.slenderness * length_;
    const double EJ = shaft.section().stiffness.EI, spin = run.spin < 0 ? spin_ : run.spin;
    const double speed = speed_of(run.set);
    const double duration = length_ / speed, omega = 2 * std::numbers::pi * run.set.k_omega / duration;
    const double force = 48 * EJ * deflection_ / (length_ * length_ * length_);
    const int middle = run.elements / 2;

    BeamModel<D> model;
    model.section = shaft.section();
    spin_in(model).section = shaft.spin();
    if (run.spin >= 0) {
      const double rhoIp = shaft.spin().rhoIp;
      flow_in(model).rotary = {.rhoJ = rhoIp / 2, .gyroscopic = rhoIp * spin, .direction = Vector::UnitZ()};
    }
    flow_in(model).motion = MeshMotion(
        {{0, steadily(0, 0)}, {middle, steadily(margin * length_, speed)}, {run.elements, steadily(length_, 0)}});
    model.start = Support<D>::pin();
    model.end = Support<D>::slide(Vector::UnitZ());
    flow_in(model).books = false;
    spin_in(model).drives = {{0, steadily(0, spin)}};
    auto turning = [=](double t) -> Vector {
      const double angle = omega * (t + margin * duration);
      return {force * portable::cos(angle), force * portable::sin(angle), 0};
    };
    model.loads.points = {{.node = middle, .force = turning}};
    BeamSystem<D> beam(model, straight_chain(model));
    moving_mesh_of(beam).check_motion((1 - 2 * margin) * duration);

    std::vector<double> times;
    for (int i = 1; i < samples; ++i) times.push_back(duration * (static_cast<double>(i) / samples - margin));
    for (const int k : {3, 2}) times.push_back(duration * (1 - k * margin));
    History history;
    beam.on_sample = [&](const Eigen::VectorXd& y, double t) {
      const ChainState<D> chain = beam.chain(y, t);
      const Vector load = position<D>(y.data(), middle) / deflection_;
      const Vector half = place_of(chain, length_ / 2) / deflection_;
      history.at.push_back({load[0], load[1], half[0], half[1]});
      const std::size_t count = history.at.size();
      if (count % (samples / 4) != 0) return;
      for (int i = 0; i <= points; ++i) {
        const Vector r = place_of(chain, length_ * i / points);
        history.shapes[count / (samples / 4) - 1].push_back({r[2] / length_, r[0] / deflection_, r[1] / deflection_});
      }
    };
    IntegrationOptions options;
    options.type = IntegrationMethod::generalized_alpha;
    options.generalized_alpha.step = duration / run.steps;
    SolverCounters counters;
    double t = 0;
    Eigen::VectorXd y = straight_state<D>(beam, Vector::Zero(), Vector::UnitZ(), 1, 0, spin);
    integrate(beam, y, t, times.back(), times, options, counters);

    const auto last = history.at.back();
    history.at.pop_back();
    for (std::size_t q = 0; q < last.size(); ++q) history.at.back()[q] = 2 * last[q] - history.at.back()[q];
    return history;
  }

  /// Of the load [m/s].
  double speed_of(const RotatingLoad& set) const {
    CircularShaft shaft = shaft_;
    if (set.slenderness > 0) shaft.radius = set.slenderness * length_;
    return set.a * std::numbers::pi / length_ * std::sqrt(shaft.section().stiffness.EI / shaft.section().rhoA);
  }
  double length() const { return length_; }

 private:
  CircularShaft shaft_;
  double length_, spin_, deflection_;
};

std::string key_of(const RotatingLoad& set) { return set.a < 1 ? "slow" : "fast"; }

class Report {
 public:
  explicit Report(const StudyContext& context)
      : context_(context), exact_(reference("rotating_load.json")), paper_(reference("vlbse_2017_rotating_load.json")) {
    const int steps = context.config.at("steps");
    for (const Json& set : context.config.at("sets")) {
      const RotatingLoad load{set.at("a"), set.at("k_omega")};
      for (const int n : context.config.at("elements").get<std::vector<int>>()) cases_.push_back({load, n, steps});
      cases_.push_back({load, 4, 2 * steps});  // what the time steps leave
    }
  }

  StudyReport operator()() {
    const Shaft shaft(context_.config.at("shaft"));
    outcomes_ = context_.sweep(
        cases_, [&](const Case& run) { return shaft.history(run); },
        [](const Case& run) { return run.elements * run.steps; });
    add_closed_form();
    add_errors();
    add_curves();
    add_model_error(shaft);
    const std::string folder = context_.folder.string();
    for (const auto& [first, set] : {std::pair{7, "slow"}, std::pair{9, "fast"}}) {
      const GnuplotVariables variables{{"folder", folder}, {"set", set}};
      const std::string name = set == std::string("slow") ? "(a = 0.5, k_omega = 1)" : "(a = 1.5, k_omega = 0.5)";
      report_.figures.push_back({"figure" + std::to_string(first),
                                 "Configurations of the shaft and their projections " + name, "configurations.gp",
                                 variables});
      report_.figures.push_back({"figure" + std::to_string(first + 1),
                                 "Deflections of the loaded point and of the middle " + name, "deflections.gp",
                                 variables});
    }
    report_.figures.push_back(
        {"errors", "Largest errors against the number of elements", "errors.gp", {{"folder", folder}}});
    report_.figures.push_back(
        {"model", "What rotary inertia and spin change, against the thickness", "model.gp", {{"folder", folder}}});
    return std::move(report_);
  }

 private:
  Json reference(const char* name) const {
    return parse_json(read_text(context_.folder.parent_path().parent_path() / "reference" / name));
  }

  /// The rows of the reference of a set: z/l, then the four quantities.
  const Json& rows_of(const RotatingLoad& set) const {
    for (const Json& entry : exact_.at("sets")) {
      if (entry.at("a") == set.a && entry.at("k_omega") == set.k_omega) return entry.at("rows");
    }
    throw InvalidInput("/sets", std::to_string(set.a), "a set that the reference holds");
  }

  /// The closed form that draws the configurations, against the reference.
  void add_closed_form() {
    double largest = 0;
    for (const Case& run : cases_) {
      if (run.elements != 4 || run.steps != cases_.front().steps) continue;
      for (const Json& row : rows_of(run.set)) {
        const double z = row[0];
        const auto load = closed_form(run.set, z, z), middle = closed_form(run.set, z, 0.5);
        const std::array<double, 4> values{load.real(), load.imag(), middle.real(), middle.imag()};
        for (std::size_t q = 0; q < 4; ++q) largest = std::max(largest, std::abs(values[q] - row[q + 1].get<double>()));
      }
    }
    report_.measured["closed_form_against_reference"] = largest;
  }

  void add_errors() {
    Table table{.name = "errors",
                .caption =
                    "Largest errors of the deflections over P l^3/(48 EJ), where the load is then, and what the "
                    "paper's text says of its four elements",
                .columns = {"set", "quantity", "elements", "error", "z_over_l", "paper_error", "paper_z_over_l"}};
    std::map<std::string, std::array<std::vector<double>, 2>> levels;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const Case& run = cases_[i];
      const bool halved = run.steps != cases_.front().steps;
      StudyCase item{
          .options = {{"a", run.set.a}, {"k_omega", run.set.k_omega}, {"elements", run.elements}, {"steps", run.steps}},
          .results = {},
          .failure = outcomes_[i].failure};
      if (outcomes_[i]) {
        const Json& exact = rows_of(run.set);
        double largest = 0;
        for (std::size_t q = 0; q < quantities.size(); ++q) {
          double worst = 0, where = 0;
          for (std::size_t k = 0; k < exact.size(); ++k) {
            const double error = outcomes_[i]->at.at(k)[q] - exact[k][q + 1].get<double>();
            if (std::abs(error) <= std::abs(worst)) continue;
            worst = error;
            where = exact[k][0];
          }
          item.results[quantities[q]] = worst;
          largest = std::max(largest, std::abs(worst));
          if (halved) continue;
          Json paper_error, paper_where;
          for (const Json& row : paper_.at("rows")) {
            if (run.elements != 4 || row[0] != run.set.a || row[2] != quantities[q]) continue;
            paper_error = row[3];
            paper_where = row[4];
          }
          table.rows.push_back({key_of(run.set), quantities[q], run.elements, worst, where, paper_error, paper_where});
        }
        const std::string key = key_of(run.set);
        if (halved) {
          report_.measured["steps_" + key] = difference(i);
        } else {
          report_.measured["error_" + key + "_n" + std::to_string(run.elements)] = largest;
          levels[key][0].push_back(run.elements);
          levels[key][1].push_back(largest);
        }
      }
      report_.cases.push_back(std::move(item));
    }
    for (const auto& [key, fit] : levels) {
      const OrderFit found = fit_order("error_" + key, fit[0], fit[1], {.floor = report_.measured["steps_" + key]});
      if (!found.pairwise_orders.empty()) {
        report_.measured["least_pair_" + key] = *std::ranges::min_element(found.pairwise_orders);
      }
      report_.fits.push_back(found);
    }
    report_.tables.push_back(std::move(table));
  }

  /// By how much four elements with half the step, case `i`, differ from those with the whole.
  double difference(std::size_t i) const {
    for (std::size_t j = 0; j < cases_.size(); ++j) {
      if (j == i || !outcomes_[j] || cases_[j].set.a != cases_[i].set.a || cases_[j].elements != cases_[i].elements)
        continue;
      double largest = 0;
      for (std::size_t k = 0; k < outcomes_[i]->at.size(); ++k) {
        for (std::size_t q = 0; q < 4; ++q) {
          largest = std::max(largest, std::abs(outcomes_[i]->at[k][q] - outcomes_[j]->at[k][q]));
        }
      }
      return largest;
    }
    return std::nan("");
  }

  /// What Euler and Bernoulli's beam leaves out, by the closed forms, and how near elements with rotary inertia come to
  /// the closed form with it.
  void add_model_error(const Shaft& shaft) {
    const Json& sweep = context_.config.at("rotary");
    std::vector<Case> runs;
    for (const double slenderness : sweep.at("radius_over_length").get<std::vector<double>>()) {
      for (const double spin : sweep.at("spin").get<std::vector<double>>()) {
        RotatingLoad set{sweep.at("a"), sweep.at("k_omega"), slenderness};
        set.spin = spin * shaft.length() / shaft.speed_of(set);
        runs.push_back({set, sweep.at("elements"), context_.config.at("steps"), spin});
      }
    }
    const auto found = context_.sweep(
        runs, [&](const Case& run) { return shaft.history(run); }, [](const Case& run) { return run.steps; });
    Table table{.name = "model",
                .caption =
                    "Largest change of the deflections over P l^3/(48 EJ) by rotary inertia and spin [rad/s], and "
                    "largest error of elements that have them",
                .columns = {"radius_over_length", "spin", "change", "error"}};
    double largest = 0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const Case& run = runs[i];
      StudyCase item{.options = {{"group", "rotary"},
                                 {"radius_over_length", run.set.slenderness},
                                 {"spin", run.spin},
                                 {"elements", run.elements}},
                     .results = {},
                     .failure = found[i].failure};
      if (found[i]) {
        double change = 0, error = 0;
        for (std::size_t k = 0; k < found[i]->at.size(); ++k) {
          const double z = static_cast<double>(k + 1) / samples;
          const std::array<double, 2> places{z, 0.5};
          for (std::size_t place = 0; place < 2; ++place) {
            const auto exact = closed_form(run.set, z, places[place]);
            const RotatingLoad slender{run.set.a, run.set.k_omega};
            const auto without = closed_form(slender, z, places[place]);
            const auto& at = found[i]->at[k];
            const std::complex<double> ours(at[2 * place], at[2 * place + 1]);
            for (const auto& [u, largest_of] : {std::pair{without - exact, &change}, std::pair{ours - exact, &error}}) {
              *largest_of = std::max({*largest_of, std::abs(u.real()), std::abs(u.imag())});
            }
          }
        }
        item.results = {{"change", change}, {"error", error}};
        table.rows.push_back({run.set.slenderness, run.spin, change, error});
        largest = std::max(largest, error);
        report_.measured["rotary_change_" + number_text(run.set.slenderness) + "_" + number_text(run.spin)] = change;
      }
      report_.cases.push_back(std::move(item));
    }
    report_.measured["rotary_error"] = largest;
    report_.tables.push_back(std::move(table));
  }

  /// Four elements, as in the paper, beside the closed form.
  void add_curves() {
    Table deflections{.name = "deflections",
                      .caption = "Deflections of four elements against the position of the load, and the closed form",
                      .columns = {"set", "z_over_l"},
                      .curve = true};
    for (const char* quantity : quantities) deflections.columns.emplace_back(quantity);
    for (const char* quantity : quantities) deflections.columns.push_back(std::string("exact_") + quantity);
    Table shapes{.name = "shapes",
                 .caption = "Configurations of four elements at each quarter of the way, and the closed form",
                 .columns = {"set", "quarter", "z_over_l", "U1", "U2", "exact_U1", "exact_U2"},
                 .curve = true};
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const Case& run = cases_[i];
      if (run.elements != 4 || run.steps != cases_.front().steps || !outcomes_[i]) continue;
      const Json& exact = rows_of(run.set);
      for (std::size_t k = 0; k < exact.size(); ++k) {
        std::vector<Json> row{key_of(run.set), exact[k][0]};
        for (const double u : outcomes_[i]->at.at(k)) row.emplace_back(u);
        for (std::size_t q = 1; q <= 4; ++q) row.push_back(exact[k][q]);
        deflections.rows.push_back(std::move(row));
      }
      for (std::size_t quarter = 0; quarter < 4; ++quarter) {
        for (const auto& [z, u1, u2] : outcomes_[i]->shapes[quarter]) {
          const auto u = closed_form(run.set, static_cast<double>(quarter + 1) / 4, z);
          shapes.rows.push_back({key_of(run.set), quarter + 1, z, u1, u2, u.real(), u.imag()});
        }
      }
    }
    report_.tables.push_back(std::move(deflections));
    report_.tables.push_back(std::move(shapes));
  }

  const StudyContext& context_;
  Json exact_, paper_;
  std::vector<Case> cases_;
  std::vector<Outcome<History>> outcomes_;
  StudyReport report_;
};

StudyReport run(const StudyContext& context) { return Report(context)(); }

}  // namespace
}  // namespace rotating_load

Study rotating_load_study();

Study rotating_load_study() {
  return {.name = "rotating_load",
          .title = "A spinning shaft under a load that moves along it and turns about it",
          .run = rotating_load::run};
}

}  // namespace vlbeam
