// Torsional vibration of a shaft: of one at rest (the second example of the shaft element VLBSE, 2017), and of a rod
// that flows through its ends.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/files.hpp"
#include "mechanics/spin/circular_shaft.hpp"
#include "studies/torsion/angle_flow.hpp"

namespace vlbeam {
namespace torsion {
namespace {

/// An eigenvalue of a chain of 64 elements, whose largest is some 1e4 times the first, is known to that many times eps,
/// with a factor of ten for the matrices: f_1 l/c.
constexpr double rounding_of_frequency = 1e-11;

/// Torsional frequencies [Hz] of a shaft held at the start, at the end too where `both`, that flows at `speed` [m/s].
std::vector<double> torsion(const CircularShaft& shaft, double length, int elements, bool both, double speed,
                            Formulation formulation, AngleField field = AngleField::linear) {
  return frequencies(
      eigenvalues(angle_flow(shaft.section(), shaft.spin(), length, elements, true, both, speed, formulation, field)));
}

/// What the paper's text says of Table 3, beside what holds.
struct Claim {
  int mode, elements;
  double percent;  ///< the error it states: a bound, or a value
  bool bound;
};

class Report {
 public:
  explicit Report(const StudyContext& context)
      : context_(context),
        reference_(
            parse_json(read_text(context.folder.parent_path().parent_path() / "reference" / "torsion_errors.json"))) {
    const Json& shaft = context.config.at("shaft");
    length_ = shaft.at("length");
    shaft_ = {.radius = shaft.at("radius"),
              .density = shaft.at("density"),
              .youngs_modulus = shaft.at("youngs_modulus"),
              .poisson_ratio = shaft.at("poisson_ratio")};
    shaft_.check();
    wave_speed_ = std::sqrt(shaft_.spin().GIp / shaft_.spin().rhoIp);
  }

  StudyReport operator()() {
    at_rest();
    cubic_at_rest();
    flowing();
    const GnuplotVariables variables{{"folder", context_.folder.string()}};
    report_.figures = {
        {"table3", "Error of the torsional frequencies against the number of elements", "table3.gp", variables},
        {"cubic", "Error of the torsional frequencies against the number of unknowns, linear and cubic angles",
         "cubic.gp", variables},
        {"flowing", "First torsional frequency of a rod that flows through its ends", "flowing.gp", variables}};
    return std::move(report_);
  }

 private:
  double exact(int mode) const { return (2 * mode - 1) * wave_speed_ / (4 * length_); }

  void at_rest() {
    const int most = context_.config.at("elements");
    constexpr int modes = 5;
    Table table{.name = "table3",
                .caption =
                    "Torsional frequencies [Hz] of a shaft fixed at one end and free at the other, N linear "
                    "elements, with their errors and the exact discrete errors [%]",
                .columns = {"elements", "mode", "frequency", "error", "exact_error"}};
    double largest = 0;
    std::vector<double> levels, errors;
    for (int n = 1; n <= most; ++n) {
      const auto found = torsion(shaft_, length_, n, false, 0, Formulation::variational);
      StudyCase item{.options = {{"group", "at rest"}, {"elements", n}}, .results = {{"frequencies", found}}};
      report_.cases.push_back(std::move(item));
      for (int mode = 1; mode <= std::min(n, modes); ++mode) {
        const double f = found.at(static_cast<std::size_t>(mode) - 1), error = 100 * (f / exact(mode) - 1);
        const double discrete =
            reference_.at("errors_percent").at(static_cast<std::size_t>(n) - 1).at(static_cast<std::size_t>(mode) - 1);
        largest = std::max(largest, std::abs(error - discrete));
        table.rows.push_back({n, mode, f, error, discrete});
        report_.measured["error_mode" + std::to_string(mode) + "_n" + std::to_string(n)] = error;
        if (mode == 1) {
          levels.push_back(n);
          errors.push_back(error);
        }
      }
    }
    report_.measured["error_against_formula"] = largest;
    report_.fits.push_back(fit_order("mode1", levels, errors, {.rule = level_rule_of(context_.config, "mode1")}));
    report_.tables.push_back(std::move(table));

    // what the text says of its Table 3
    Table claims{.name = "claims",
                 .caption = "The paper's text on its Table 3, beside the errors [%]",
                 .columns = {"mode", "elements", "paper_says", "percent", "error"}};
    const std::vector<Claim> text{{1, 4, 1, true}, {2, 9, 1, true}, {2, 10, 1, true}, {5, 10, 8.36, false}};
    for (const auto& [mode, elements, percent, bound] : text) {
      if (elements > most) continue;
      claims.rows.push_back(
          {mode, elements, bound ? "below" : "equals", percent,
           report_.measured.at("error_mode" + std::to_string(mode) + "_n" + std::to_string(elements))});
    }
    report_.tables.push_back(std::move(claims));
  }

