// How far runs are off that nobody has tuned, and how far they say they are: scenes drawn from families whose answers
// are known (reference/trust.py).
#include "studies/harness/study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "core/geometry/elementary.hpp"
#include "io/files.hpp"
#include "io/json.hpp"
#include "io/quantity.hpp"
#include "io/scene_json.hpp"
#include "scene/derived.hpp"
#include "tools/checked_run.hpp"
#include "tools/converge_setting.hpp"
#include "tools/run_track.hpp"

namespace vlbeam {
namespace trust {
namespace {

constexpr double told_share = 1.5;        // of the told error: the true one may be as many times larger
constexpr double told_most = 20;          // times the true error: beyond, what is told is of little use
constexpr double silent_share = 0.01;     // of the motion: a larger error must not go without a warning
constexpr double finer_tolerance = 1e-3;  // of the run that the error in time is measured against
constexpr double rounding = 1e-11;        // of the beam's length
constexpr double same_time = 1e-9;
const std::map<std::string, std::string> other_than_places{{"axial_force.max", "largest axial force"}};

struct TrustCase {
  Json reference;
  Scene scene;
  bool finely;  ///< its error in time is measured, by a fine run
};

/// What became of one scene.
struct Found {
  std::string status, failure, why_not_told;
  std::string warnings;
  double true_error = 0, told_time = 0, told_mesh = 0, allowed = 0, motion = 0, work = 1;
  double true_time = std::nan("");  ///< where there was a fine run
  bool told = false, warned = false, late = false;
  int repeats = 0;
  std::size_t steps = 0;

