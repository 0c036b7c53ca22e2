#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/length_control/chain_state.hpp"
#include "mechanics/flow/mesh_motion.hpp"
#include "mechanics/motion/joint/slope_conditions.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {

inline constexpr std::array transports{WeightTransport::frozen, WeightTransport::transported};

inline constexpr int no_joint = -1;

/// What a random chain of elements looks like.
struct ChainShape {
  int elements = 5;
  int joint = no_joint;
  bool rational = false;
  WeightTransport transport = WeightTransport::frozen;
  double element_length = 0.2;
  JointSlopes slopes = JointSlopes::continuous;
  int rider = -1;     ///< element inside which a mass rides, the first or the last
  bool held = false;  ///< at the end of the beam
  /// Joints behind the first one.
  struct Joint {
    int node;
    JointSlopes slopes = JointSlopes::continuous;
  };
  std::vector<Joint> more = {};

  std::vector<Joint> joints() const {
    std::vector<Joint> all;
    if (joint != no_joint) all.push_back({joint, slopes});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};

/// With and without what slides, on nodes and inside elements, of every kind of weights and slopes.
inline const std::vector<ChainShape> bearing_shapes{
    {.elements = 5, .joint = no_joint, .rational = true},
    {.elements = 5, .joint = 2, .rational = true},
    {.elements = 2, .joint = 1},
    {.elements = 2, .joint = 1, .rational = true, .transport = WeightTransport::transported},
    {.elements = 3, .joint = 1, .rational = true, .slopes = JointSlopes::equal_stretch},
    {.elements = 4, .rational = true, .rider = 3},
    {.elements = 4, .rider = 0, .held = true}};

/// The same next to both of their ends.
inline const std::vector<ChainShape> supported_shapes{
    {.elements = 5, .joint = no_joint},
    {.elements = 2, .joint = no_joint},
    {.elements = 5, .joint = 1, .rational = true},
    {.elements = 5, .joint = 2, .rational = true},
    {.elements = 6, .joint = 5},
    {.elements = 2, .joint = 1, .rational = true, .transport = WeightTransport::transported},
    {.elements = 5, .rational = true, .rider = 4},
    {.elements = 2, .rider = 0},
    {.elements = 3, .rider = 2, .held = true}};

/// A random slope behind the joint, and its rate, as the joint's mode allows beside the one before it.
template <int D>
typename ChainState<D>::Kink random_kink(JointSlopes slopes, const Vec<double, D>& before, const Vec<double, D>& rate,
                                         Random& random) {
  typename ChainState<D>::Kink kink{before + random.vector<D>(0.3), random.vector<D>()};
  if (slopes == JointSlopes::tangent) {
    const double ratio = random.uniform(0.8, 1.2), ratio_rate = random.uniform(-1, 1);
    kink = {ratio * before, ratio * rate + ratio_rate * before};
  } else if (slopes == JointSlopes::equal_stretch) {
    kink.slope *= before.norm() / kink.slope.norm();
    kink.rate += kink.slope * (before.dot(rate) - kink.slope.dot(kink.rate)) / before.squaredNorm();
  }
  return kink;
}

/// Positions and slopes of the nodes along a smooth curve about the first axis of a random frame, all in motion.
template <int D>
ChainState<D> random_chain(const ChainShape& shape, Random& random) {
  ChainState<D> chain;
  const Eigen::Matrix<double, D, D> Q = random.rotation<D>();
  const Vec<double, D> along = Q.col(0);
  const int n = shape.elements;
  for (int k = 0; k <= n; ++k) chain.mesh.x.push_back(shape.element_length * k);
  for (const auto& joint : shape.joints()) {
    chain.mesh.x[static_cast<std::size_t>(joint.node)] += shape.element_length * random.uniform(-0.3, 0.3);
    chain.joints.push_back(
        {.node = joint.node, .rate = random.uniform(-1, 1), .index = static_cast<int>(chain.joints.size())});
  }
  const auto size = static_cast<std::size_t>(node_size<D> * (n + 1));
  chain.q.resize(size);
  chain.rate.resize(size);
  for (int k = 0; k <= n; ++k) {
    const double x = chain.mesh.x[static_cast<std::size_t>(k)];
    position<D>(chain.q.data(), k) = 1.02 * x * along + random.vector<D>(0.03 * shape.element_length);
    slope<D>(chain.q.data(), k) = along + random.vector<D>(0.1);
    position<D>(chain.rate.data(), k) = random.vector<D>();
    slope<D>(chain.rate.data(), k) = random.vector<D>();
  }
  if (shape.rider >= 0) {
    const double u = shape.held ? (shape.rider > 0 ? 1 : 0) : random.uniform(0.2, 0.8);
    const double rate = shape.held ? 0 : random.uniform(-1, 1);
    chain.loose = {shape.rider, shape.element_length * (shape.rider + u), rate, shape.held};
  }
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    const ChainShape::Joint joint = shape.joints()[i];
    if (joint.slopes == JointSlopes::continuous) continue;
    chain.joints[i].kink = random_kink<D>(joint.slopes, slope<D>(chain.q.data(), joint.node),
                                          slope<D>(chain.rate.data(), joint.node), random);
  }
  for (int k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    WeightFunction weights{unit_weights, chain.mesh.x[i], chain.mesh.x[i + 1]};
    if (shape.rational) weights.w = random.weights(1.5);
    if (shape.rational && shape.transport == WeightTransport::transported && chain.moves(k)) {
      (chain.joint_at(k) != nullptr ? weights.x_a : weights.x_b) += random.uniform(-0.1, 0.1) * shape.element_length;
    }
    chain.mesh.weights.push_back(weights);
  }
  return chain;
}

