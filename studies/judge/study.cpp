// The program beside the judge of reference/judge, another formulation that shares the energy density only: the same
// scenes on two meshes, differences beside the uncertainties of both.
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "io/quantity.hpp"
#include "io/scene_json.hpp"
#include "tools/scene_sweep.hpp"

namespace vlbeam {
namespace judge {
namespace {

/// A case on one of its meshes, by its integrator or by the looser one that shows what time leaves.
struct Item {
  std::string name;
  int elements;
  bool loose;
  Scene scene;
};

const Json& named(const Json& list, const std::string& name) {
  const auto found = std::ranges::find_if(list, [&](const Json& item) { return item.at("case") == name; });
  if (found == list.end()) throw InvalidInput("/cases", name, "a case of reference/judge/cases.json");
  return *found;
}

class Report {
 public:
  explicit Report(const StudyContext& context) : context_(context) {
    const auto folder = context.folder.parent_path().parent_path() / "reference" / "judge";
    const Json asked = read_json(folder / "cases.json"), answers = read_json(folder / "judge.json");
    for (const auto& [name, how] : context.config.at("cases").items()) {
      judged_[name] = named(answers.at("cases"), name);
      names_.push_back(name);
      const auto meshes = how.at("elements").get<std::vector<int>>();
      const Json& scene = named(asked.at("cases"), name).at("scene");
      items_.push_back(item(name, scene, how, meshes[0], true));
      for (const int n : meshes) items_.push_back(item(name, scene, how, n, false));
    }
  }

  StudyReport operator()() {
    const auto outcomes = context_.sweep(
        items_, [](const Item& one) { return StudyContext::simulate_to_the_end(one.scene); },
        [](const Item& one) { return one.elements * one.elements; });
    for (std::size_t i = 0; i < items_.size(); i += 3) {
      const std::string& name = items_[i].name;
      for (std::size_t k = i; k < i + 3; ++k) {
        Json results = Json::object();
        if (outcomes[k]) results["steps"] = outcomes[k]->solver.steps;
        report_.cases.push_back(
            {.options = {{"case", name}, {"elements", items_[k].elements}, {"loose", items_[k].loose}},
             .results = results,
             .failure = outcomes[k] ? "" : outcomes[k].failure});
      }
      if (outcomes[i] && outcomes[i + 1] && outcomes[i + 2]) {
        compare(name, items_[i + 2].scene, *outcomes[i], *outcomes[i + 1], *outcomes[i + 2]);
      }
    }
    std::string cases;
    for (const std::string& name : names_) cases += (cases.empty() ? "" : " ") + name;
    report_.measured["cases"] = static_cast<double>(names_.size());
    report_.tables = {std::move(verdicts_), std::move(times_)};
    report_.figures = {{.name = "differences",
                        .caption = "Difference of the program from the judge, and the sum of their uncertainties",
                        .script = "differences.gp",
                        .variables = {{"folder", context_.folder.string()}, {"cases", cases}}}};
    return std::move(report_);
  }

 private:
  static Item item(const std::string& name, Json scene, const Json& how, int elements, bool loose) {
    scene["beam"]["elements"] = elements;
    scene["beam"]["strain_law"] = "green";  // the judge's
    for (Json& mass : scene.contains("point_masses") ? scene["point_masses"] : empty()) mass["node"] = elements;
    if (how.contains("set")) {
      for (const auto& [pointer, value] : how.at("set").items()) assign_option(scene, pointer, value);
    }
    scene["integrator"] = how.at(loose ? "loose" : "integrator");
    scene["output"] = {{"interval", how.at("interval")}};
    return {name, elements, loose, scene_from_json(scene)};
  }
  static Json& empty() {
    static Json none = Json::array();
    return none;
  }

  static const Sample& at(const RunResult& run, double t) {
    return *std::ranges::min_element(run.samples, {}, [t](const Sample& s) { return std::abs(s.t - t); });
  }

  /// What mesh and time leave up to each time: of all places together and of all energies together, for the errors of
  /// one of them change their sign. A mesh leaves d/(2^order - 1), d its difference from one half as fine. The order is
  /// 2 (4 in theory, without events), or 1 where the start is sudden or the stretch jumps in a sleeve.
  struct Left {
    std::vector<double> by_mesh, by_time;
  };
  struct Compared {
    std::string name;
    Quantity ours;
    const Json* known;
  };

