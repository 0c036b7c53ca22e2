#include "tools/converge.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "core/error.hpp"
#include "core/geometry/elementary.hpp"
#include "io/json.hpp"
#include "io/scene_json.hpp"
#include "scene/automatic_integrator.hpp"
#include "scene/derived.hpp"
#include "scene/names.hpp"
#include "scene/options.hpp"
#include "scene/section_data.hpp"
#include "scene/simulate.hpp"
#include "scene/validate.hpp"
#include "tools/converge_setting.hpp"
#include "tools/interrupt.hpp"
#include "tools/sought.hpp"
#include "tools/sweep.hpp"

namespace vlbeam {
namespace {

constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();  // of a value: what no refinement can show
constexpr double mesh_order = 4;       // of displacements of cubic elements; what converges faster is not trusted to
constexpr double contact_order = 1;    // of the distance at which joints touch, a share of the mesh size
constexpr double step_order = 2;       // of generalized-alpha and energy-momentum
constexpr double tolerance_order = 1;  // the global error follows the tolerance of a step
constexpr double adaptive_order = 2.0 / 3;  // that of steps h of generalized-alpha, h^2, whose own error is h^3
constexpr int most_points = 20, extra_points = 2;
constexpr double least_tolerance = 1e-13, most_steps = 1e7;
constexpr double least_small_rtol = 1e-14;  // where it is next to nothing beside the absolute tolerances
constexpr int least_elements = 2;
constexpr double perturbation = 1e-8;
constexpr double same_time = 1e-12;  // relative: rounding of a time that is asked for
constexpr double full_load = 1;      // the load factor of an equilibrium
constexpr const char* absent = "the quantity is not there at this time";
constexpr const char* no_time = "stopped: no time was left";

/// Whether joints strike each other, or several of them supports.
bool joints_strike(const Scene& scene) {
  const auto& joints = scene.sliding_joints;
  const auto strikes = [](const SlidingJointSpec& joint) { return joint.at_support != AtSupport::stop; };
  return joints.size() > 1 &&
         ((scene.contact && scene.contact->joints != AtSupport::stop) || std::ranges::any_of(joints, strikes));
}

/// From one level of time to the next finer one.
double finer(const Scene& scene, double accuracy) { return accuracy / (has_step(scene) ? 2 : 10); }
double coarser(const Scene& scene, double accuracy) { return accuracy * (has_step(scene) ? 2 : 10); }

class Converger {
 public:
  Converger(const Scene& scene, const ConvergeOptions& options)
      : options_(options), scene_(scene), sought_(scene_, options.quantity) {
    if (!in_time() && (options.at || options.horizon)) {
      throw InvalidInput(options.at ? "--at" : "--horizon", "this option", "an equilibrium has no time: leave it out");
    }
    if (!(options.error > 0) || !std::isfinite(options.error)) {
      throw InvalidInput("--error", number_text(options.error), "it must be a number > 0");
    }
    if (options.relative && options.error < rounding) too_small(options.error);
    if (options.at) {
      if (!(*options.at > 0) || *options.at > scene.duration * (1 + same_time)) {
        throw InvalidInput("--at", number_text(*options.at),
                           "it must be a time in (0, " + number_text(scene.duration) + "], the scene's duration [s]");
      }
      scene_.duration = std::min(*options.at, scene.duration);
    }
    scene_.output.configurations.clear();
    const Setting own = setting_of(scene_);
    found_.answer = found_.uncertainty = nan;  // until something is known
    found_.quantity = sought_.name();
    found_.unit = sought_.unit();
    found_.t = in_time() ? scene_.duration : full_load;
    now_ = own;
    if (in_time()) now_.accuracy = std::min(own.accuracy, has_step(scene_) ? scene_.duration / 40 : 1e-6);
  }

