#include <algorithm>
#include <cmath>

#include "core/scene/build_flow.hpp"
#include "core/scene/run_support.hpp"

namespace vlbeam {
namespace {

/// Runs one scene of a flowing beam of a known dimension and fills in its result.
template <int D>
class FlowRun {
 public:
  FlowRun(const Scene& scene, const std::function<bool(double t)>& progress)
      : scene_(scene), stops_(scene), beam_(build_flowing_model<D>(scene)) {
    beam_.on_sample = [this](const Eigen::VectorXd& y, double t) {
      if (stops_.keeps_shape_at(t)) keep_shape(y, t);
      if (stops_.samples_at(t)) sample(y, t);
    };
    beam_.on_step = [progress](double t) { return !progress || progress(t); };
  }

  RunResult operator()() {
    const auto nodes = beam_.nodes_at(0);
    double shortest = nodes[1].value - nodes[0].value;
    for (std::size_t k = 2; k < nodes.size(); ++k) shortest = std::min(shortest, nodes[k].value - nodes[k - 1].value);
    const auto options = integration_options(scene_, beam_.model().section, shortest);
    run_to_end(
        scene_, beam_, [this] { return initial_flow(scene_, beam_); }, stops_, options, result_);
    result_.solver.rhs_evaluations = beam_.rhs_evaluations();
    return std::move(result_);
  }

 private:
  void keep_shape(const Eigen::VectorXd& y, double t) {
    Configuration shape;
    shape.t = t;
    const auto nodes = beam_.nodes_at(t);
    for (int k = 0; k < beam_.nodes(); ++k) {
      shape.x.push_back(nodes[static_cast<std::size_t>(k)].value);
      shape.r.push_back(point_of<D>(position<D>(y.data(), k)));
      shape.r_x.push_back(point_of<D>(slope<D>(y.data(), k)));
      if (beam_.model().spin) shape.angles.push_back(y[beam_.angle(k)]);
      const double* rate = y.data() + beam_.coordinates();
      const double x_rate = nodes[static_cast<std::size_t>(k)].rate;
      shape.rates.x.push_back(x_rate);
      shape.rates.v.push_back(point_of<D>(position<D>(rate, k) - x_rate * slope<D>(y.data(), k)));
      shape.rates.r_x.push_back(point_of<D>(slope<D>(rate, k)));
      if (beam_.model().spin) shape.rates.spins.push_back(rate[beam_.angle(k)]);
    }
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
      shape.weights.push_back(beam_.weights_at(k, nodes));
    }
    result_.configurations.push_back(std::move(shape));
  }

  void sample(const Eigen::VectorXd& y, double t) {
    const Observation<D> seen = beam_.observe(y, t, ledger_points, true);
    Sample sample;
    sample.t = t;
    sample.end = point_of<D>(position<D>(y.data(), beam_.elements()));
    sample.beam_length = seen.beam_length;
    sample.beam_length_rate = seen.beam_length_rate;
    sample.energy = seen.energy;
    sample.discrete_total = beam_.observe(y, t).energy.total();
    sample.momentum = point_of<D>(seen.momentum);
    sample.angular_momentum = point_of<3>(seen.angular_momentum);
    sample.strains = strain_sample(*seen.extremes);
    FlowSample flow;
    flow.mass = seen.mass;
    if (beam_.model().spin) {
      flow.end_angles = {y[beam_.angle(0)], y[beam_.angle(beam_.elements())]};
      flow.spin_momentum = seen.spin_momentum;
    }
    for (const auto& place : beam_.load_places(y, t)) flow.loads.push_back(point_of<D>(place));
    const FlowReactions<D> reactions = beam_.reactions(y, t);
    flow.torques = reactions.torques;
    for (std::size_t i = 0; i < reactions.supports.size(); ++i) {
      const int node = beam_.model().supports[i].node;
      const Reaction reaction = reaction_of<D>(reactions.supports[i]);
      if (node > 0 && node < beam_.elements()) {
        flow.supports.push_back(reaction);
      } else {
        sample.reactions[node == 0 ? 0 : 1] = reaction;
      }
    }
    double supplied = sample.energy.supplied;
    if (beam_.model().ledger) {
      const FlowLedger<D> ledger = beam_.ledger(y);
      flow.ledger = {ledger.mass, ledger.ends, ledger.loads, ledger.mesh};
      supplied += ledger.ends + ledger.loads + ledger.mesh;
    }
    sample.flow = std::make_shared<const FlowSample>(std::move(flow));
    if (result_.samples.empty()) first_total_ = sample.discrete_total;
    result_.max_kinetic = std::max(result_.max_kinetic, seen.energy.kinetic);
    result_.max_energy_drift =
        beam_.model().ledger
            ? std::max(result_.max_energy_drift, std::abs(sample.discrete_total - first_total_ - supplied))
            : std::nan("");
    result_.samples.push_back(std::move(sample));
  }

  const Scene& scene_;
  Stops stops_;
  FlowingBeam<D> beam_;
  RunResult result_;
  double first_total_ = 0;
};

}  // namespace

template <int D>
RunResult simulate_flow(const Scene& scene, const std::function<bool(double t)>& progress) {
  return FlowRun<D>(scene, progress)();
}

template RunResult simulate_flow<2>(const Scene&, const std::function<bool(double t)>&);
template RunResult simulate_flow<3>(const Scene&, const std::function<bool(double t)>&);

}  // namespace vlbeam
