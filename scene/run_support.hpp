#pragma once

#include <limits>

#include "mechanics/motion/system/beam_system.hpp"
#include "scene/result.hpp"
#include "scene/run_output.hpp"

namespace vlbeam {

/// What the runs of all kinds of scenes share.

template <int D>
Point point_of(const Vec<double, D>& v) {
  Point point{};
  std::copy(v.data(), v.data() + D, point.begin());
  return point;
}

/// Of a node's generalized force, position and slope.
template <int D>
Reaction reaction_of(const Eigen::Matrix<double, 2 * D, 1>& force) {
  return {point_of<D>(force.template head<D>()), point_of<D>(force.template tail<D>())};
}

/// The direction in the middle between two unit tangents at a kink; the first of opposite ones.
template <class Vector>
Vector between(const Vector& before, const Vector& behind) {
  const Vector sum = before + behind;
  return sum.norm() > 1e-9 ? Vector(sum.normalized()) : before;
}

inline StrainSample strain_sample(const StrainExtremes& extremes) {
  return {{extremes.strain.least, extremes.strain.largest},
          {extremes.force.least, extremes.force.largest},
          extremes.curvature};
}

/// Nodes from the first to the last one, as far as there are any.
struct NodeRange {
  int first = 0, last = std::numeric_limits<int>::max();
};

/// The shape of a beam at time t.
template <int D>
Configuration configuration_of(const ChainState<D>& chain, double t, WeightTransport transport,
                               const NodeRange& of = {});

/// Where a run stops to look: at the samples, and at the configurations, both in increasing order.
struct Stops {
  std::vector<double> samples, configurations;

  explicit Stops(const Scene& scene);
  std::vector<double> all() const;
  /// The run ends at t, which becomes the last sample; false if it has that already.
  bool end_at(double t);
  bool samples_at(double t) const { return std::binary_search(samples.begin(), samples.end(), t); }
  bool keeps_shape_at(double t) const { return std::binary_search(configurations.begin(), configurations.end(), t); }
};

/// Chooses a method, of a fixed step if it takes one.
void set_method(IntegratorType type, double step, IntegrationOptions& options);

/// `shortest` is the length of the shortest element at t = 0 [m].
IntegrationOptions integration_options(const Scene& scene, const BeamSection& section, double shortest);

/// Runs to the end of the scene, from the state that `initial` makes, and notes how it went. The last sample of a run
/// that fails is its last good state.
void run_to_end(const Scene& scene, EventedOde& ode, const std::function<Eigen::VectorXd()>& initial, Stops& stops,
                const IntegrationOptions& options, const Checkpoints* checkpoints, RunResult& result);

/// Follows the equilibria of a scene.
template <int D>
RunResult simulate_statics(const Scene& scene, const std::function<bool(double t)>& progress, const RunOutput& output);

}  // namespace vlbeam
