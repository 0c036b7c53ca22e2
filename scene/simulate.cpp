#include "scene/simulate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/error.hpp"
#include "mechanics/flow/steady_flow.hpp"
#include "mechanics/rooms.hpp"
#include "scene/beam_record.hpp"
#include "scene/build.hpp"
#include "scene/energy_ledger.hpp"
#include "scene/extremes.hpp"
#include "scene/friction_watch.hpp"
#include "scene/initial_equilibrium.hpp"
#include "scene/model_errors.hpp"
#include "scene/plausibility.hpp"
#include "scene/run_support.hpp"
#include "scene/simulate_assembly.hpp"
#include "scene/stiffness.hpp"
#include "scene/validate.hpp"

namespace vlbeam {

namespace {

constexpr int steps_unjudged = 10;  // of a motion from rest: all energy there is may be the method's error

/// Runs one scene of a known dimension, and fills in its result.
template <int D>
class Run {
 public:
  Run(const Scene& scene, const ProgressCallback& progress, const Checkpoints* checkpoints, const RunOutput& output,
      const ChainState<D>& chain)
      : scene_(scene),
        progress_(progress),
        checkpoints_(checkpoints),
        output_(output),
        stops_(scene),
        system_(build_model<D>(scene), chain),
        friction_(system_.model()),
        record_(scene, system_, output) {
    system_.corrects = scene.integrator.type != IntegratorType::generalized_alpha;
    system_.on_sample = [this](const Eigen::VectorXd& y, double t) { sample(y, t); };
    system_.on_step = [this](double t) {
      ++steps_;
      return !progress_ || progress_(t);
    };
    system_.on_event = [this](const EventRecord<D>& record) { event(record); };
    if (scene.output.extremes) extremes_.emplace(scene);
    if (friction_.watches() || extremes_) {
      system_.on_state = [this](const Eigen::VectorXd& y, double t) {
        if (friction_.watches()) friction_.step(system_, y, t);
        if (extremes_) extremes_->add(record_.seen(y, t).sample);
      };
    }
  }

  /// Remembers what the first sample says of the equilibrium that the run starts from.
  void starts_from(const StaticSample& equilibrium) { start_ = equilibrium; }

  RunResult operator()() {
    const auto options = integration_options(scene_, system_.model().section, system_.mesh().shortest());
    const auto initial = [this]() -> Eigen::VectorXd {
      Eigen::VectorXd y = system_.release_initial_state();
      if constexpr (has_room("flow")) {
        if (scene_.flow && scene_.flow->steady) return steady_state(system_, y);
      }
      return y;
    };
    run_to_end(scene_, system_, initial, stops_, options, checkpoints_, result_);
    result_.timing.motion -= result_.timing.length_control + observing_;
    result_.solver.rhs_evaluations = system_.rhs_evaluations();
    if (friction_.watches()) result_.pressures = friction_.pressures();
    return std::move(result_);
  }

 private:
  void sample(const Eigen::VectorXd& y, double t) {
    const auto started = std::chrono::steady_clock::now();
    if (stops_.keeps_shape_at(t)) output_.add(record_.shape(y, t), result_);
    if (stops_.samples_at(t)) {
      auto [sample, supplied] = record_.seen(y, t);
      if (extremes_) {
        extremes_->add(sample);
        sample.extremes = std::make_shared<const std::vector<Extreme>>(extremes_->all());
      }
      const ConstraintResidual slopes = system_.slope_residual(y);
      result_.slopes.position = std::max(result_.slopes.position, slopes.position);
      result_.slopes.velocity = std::max(result_.slopes.velocity, slopes.velocity);
      if (result_.samples.empty()) {
        first_total_ = sample.discrete_total;
        sample.equilibrium = start_;
      }
      result_.max_kinetic = std::max(result_.max_kinetic, sample.energy.kinetic);
      const double gain = sample.discrete_total - supplied - first_total_ - jumps_;
      result_.max_energy_drift = std::max(result_.max_energy_drift, std::abs(gain));
      result_.samples.push_back(std::move(sample));
      most_energy_ = std::max(most_energy_, energy_there_is(result_.samples.front(), result_.samples.back()));
      if (steps_ >= steps_unjudged) check_source_of_energy(scene_, most_energy_, gain, t);
    }
    observing_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  }