  Convergence operator()() {
    start();
    for (;;) {
      estimate();
      if (!found_.reason.empty() || found_.reached) break;
      if (!refine()) break;
    }
    conclude();
    return std::move(found_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// Else it is an equilibrium: mesh and quadrature alone are refined.
  bool in_time() const { return scene_.analysis == Analysis::dynamics; }

  [[noreturn]] void too_small(double error) const {
    throw InvalidInput("--error", number_text(error),
                       "no level can show it: doubles have 16 digits; ask for at least " + number_text(rounding) +
                           " of the quantity's magnitude");
  }

  bool possible(const Setting& setting) const {
    try {
      with_setting(scene_, setting);
      return setting.elements >= least_elements;
    } catch (const InvalidInput&) {
      return false;
    }
  }

  ConvergeLevel run(const Setting& setting, Refined refined) const {
    ConvergeLevel level{setting, refined, "", nan, {}, 0, 0, 0};
    const Scene scene = with_setting(scene_, setting);
    const RunResult result = simulate(scene, [this](double) { return !interrupted() && !late(); });
    const std::size_t evaluations = in_time() ? result.solver.rhs_evaluations : result.solver.newton.iterations;
    level.work = static_cast<double>(evaluations) * setting.elements * setting.points;
    level.events = result.events.size();
    level.series = sought_.values(result);
    if (result.status == RunStatus::failed) {
      level.failure = result.failure;
    } else if (result.status == RunStatus::interrupted) {
      level.failure = interrupted() ? "interrupted" : no_time;
    } else {
      level.value = level.series.empty() ? nan : level.series.back();
      if (!std::isfinite(level.value)) level.failure = absent;
    }
    return level;
  }

  /// Runs those of the settings that were not run yet.
  void ensure(const std::vector<Setting>& settings, Refined refined) {
    std::vector<Setting> missing;
    for (const Setting& setting : settings) {
      const bool new_one = std::ranges::find(missing, setting) == missing.end();
      if (at(setting) == nullptr && new_one && possible(setting)) missing.push_back(setting);
    }
    if (missing.empty()) return;
    const auto outcomes = sweep(
        "converge", missing, options_.jobs, [&](const Setting& setting) { return run(setting, refined); },
        [&](const Setting& setting) {
          return setting.elements * setting.points / (has_step(scene_) ? setting.accuracy : 1);
        });
    for (std::size_t i = 0; i < missing.size(); ++i) {
      if (outcomes[i]) {
        found_.levels.push_back(*outcomes[i]);
      } else {
        found_.levels.push_back({missing[i], refined, outcomes[i].failure, nan, {}, 0, 0, 0});
      }
      found_.levels.back().seconds = outcomes[i].seconds;
      work_ += found_.levels.back().work;
    }
    if (options_.on_level) {
      for (std::size_t i = found_.levels.size() - missing.size(); i < found_.levels.size(); ++i) {
        options_.on_level(found_.levels[i]);
      }
    }
    const auto stopped = [](const ConvergeLevel& level) { return level.failure == no_time; };
    if (interrupted()) {
      found_.reason = "interrupted";
    } else if (!found_.reached && std::any_of(found_.levels.begin(), found_.levels.end(), stopped)) {
      found_.reason = "the " + number_text(options_.seconds) + " s allowed are used up";
    }
  }

  /// No time is left.
  bool late() const { return std::chrono::duration<double>(Clock::now() - started_).count() >= options_.seconds; }

  const ConvergeLevel* at(const Setting& setting) const {
    const auto level = std::ranges::find(found_.levels, setting, &ConvergeLevel::setting);
    return level == found_.levels.end() ? nullptr : &*level;
  }

  /// Settings from the current one towards coarser ones, coarse to fine, those that give a value.
  std::vector<Setting> ladder(Refined refined, const Setting& from) const {
    std::vector<Setting> list{from};
    for (Setting next = from; list.size() < 6;) {
      if (refined == Refined::mesh) {
        if (next.elements % 2 != 0) break;
        next.elements /= 2;
      } else {
        next.accuracy = coarser(scene_, next.accuracy);
        if (next.accuracy > (has_step(scene_) ? scene_.duration / 10 : 1e-2)) break;
      }
      if (!possible(next)) break;
      list.push_back(next);
    }
    std::ranges::reverse(list);
    return list;
  }

  static std::vector<Setting> last(const std::vector<Setting>& list, std::size_t count) {
    return {list.end() - static_cast<std::ptrdiff_t>(std::min(count, list.size())), list.end()};
  }

  double level_of(Refined refined, const Setting& setting) const {
    return refined == Refined::mesh ? setting.elements : refined == Refined::time ? setting.accuracy : setting.points;
  }

  double expected_order(Refined refined) const {
    if (refined == Refined::mesh) return joints_strike(scene_) ? contact_order : mesh_order;
    if (refined == Refined::quadrature) return 0;
    if (!has_step(scene_)) return scene_.integrator.adaptive ? adaptive_order : tolerance_order;
    return scene_.integrator.type == IntegratorType::adams_bashforth_moulton ? 0 : step_order;
  }

  /// Of the levels of a ladder that were run: of the value, or of sample i.
  GridConvergence estimate_of(Refined refined, const std::vector<Setting>& list, double floor,
                              std::optional<std::size_t> sample = {}) const {
    std::vector<double> levels, values;
    for (const Setting& setting : list) {
      const ConvergeLevel* level = at(setting);
      if (level == nullptr || (!level->failure.empty() && &setting != &list.back())) continue;
      levels.push_back(level_of(refined, setting));
      values.push_back(!sample ? level->value : *sample < level->series.size() ? level->series[*sample] : nan);
    }
    return grid_convergence(sought_.name(), levels, values,
                            {.expected_order = expected_order(refined), .floor = floor});
  }

  /// Where time and quadrature are judged: the second finest mesh, whose runs cost less.
  Setting judged() const {
    Setting half = now_;
    half.elements /= 2;
    return now_.elements % 2 == 0 && at(half) != nullptr && at(half)->failure.empty() ? half : now_;
  }

  std::vector<Setting> quadrature_levels() const {
    std::vector<Setting> list{judged()};
    for (int i = 1; i <= 2; ++i) {
      list.push_back(list.front());
      list.back().points += i * extra_points;
    }
    return list;
  }

  double part(Refined refined) const {
    const auto& estimate = found_.parts[static_cast<std::size_t>(refined)];
    return estimate ? estimate->uncertainty : 0;
  }

  /// The first three meshes; the wanted error in the quantity's unit.
  void start() {
    while (ladder(Refined::mesh, now_).size() < 3) {
      Setting finer_mesh = now_;
      finer_mesh.elements *= 2;
      if (finer_mesh.elements > options_.most_elements || !possible(finer_mesh)) break;
      now_ = finer_mesh;
    }
    ensure(last(ladder(Refined::mesh, now_), 3), Refined::mesh);
    const ConvergeLevel* level = at(now_);
    found_.error = options_.error;
    if (level == nullptr) return;
    if (level->failure == absent) {
      const auto there = std::ranges::count_if(level->series, [](double value) { return std::isfinite(value); });
      if (there == 0) throw InvalidInput("--quantity", "\"" + options_.quantity + "\"", "this scene never has it");
      throw InvalidInput(
          "--at", number_text(scene_.duration),
          "the quantity is there at the first " + std::to_string(there) + " samples only: ask for an earlier time");
    }
    if (!level->failure.empty()) return;
    if (options_.relative) found_.error = options_.error * std::abs(level->value);
    if (!(found_.error > 0)) {
      throw InvalidInput("--relative", "this option", "the quantity is 0 at that time: give an absolute error");
    }
    if (found_.error < rounding * std::abs(level->value)) too_small(options_.error);
  }

  void estimate() {
    const auto meshes = ladder(Refined::mesh, now_);
    ensure(last(meshes, 3), Refined::mesh);
    if (!found_.reason.empty()) return;
    const double known_to = rounding * std::abs(at(now_)->value);
    if (in_time()) {
      const auto times = ladder(Refined::time, judged());
      ensure(last(times, 3), Refined::time);
      if (!found_.reason.empty()) return;
      found_.parts[1] = estimate_of(Refined::time, times, known_to);
    }
    found_.parts[0] = estimate_of(Refined::mesh, meshes, std::max(known_to, 0.0));
    const double so_far = part(Refined::mesh) + part(Refined::time);
    if (so_far <= found_.error) {
      ensure(quadrature_levels(), Refined::quadrature);
      if (!found_.reason.empty()) return;
      found_.parts[2] = estimate_of(Refined::quadrature, quadrature_levels(), known_to);
    } else {
      found_.parts[2].reset();
    }
    found_.answer = at(now_)->value;
    found_.uncertainty = so_far + part(Refined::quadrature);
    found_.finest = now_;
    found_.reached = found_.parts[2] && found_.uncertainty <= found_.error;
    if (meshes_.empty() || meshes_.back() != now_.elements) {
      meshes_.push_back(now_.elements);
      history_.push_back(0);
    }
    history_.back() = part(Refined::mesh);
  }

  /// One step towards the wanted error, in what leaves most of it; false, and the reason, where there is none.
  bool refine() {
    const double mesh = part(Refined::mesh), time = part(Refined::time), quadrature = part(Refined::quadrature);
    Setting next = now_;
    double growth = 1;
    const bool lost = !std::isfinite(mesh) || !at(now_)->failure.empty();
    if (!lost && std::isfinite(time) && time >= std::max(mesh, quadrature)) {
      next.accuracy = finer(scene_, now_.accuracy);
      growth = has_step(scene_) ? 2 : 1.5;
      const double least = has_step(scene_)             ? scene_.duration / most_steps
                           : scene_.integrator.adaptive ? least_small_rtol
                                                        : least_tolerance;
      if (next.accuracy < least) return give_up("steps cannot be made finer: rounding is next");
    } else if (!lost && quadrature > mesh) {
      next.points += extra_points;
      if (next.points > most_points) return give_up("more quadrature points change the answer still");
    } else {
      if (fails_again()) return give_up("finer meshes fail, too: " + at(now_)->failure);
      next.elements *= 2;
      growth = growth_of_mesh();
      if (next.elements > options_.most_elements) {
        return give_up("the finest mesh allowed has " + std::to_string(options_.most_elements) + " elements");
      }
      if (diverges())
        return give_up("two finer meshes have brought it no nearer: this motion does not converge at this time");
    }
    if (!possible(next)) return give_up("the scene cannot be modelled any finer");
    const ConvergeLevel* finest = at(now_);
    const double next_work = growth * finest->work;
    // The finer setting costs its own run, and about as much again for what is judged on the mesh before it.
    if (finest->work > 0 && work_ + 2 * next_work > options_.budget * next_work) {
      return give_up("all runs together would cost more than " + number_text(options_.budget) + " of the finest");
    }
    now_ = next;
    return true;
  }

  double growth_of_mesh() const {
    Setting half = now_;
    half.elements /= 2;
    const ConvergeLevel *finest = at(now_), *before = at(half);
    return before != nullptr && before->work > 0 && finest->work > before->work ? finest->work / before->work : 2;
  }

  /// Whether the finest mesh gives no value, nor the one before.
  bool fails_again() const {
    Setting half = now_;
    half.elements /= 2;
    const ConvergeLevel* before = at(half);
    return !at(now_)->failure.empty() && (before == nullptr || !before->failure.empty());
  }

  /// Whether the last two refinements of the mesh gained nothing, beyond where that is common.
  bool diverges() const {
    const std::size_t n = history_.size();
    return n >= 4 && history_[n - 1] > 0.7 * history_[n - 2] && history_[n - 2] > 0.7 * history_[n - 3];
  }

  bool give_up(const std::string& why) {
    found_.reason = why;
    return false;
  }

  void conclude() {
    const ConvergeLevel* finest = at(found_.finest);
    if (finest == nullptr) finest = at(now_);
    if (finest != nullptr && !finest->failure.empty() && found_.reason != "interrupted") {
      if (found_.reason.empty()) found_.reason = finest->failure;
      found_.answer = found_.uncertainty = nan;
    }
    const bool nothing_known = late() && found_.finest.elements == 0;
    if (finest == nullptr) return;
    if (!interrupted() && !nothing_known) {
      if (in_time()) predict(*finest);
      if (options_.horizon && !late()) look_for_horizon(*finest);
      if (found_.reached) choose_cheapest();
    }
    found_.cost = finest->work > 0 ? work_ / finest->work : nan;
  }

  /// Until which sample mesh and time together keep the error wanted.
  void predict(const ConvergeLevel& finest) {
    const auto meshes = ladder(Refined::mesh, found_.finest), times = ladder(Refined::time, judged());
    found_.predictable_until = 0;
    const std::size_t n = finest.series.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (!std::isfinite(finest.series[i])) break;
      const double floor = rounding * std::abs(finest.series[i]);
      const double sum = estimate_of(Refined::mesh, meshes, floor, i).uncertainty +
                         estimate_of(Refined::time, times, floor, i).uncertainty;
      if (!(sum <= found_.error)) break;
      found_.predictable_until = std::min(scene_.duration, static_cast<double>(i) * scene_.output.interval);
    }
    if (found_.reached) found_.predictable_until = scene_.duration;
  }

  void look_for_horizon(const ConvergeLevel& finest) {
    Scene scene = with_setting(scene_, found_.finest);
    scene.beam = with_mass(scene.beam, 1 + perturbation);
    const RunResult result = simulate(scene, [this](double) { return !interrupted() && !late(); });
    if (result.status == RunStatus::interrupted) return;
    work_ += finest.work;
    const std::vector<double> disturbed = sought_.values(result);
    double until = 0;
    for (std::size_t i = 0; i < std::min(disturbed.size(), finest.series.size()); ++i) {
      const double gap = std::abs(disturbed[i] - finest.series[i]);
      if (!(gap <= found_.error)) break;
      until = result.samples[i].t;
    }
    found_.horizon = until;
  }

  bool keeps(const ConvergeLevel& level) const {
    return level.failure.empty() && std::abs(level.value - found_.answer) + found_.uncertainty <= found_.error;
  }

  void choose_cheapest() {
    // Beside what was run: the coarsest mesh and the coarsest time that each leave a third of the error.
    Setting guess = found_.finest;
    for (const Setting& setting : ladder(Refined::mesh, found_.finest)) {
      const ConvergeLevel* level = at(setting);
      if (level == nullptr || !level->failure.empty() || std::abs(level->value - found_.answer) > found_.error / 3)
        continue;
      guess.elements = setting.elements;
      break;
    }
    const ConvergeLevel* judge = at(judged());
    for (const Setting& setting : in_time() ? ladder(Refined::time, judged()) : std::vector<Setting>()) {
      const ConvergeLevel* level = at(setting);
      if (level == nullptr || !level->failure.empty() || std::abs(level->value - judge->value) > found_.error / 3)
        continue;
      guess.accuracy = setting.accuracy;
      break;
    }
    ensure({guess}, Refined::mesh);
    const ConvergeLevel* best = nullptr;
    for (const ConvergeLevel& level : found_.levels) {
      if (keeps(level) && (best == nullptr || level.work < best->work)) best = &level;
    }
    if (best == nullptr) best = at(found_.finest);
    found_.cheapest = best->setting;
  }

  ConvergeOptions options_;
  Scene scene_;
  Sought sought_;
  Setting now_;
  Convergence found_;
  Clock::time_point started_ = Clock::now();
  double work_ = 0;
  std::vector<int> meshes_;      ///< the finest ones, as they were refined
  std::vector<double> history_;  ///< of the mesh's uncertainty on each
};

}  // namespace

Convergence converge(const Scene& scene, const ConvergeOptions& options) {
  const Scene start = to_converge(scene);
  return Converger(start, options)();
}

}  // namespace vlbeam