/// A chain along a smooth curve, in motion, whose joint is `behind` element lengths ahead of the node behind it.
template <int D>
ChainState<D> smooth_chain(const ChainShape& shape, double behind, Random& random) {
  auto chain = random_chain<D>(shape, random);
  const auto j = static_cast<std::size_t>(chain.joints.front().node);
  for (std::size_t k = 0; k < chain.mesh.x.size(); ++k) chain.mesh.x[k] = shape.element_length * static_cast<double>(k);
  chain.mesh.x[j] = chain.mesh.x[j - 1] + behind * shape.element_length;
  const Eigen::Matrix<double, D, D> Q = random.rotation<D>();
  for (std::size_t k = 0; k < chain.mesh.x.size(); ++k) {
    const double x = chain.mesh.x[k];
    Vec<double, D> r = 1.01 * x * Vec<double, D>::UnitX(), r_x = 1.01 * Vec<double, D>::UnitX();
    r[1] = 0.1 * std::sin(3 * x);
    r_x[1] = 0.3 * std::cos(3 * x);
    if constexpr (D == 3) {
      r[2] = 0.1 * std::cos(4 * x);
      r_x[2] = -0.4 * std::sin(4 * x);
    }
    position<D>(chain.q.data(), static_cast<int>(k)) = Q * r;
    slope<D>(chain.q.data(), static_cast<int>(k)) = Q * r_x;
  }
  for (auto& joint : chain.joints) {
    if (joint.kink) joint.kink->slope = slope<D>(chain.q.data(), joint.node) + random.vector<D>(0.1);
  }
  for (std::size_t k = 0; k < chain.mesh.weights.size(); ++k) {
    chain.mesh.weights[k].x_a = chain.mesh.x[k];
    chain.mesh.weights[k].x_b = chain.mesh.x[k + 1];
  }
  return chain;
}

/// The same body described from its other end: material coordinates run the other way.
template <int D>
ChainState<D> reversed(const ChainState<D>& chain) {
  ChainState<D> result = chain;
  const int n = chain.mesh.elements();
  const double sum = chain.mesh.x.front() + chain.mesh.x.back();
  for (int k = 0; k <= n; ++k) {
    result.copy_node(k, chain, n - k);
    result.mesh.x[static_cast<std::size_t>(k)] = sum - chain.mesh.x[static_cast<std::size_t>(n - k)];
    slope<D>(result.q.data(), k) *= -1;
    slope<D>(result.rate.data(), k) *= -1;
  }
  for (int k = 0; k < n; ++k) {
    const auto& from = chain.mesh.weights[static_cast<std::size_t>(n - 1 - k)];
    result.mesh.weights[static_cast<std::size_t>(k)] = {
        {from.w[3], from.w[2], from.w[1], from.w[0]}, sum - from.x_b, sum - from.x_a};
  }
  std::reverse(result.joints.begin(), result.joints.end());
  if (auto& rider = result.loose) rider = {n - 1 - rider->element, sum - rider->x, -rider->rate, rider->held};
  for (auto& joint : result.joints) {
    joint.node = n - joint.node;
    joint.rate *= -1;
    if (!joint.kink) continue;
    auto before = slope<D>(result.q.data(), joint.node), rate = slope<D>(result.rate.data(), joint.node);
    const auto behind = *joint.kink;
    joint.kink = {before, rate};
    before = -behind.slope;
    rate = -behind.rate;
  }
  return result;
}

/// Motion of the material point x.
template <int D>
PointMotion<double, D> point_motion(const ChainState<D>& chain, WeightTransport transport, double x) {
  int k = 0;
  while (k + 1 < chain.mesh.elements() && x > chain.mesh.x[static_cast<std::size_t>(k) + 1]) ++k;
  const auto q = chain.coordinates(k);
  const bool at_joint = chain.moves(k);
  const MovingKinematics<double, D> kinematics(q, chain.rates(k), at_joint ? transport : WeightTransport::frozen,
                                               chain.mesh.weights[static_cast<std::size_t>(k)]);
  const double u = (x - q.x_a) / (q.x_b - q.x_a);
  return kinematics.at(u, rational_shape(kinematics.weights(), u));
}

/// A function of time that starts as the joint moves.
template <int D>
TimeFunction guide_of(const ChainState<D>& chain, std::size_t joint, double acceleration) {
  const double x = chain.mesh.x[static_cast<std::size_t>(chain.joints[joint].node)], rate = chain.joints[joint].rate;
  return [=](double t) {
    return Prescribed{x + t * (rate + t * acceleration / 2), rate + t * acceleration, acceleration};
  };
}

}  // namespace vlbeam::test