  void event(const EventRecord<D>& record) {
    if (record.type == EventType::separation) result_.status = RunStatus::separated;
    jumps_ += record.discrete_jump;
    friction_.event();
    result_.timing.length_control += record.seconds;
    result_.events.push_back(record_.event(record));
  }

  const Scene& scene_;
  ProgressCallback progress_;
  const Checkpoints* checkpoints_;
  const RunOutput& output_;
  Stops stops_;
  BeamSystem<D> system_;
  FrictionWatch<D> friction_;
  BeamRecord<D> record_;
  std::optional<Extremes> extremes_;
  RunResult result_;
  std::optional<StaticSample> start_;
  int steps_ = 0;
  double first_total_ = 0, jumps_ = 0, most_energy_ = 0, observing_ = 0;
};

template <int D>
RunResult simulate_from_equilibrium(const Scene& scene, const ProgressCallback& progress,
                                    const Checkpoints* checkpoints, const RunOutput& output) {
  std::optional<InitialEquilibrium<D>> start;
  RunResult none;
  try {
    start = initial_equilibrium<D>(scene, [&progress] { return !progress || progress(0); });
    none.status = RunStatus::interrupted;
  } catch (const ComputationFailed& failure) {
    none.status = RunStatus::failed;
    none.failure = std::string("there is no equilibrium to start from: ") + failure.what();
  }
  if (!start) return none;
  set_in_motion(scene, start->chain);
  Run<D> run(scene, progress, checkpoints, output, start->chain);
  run.starts_from(start->seen);
  return run();
}

template <int D>
RunResult simulate_in(const Scene& scene, const ProgressCallback& progress, const Checkpoints* checkpoints,
                      const RunOutput& output) {
  if (scene.analysis == Analysis::statics) return simulate_statics<D>(scene, progress, output);
  if (starts_in_equilibrium(scene)) return simulate_from_equilibrium<D>(scene, progress, checkpoints, output);
  Run<D> run(scene, progress, checkpoints, output, build_chain<D>(scene));  // the chain is not kept
  return run();
}

}  // namespace

RunResult simulate(const Scene& scene, const ProgressCallback& progress, const Checkpoints* checkpoints,
                   const RunOutput& output) {
  validate(scene);
  if (checkpoints != nullptr && scene.assembly) {
    refuse("/beams", "several with checkpoints", "they are of one beam so far");
  }
  if (checkpoints != nullptr && scene.analysis == Analysis::statics) {
    refuse("/analysis", "\"statics\" with checkpoints", "they are of runs in time");
  }
  if (checkpoints != nullptr && scene.output.extremes) {
    refuse("/output/extremes", "true with checkpoints", "no checkpoint holds them: leave out one of the two");
  }
  RunResult result = of_scene([&] {
    if constexpr (has_room("assembly")) {
      if (scene.assembly) return simulate_assembly(scene, progress, output);
    }
    return scene.dimension == 2 ? simulate_in<2>(scene, progress, checkpoints, output)
                                : simulate_in<3>(scene, progress, checkpoints, output);
  });
  if (scene.analysis == Analysis::dynamics) {
    std::ranges::copy(energy_warnings(scene, result), std::back_inserter(result.warnings));
    if (const auto warning = stability_warning(scene, result)) result.warnings.push_back(*warning);
  }
  if (!scene.assembly) std::ranges::copy(implausible(scene, result), std::back_inserter(result.warnings));
  return result;
}

}  // namespace vlbeam
