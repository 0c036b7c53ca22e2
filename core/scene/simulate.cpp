#include "core/scene/simulate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/scene/build.hpp"
#include "core/scene/build_flow.hpp"
#include "core/scene/run_support.hpp"
#include "core/scene/validate.hpp"

namespace vlbeam {
namespace {

template <int D>
Configuration configuration_of(const ChainState<D>& chain, double t, WeightTransport transport) {
  Configuration shape;
  shape.t = t;
  shape.x = chain.mesh.x;
  for (int k = 0; k <= chain.mesh.last(); ++k) {
    shape.r.push_back(point_of<D>(position<D>(chain.q.data(), k)));
    shape.r_x.push_back(point_of<D>(slope<D>(chain.q.data(), k)));
  }
  if (chain.kink) shape.kink = {static_cast<std::size_t>(chain.joint), point_of<D>(chain.kink->slope)};
  for (int k = 0; k < chain.mesh.elements(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const auto& weights = chain.mesh.weights[i];
    const bool restricted = transport == WeightTransport::transported && weights.w != unit_weights;
    shape.weights.push_back(restricted ? weights.on(shape.x[i], shape.x[i + 1]) : weights.w);
  }
  return shape;
}

/// Runs one scene of a known dimension and fills in its result.
template <int D>
class Run {
 public:
  Run(const Scene& scene, const ProgressCallback& progress)
      : scene_(scene), progress_(progress), stops_(scene), system_(build_model<D>(scene), build_chain<D>(scene)) {
    system_.on_sample = [this](const Eigen::VectorXd& y, double t) { sample(y, t); };
    system_.on_event = [this](const EventRecord<D>& record) { event(record); };
    system_.on_step = [this](double t) { return !progress_ || progress_(t); };
  }

  RunResult operator()() {
    const auto& x = build_chain<D>(scene_).mesh.x;
    double shortest = beam_length(scene_);
    for (std::size_t k = 1; k < x.size(); ++k) shortest = std::min(shortest, x[k] - x[k - 1]);
    const auto options = integration_options(scene_, system_.model().section, shortest);
    run_to_end(
        scene_, system_, [this] { return system_.initial_state(); }, stops_.all(), options, result_);
    result_.timing.motion -= result_.timing.length_control + observing_;
    result_.solver.rhs_evaluations = system_.rhs_evaluations();
    return std::move(result_);
  }

 private:
  void sample(const Eigen::VectorXd& y, double t) {
    const auto started = std::chrono::steady_clock::now();
    if (stops_.keeps_shape_at(t)) {
      result_.configurations.push_back(configuration_of(system_.chain(y), t, scene_.weights));
    }
    if (stops_.samples_at(t)) {
      const auto seen = system_.observe(y, t, ledger_points);
      const auto own = system_.observe(y, t, system_.model().quadrature_points);
      Sample sample;
      sample.t = t;
      const auto chain = system_.chain(y);
      if (system_.has_joint()) sample.joint_position = chain.mesh.x[static_cast<std::size_t>(chain.joint)];
      if (const auto mass = system_.mass_position(y)) sample.mass_position = point_of<D>(*mass);
      sample.end = point_of<D>(position<D>(chain.q.data(), chain.mesh.last()));
      sample.beam_length = seen.beam_length;
      sample.beam_length_rate = seen.beam_length_rate;
      sample.energy = seen.energy;
      sample.discrete_total = own.energy.total();
      sample.momentum = point_of<D>(seen.momentum);
      const auto forces = system_.reactions(y, t);
      for (std::size_t i = 0; i < 2; ++i) {
        sample.reactions[i] = {point_of<D>(forces[i].template head<D>()), point_of<D>(forces[i].template tail<D>())};
      }
      const ConstraintResidual slopes = system_.slope_residual(y);
      result_.slopes.position = std::max(result_.slopes.position, slopes.position);
      result_.slopes.velocity = std::max(result_.slopes.velocity, slopes.velocity);
      if (result_.samples.empty()) first_total_ = sample.discrete_total;
      result_.max_kinetic = std::max(result_.max_kinetic, seen.energy.kinetic);
      result_.max_energy_drift = std::max(
          result_.max_energy_drift, std::abs(sample.discrete_total - sample.energy.supplied - first_total_ - jumps_));
      result_.samples.push_back(sample);
    }
    observing_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  }

  void event(const EventRecord<D>& record) {
    Event event;
    event.t = record.t;
    event.type = record.type;
    event.joint_position = record.joint_position;
    event.weights = record.merged.k;
    event.unit_fallback = record.merged.unit_fallback;
    event.energy_jump = record.jump;
    event.discrete_jump = record.discrete_jump;
    event.momentum_jump.assign(record.momentum_jump.begin(), record.momentum_jump.end());
    event.before = configuration_of(record.before, record.t, scene_.weights);
    event.after = configuration_of(record.after, record.t, scene_.weights);
    if (record.type == EventType::separation) result_.status = RunStatus::separated;
    jumps_ += record.discrete_jump;
    result_.timing.length_control += record.seconds;
    result_.events.push_back(std::move(event));
  }

  const Scene& scene_;
  ProgressCallback progress_;
  Stops stops_;
  BeamSystem<D> system_;
  RunResult result_;
  double first_total_ = 0, jumps_ = 0, observing_ = 0;
};

}  // namespace

RunResult simulate(const Scene& scene, const ProgressCallback& progress) {
  validate(scene);
  if (flows(scene)) return scene.dimension == 2 ? simulate_flow<2>(scene, progress) : simulate_flow<3>(scene, progress);
  return scene.dimension == 2 ? Run<2>(scene, progress)() : Run<3>(scene, progress)();
}

}  // namespace vlbeam