  /// Angles with angle and twist at each node.
  void cubic_at_rest() {
    Table table{.name = "cubic",
                .caption = "Errors [%] of the torsional frequencies of the same shaft, N elements with cubic angles",
                .columns = {"elements", "unknowns", "mode", "error"}};
    std::vector<double> levels, errors;
    for (int n = 1; n <= context_.config.at("elements").get<int>(); ++n) {
      const auto found = torsion(shaft_, length_, n, false, 0, Formulation::variational, AngleField::hermite);
      for (int mode = 1; mode <= std::min(2 * n, 5); ++mode) {
        const double error = 100 * (found.at(static_cast<std::size_t>(mode) - 1) / exact(mode) - 1);
        table.rows.push_back({n, 2 * n + 1, mode, error});
        report_.measured["cubic_mode" + std::to_string(mode) + "_n" + std::to_string(n)] = error;
      }
    }
    for (const int n : context_.config.at("cubic").get<std::vector<int>>()) {
      const auto found = torsion(shaft_, length_, n, false, 0, Formulation::variational, AngleField::hermite);
      levels.push_back(n);
      errors.push_back(100 * (found.at(4) / exact(5) - 1));
    }
    report_.fits.push_back(
        fit_order("cubic_mode5", levels, errors, {.rule = level_rule_of(context_.config, "cubic_mode5")}));
    report_.tables.push_back(std::move(table));
  }

  /// Fixed at both ends: f_1 = c (1 - (v/c)^2)/(2 l).
  void flowing() {
    const Json& sweep = context_.config.at("flowing");
    Table table{.name = "flowing",
                .caption =
                    "First torsional frequency over c/l of a rod fixed at both ends, through which the rod flows at "
                    "v: with the momentum flux at the nodes (variational) and without (virtual work)",
                .columns = {"angles", "formulation", "v_over_c", "elements", "frequency", "exact"}};
    for (const auto& field : names(AngleField{})) {
      const bool cubic = field.value == AngleField::hermite;
      const std::string key = cubic ? "flowing_cubic_" : "flowing_";
      for (const auto& formulation : names(Formulation{})) {
        for (const double ratio : sweep.at("v_over_c").get<std::vector<double>>()) {
          std::vector<double> levels, errors;
          for (const int n : sweep.at("elements").get<std::vector<int>>()) {
            const auto found = torsion(shaft_, length_, n, true, ratio * wave_speed_, formulation.value, field.value);
            const double f = found.front() * length_ / wave_speed_, limit = (1 - ratio * ratio) / 2;
            table.rows.push_back({field.name, formulation.name, ratio, n, f, limit});
            report_.cases.push_back({.options = {{"group", "flowing"},
                                                 {"angles", field.name},
                                                 {"formulation", formulation.name},
                                                 {"v_over_c", ratio},
                                                 {"elements", n}},
                                     .results = {{"frequency", f}}});
            levels.push_back(n);
            errors.push_back(std::abs(f - limit));
            if (ratio == 0.5) {
              report_.measured[key + std::string(formulation.name) + "_n" + std::to_string(n)] = f;
            }
          }
          if (ratio == 0.5 && formulation.value == Formulation::variational) {
            const std::string name = cubic ? "flowing_cubic" : "flowing";
            report_.fits.push_back(fit_order(
                name, levels, errors, {.floor = rounding_of_frequency, .rule = level_rule_of(context_.config, name)}));
          }
        }
      }
    }
    report_.tables.push_back(std::move(table));
  }

  const StudyContext& context_;
  Json reference_;
  CircularShaft shaft_;
  double length_ = 1, wave_speed_ = 1;
  StudyReport report_;
};

StudyReport run(const StudyContext& context) { return Report(context)(); }

}  // namespace
}  // namespace torsion

Study torsion_study();

Study torsion_study() {
  return {.name = "torsion",
          .title = "Torsional vibration of a shaft at rest and of a rod that flows",
          .run = torsion::run};
}

}  // namespace vlbeam