  double told_error() const { return told_time + told_mesh; }
};

/// Distance of a run from the answers of its scene, the largest over the times that have one.
double true_error(const TrustCase& item, const RunResult& result) {
  const Json& reference = item.reference;
  const auto times = reference.at("t").get<std::vector<double>>();
  std::vector<double> squares(times.size(), 0.0);
  for (const auto& [name, values] : reference.at("values").items()) {
    const Quantity quantity = find_quantity(item.scene, name);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const bool in_time = item.scene.analysis == Analysis::dynamics;
      const auto sample =
          in_time ? std::ranges::find_if(result.samples,
                                         [t = times[i]](const Sample& s) { return std::abs(s.t - t) <= same_time * t; })
                  : std::prev(result.samples.end());
      const bool there = sample != result.samples.end();
      const double difference = there ? quantity.of(*sample) - values.at(i).get<double>() : std::nan("");
      squares[i] += difference * difference;
    }
  }
  double largest = 0;
  for (const double square : squares) {
    if (!std::isfinite(square)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, std::sqrt(square));
  }
  return largest;
}

/// Distance of the places of two runs, and of what the scene's answer is of, the largest over all samples.
double between(const TrustCase& item, const RunResult& a, const RunResult& b) {
  const Track here = track_of(item.scene, a, {}, {}), there = track_of(item.scene, b, {}, {});
  double largest = 0;
  for (std::size_t i = 0; i < here.rows.size(); ++i) {
    if (here.rows[i].kind != TrackKind::place) continue;
    const auto distances = largest_distance(here.rows[i], there.rows[i]);
    if (!distances.empty()) largest = std::max(largest, distances.back());
  }
  std::vector<Quantity> answered;
  for (const auto& entry : item.reference.at("values").items()) {
    answered.push_back(find_quantity(item.scene, entry.key()));
  }
  for (std::size_t i = 0; i < std::min(a.samples.size(), b.samples.size()); ++i) {
    if (std::abs(a.samples[i].t - b.samples[i].t) > same_time * a.samples[i].t) break;
    double square = 0;
    for (const Quantity& quantity : answered) {
      const double difference = quantity.of(a.samples[i]) - quantity.of(b.samples[i]);
      square += difference * difference;
    }
    if (std::isfinite(square)) largest = std::max(largest, std::sqrt(square));
  }
  return largest;
}

bool ended(const RunResult& result) {
  return result.status == RunStatus::completed || result.status == RunStatus::separated;
}

Found judge(const TrustCase& item) {
  Found found;
  const RunResult result =
      checked_run(item.scene, StudyContext::until_interrupted(), {.shape = {}, .event_shapes = false}, 1, &found.work);
  found.status = to_string(result.status);
  found.failure = result.failure;
  found.steps = result.solver.steps;
  for (const Warning& warning : result.warnings) {
    found.warnings += (found.warnings.empty() ? "" : " ") + std::string(to_string(warning.kind));
    found.late = found.late || warning.kind == WarningKind::error_in_time;
    found.warned =
        found.warned || warning.kind == WarningKind::error_in_time || warning.kind == WarningKind::error_of_mesh;
  }
  if (!ended(result)) return found;
  found.true_error = true_error(item, result);
  const RunError& error = *result.error;
  const std::string first = item.reference.at("values").items().begin().key();
  const auto other = other_than_places.find(first);
  std::optional<double> time = error.time, mesh = error.mesh;
  found.motion = error.motion;
  if (other != other_than_places.end()) {
    const auto row = std::ranges::find(error.quantities, other->second, &QuantityError::quantity);
    time = row->time;
    mesh = row->mesh;
    found.motion = std::abs(item.reference.at("values").at(first).at(0).get<double>());
  }
  found.told_time = time.value_or(0);
  found.told_mesh = mesh.value_or(0);
  const bool in_time = item.scene.analysis == Analysis::dynamics;
  found.told = mesh && (time || !in_time);
  found.why_not_told = error.no_mesh + (error.no_mesh.empty() || !in_time || error.no_time.empty() ? "" : "; ") +
                       (in_time ? error.no_time : "");
  found.allowed = error.allowed;
  found.repeats = error.repeats;
  if (in_time && item.finely) {
    Scene finer = item.scene;
    finer.integrator.automatic = false;
    finer = with_tolerance(finer, finer_tolerance);
    const RunResult fine =
        simulate(finer, StudyContext::until_interrupted(), nullptr, {.shape = {}, .event_shapes = false});
    found.true_time = ended(fine) ? between(item, result, fine) : std::nan("");
  }
  return found;
}

std::vector<TrustCase> read_cases(const StudyContext& context) {
  const Json file = read_json(context.folder.parent_path().parent_path() / "reference" / "trust.json");
  const int every = context.config.at("every"), fine_every = context.config.at("fine_every"),
            first = context.config.at("first");
  std::vector<TrustCase> cases;
  int i = 0;
  for (const Json& item : file.at("cases")) {
    if (i % every == first % every) cases.push_back({item, scene_from_json(item.at("scene")), i % fine_every == first});
    ++i;
  }
  return cases;
}

/// How many of how many.
struct Share {
  int held = 0, all = 0;

  void add(bool holds) {
    held += holds ? 1 : 0;
    ++all;
  }
  double value() const { return all == 0 ? 1 : static_cast<double>(held) / all; }
};

/// What gates look at, of all scenes or of a family.
struct Judged {
  Share covered, close, in_time, loud, ran, repeated;
  double logarithms = 0;
  int worked = 0;