  static Left left(const std::vector<Compared>& quantities, const std::vector<double>& t, const RunResult& loose,
                   const RunResult& coarse, const RunResult& fine, int order) {
    Left all{std::vector<double>(t.size()), std::vector<double>(t.size())};
    double by_mesh = 0, by_time = 0;
    for (std::size_t k = 0; k < t.size(); ++k) {
      for (const Compared& q : quantities) {
        const double before = q.ours.of(at(coarse, t[k]));
        by_mesh = std::max(by_mesh, std::abs(q.ours.of(at(fine, t[k])) - before) / (order == 1 ? 1 : 3));
        by_time = std::max(by_time, std::abs(q.ours.of(at(loose, t[k])) - before));
      }
      all.by_mesh[k] = by_mesh;
      all.by_time[k] = by_time;
    }
    return all;
  }

  void compare(const std::string& name, const Scene& scene, const RunResult& loose, const RunResult& coarse,
               const RunResult& fine) {
    const Json& judged = judged_.at(name);
    const auto t = judged.at("t").get<std::vector<double>>();
    const double length = judged.at("length");
    std::vector<double> off(t.size(), 0), sums(t.size(), 0), of_judge(t.size(), 0);
    for (const bool energies : {false, true}) {
      std::vector<Compared> quantities;
      for (const auto& [quantity, known] : judged.at("quantities").items()) {
        if (quantity.starts_with("start")) continue;  // samples have the other end only
        if (quantity.starts_with("energy") == energies) {
          quantities.push_back({quantity, find_quantity(scene, quantity), &known});
        }
      }
      const Left all = left(quantities, t, loose, coarse, fine, context_.config.at("cases").at(name).at("order"));
      double worst_ratio = 0;
      for (const Compared& q : quantities) {
        for (std::size_t k = 0; k < t.size(); ++k) {
          const double value = q.ours.of(at(fine, t[k]));
          const double judge = q.known->at("value").at(k), judges = q.known->at("uncertainty").at(k);
          const double difference = value - judge, sum = all.by_mesh[k] + all.by_time[k] + judges;
          const double ratio = std::abs(difference) / sum;
          worst_ratio = std::max(worst_ratio, ratio);
          if (!energies) {
            off[k] = std::max(off[k], std::abs(difference));
            sums[k] = std::max(sums[k], sum);
            of_judge[k] = std::max(of_judge[k], judges);
          }
          if (k + 1 < t.size()) continue;
          verdicts_.rows.push_back({name, q.name, t[k], judge, judges, q.ours.of(at(coarse, t[k])), value,
                                    all.by_mesh[k], all.by_time[k], difference, ratio,
                                    ratio <= 1 ? "agree" : "differ"});
        }
      }
      report_.measured[name + (energies ? "/energy_difference_over_uncertainties" : "/difference_over_uncertainties")] =
          worst_ratio;
    }
    for (std::size_t k = 0; k < t.size(); ++k) {
      times_.rows.push_back({name, t[k], off[k] / length, sums[k] / length, of_judge[k] / length});
    }
    report_.measured[name + "/difference"] = *std::ranges::max_element(off) / length;
    report_.measured[name + "/uncertainties"] = *std::ranges::max_element(sums) / length;
    report_.measured[name + "/judge_uncertainty"] = *std::ranges::max_element(of_judge) / length;
  }

  const StudyContext& context_;
  std::map<std::string, Json> judged_;
  std::vector<std::string> names_;
  std::vector<Item> items_;
  Table verdicts_{.name = "verdicts",
                  .caption =
                      "Program and judge at the last time of each case [m, J]: the judge with its uncertainty, "
                      "two meshes, what mesh and time leave, the difference, and that over the sum of all "
                      "uncertainties",
                  .columns = {"case", "quantity", "t", "judge", "judge_uncertainty", "coarse", "fine", "by_mesh",
                              "by_time", "difference", "ratio", "verdict"}};
  Table times_{.name = "times",
               .caption =
                   "Largest difference of positions over the length, the sum of both uncertainties, and the "
                   "judge's",
               .columns = {"case", "t", "difference", "uncertainties", "judge_uncertainty"},
               .curve = true};
  StudyReport report_;
};

StudyReport run(const StudyContext& context) { return Report(context)(); }

}  // namespace
}  // namespace judge

Study judge_study();

Study judge_study() {
  return {.name = "judge", .title = "Does another formulation find the same motions?", .run = judge::run};
}

}  // namespace vlbeam