  void add(const TrustCase& item, const Found& found) {
    const bool done = found.status == "completed" || found.status == "separated";
    ran.add(done);
    if (!done) return;
    const double length = beam_length(item.scene),
                 unknown = item.reference.at("uncertainty").get<double>() + rounding * length;
    covered.add(found.told && told_share * found.told_error() >= found.true_error - unknown);
    if (found.true_error > unknown) close.add(found.told_error() <= told_most * found.true_error);
    loud.add(found.warned || found.true_error - unknown <= silent_share * found.motion);
    if (item.scene.analysis == Analysis::dynamics) {
      if (item.finely) in_time.add(found.late || found.true_time <= found.allowed + rounding * length);
      repeated.add(found.repeats > 0);
      logarithms += portable::log(found.work);
      ++worked;
    }
  }
  double work() const { return worked == 0 ? 1 : portable::exp(logarithms / worked); }
};

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(); }

StudyReport run(const StudyContext& context) {
  const auto cases = read_cases(context);
  const auto outcomes = context.sweep(cases, judge, [](const TrustCase& item) {
    return item.scene.beam.elements * (item.scene.analysis == Analysis::dynamics ? 100 : 1);
  });
  StudyReport report;
  Table scenes{.name = "scenes",
               .caption =
                   "Every scene by default: how far it is off [m, or N], what its answer is known to, what is told, "
                   "of the steps and of the mesh, by what places move; how far it is off in time, where a fine run "
                   "says so, and may be; how often it was run again, and what it took with its companions, over alone; "
                   "whether it keeps what the gates ask",
               .columns = {"scene", "family", "status", "steps", "true", "known_to", "told_time", "told_mesh", "motion",
                           "told_over_true", "true_time", "allowed", "repeats", "work", "warned", "covered", "close",
                           "in_time", "loud"},
               .curve = true};
  Judged all;
  std::map<std::string, Judged> families;
  std::vector<std::string> order;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string name = cases[i].reference.at("name"), family = cases[i].reference.at("family");
    if (!outcomes[i]) {
      report.cases.push_back({.options = {{"scene", name}}, .results = {}, .failure = outcomes[i].failure});
      continue;
    }
    const Found& found = *outcomes[i];
    if (!families.contains(family)) order.push_back(family);
    all.add(cases[i], found);
    Judged kept;
    kept.add(cases[i], found);
    families[family].add(cases[i], found);
    const double known_to = cases[i].reference.at("uncertainty");
    scenes.rows.push_back({name, family, found.status, found.steps, number(found.true_error), known_to, found.told_time,
                           found.told_mesh, found.motion, number(found.told_error() / found.true_error),
                           number(found.true_time), found.allowed, found.repeats, number(found.work),
                           found.warned ? 1 : 0, kept.covered.held, kept.close.held, kept.in_time.held,
                           kept.loud.held});
    report.cases.push_back({.options = {{"scene", name}},
                            .results = {{"status", found.status},
                                        {"true", number(found.true_error)},
                                        {"told", found.told_error()},
                                        {"motion", found.motion},
                                        {"warnings", found.warnings},
                                        {"not_told", found.failure.empty() ? found.why_not_told : found.failure}}});
  }
  Table table{
      .name = "families",
      .caption =
          "By family: scenes, those that ran to their end, those whose error is no more than 1.5 times what is told, "
          "those of a known error that is told within a factor of 20, those within their accuracy in time or "
          "told not to be, those that are not silently off by more than 1 % of the motion, those run again; "
          "what they took with companions over alone, geometric mean",
      .columns = {"family", "scenes", "ran", "covered", "known", "close", "in_time", "loud", "repeated", "work"}};
  const auto row = [](const std::string& name, const Judged& j) {
    return std::vector<Json>{name,         j.ran.all,      j.ran.held,  j.covered.held,  j.close.all,
                             j.close.held, j.in_time.held, j.loud.held, j.repeated.held, j.work()};
  };
  for (const std::string& family : order) table.rows.push_back(row(family, families[family]));
  table.rows.push_back(row("all", all));
  report.measured = {{"scenes", all.ran.all},
                     {"not_run", all.ran.all - all.ran.held},
                     {"covered", all.covered.value()},
                     {"close", all.close.value()},
                     {"known", all.close.all},
                     {"in_time", all.in_time.value()},
                     {"silent", all.loud.all - all.loud.held},
                     {"repeated", all.repeated.value()},
                     {"work", all.work()}};
  report.tables = {std::move(scenes), std::move(table)};
  report.figures = {{.name = "told",
                     .caption = "What runs tell of their error over what it is, against the error",
                     .script = "trust.gp",
                     .variables = {{"folder", context.folder.string()}}}};
  return report;
}

}  // namespace
}  // namespace trust

Study trust_study();

Study trust_study() {
  return {.name = "trust",
          .title = "Trust: how far default runs are off, and how far they say they are",
          .run = trust::run};
}

}  // namespace vlbeam
