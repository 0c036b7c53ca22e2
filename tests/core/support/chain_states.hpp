#pragma once

#include <cmath>

#include "core/joint/slope_conditions.hpp"
#include "core/length_control/chain_state.hpp"
#include "tests/core/support/random.hpp"

namespace vlbeam::test {

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
};

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
  chain.joint = shape.joint;
  for (int k = 0; k <= n; ++k) chain.mesh.x.push_back(shape.element_length * k);
  if (shape.joint != no_joint) {
    chain.mesh.x[static_cast<std::size_t>(shape.joint)] += shape.element_length * random.uniform(-0.3, 0.3);
    chain.joint_rate = random.uniform(-1, 1);
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
    chain.rider = {shape.rider, shape.element_length * (shape.rider + u), rate, shape.held};
  }
  if (shape.slopes != JointSlopes::continuous) {
    chain.kink = random_kink<D>(shape.slopes, slope<D>(chain.q.data(), shape.joint),
                                slope<D>(chain.rate.data(), shape.joint), random);
  }
  for (int k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    WeightFunction weights{unit_weights, chain.mesh.x[i], chain.mesh.x[i + 1]};
    if (shape.rational) weights.w = random.weights(1.5);
    if (shape.rational && shape.transport == WeightTransport::transported &&
        (k == shape.joint || k + 1 == shape.joint)) {
      (k == shape.joint ? weights.x_a : weights.x_b) += random.uniform(-0.1, 0.1) * shape.element_length;
    }
    chain.mesh.weights.push_back(weights);
  }
  return chain;
}

/// A chain along a smooth curve, in motion, whose joint is `behind` element lengths ahead of the node behind it.
template <int D>
ChainState<D> smooth_chain(const ChainShape& shape, double behind, Random& random) {
  auto chain = random_chain<D>(shape, random);
  const auto j = static_cast<std::size_t>(chain.joint);
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
  if (chain.kink) chain.kink->slope = slope<D>(chain.q.data(), chain.joint) + random.vector<D>(0.1);
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
  if (chain.joint != no_joint) result.joint = n - chain.joint;
  result.joint_rate = -chain.joint_rate;
  if (auto& rider = result.rider) rider = {n - 1 - rider->element, sum - rider->x, -rider->rate, rider->held};
  if (chain.kink) {
    auto at_joint = slope<D>(result.q.data(), result.joint), rate_at_joint = slope<D>(result.rate.data(), result.joint);
    result.kink = {at_joint, rate_at_joint};
    at_joint = -chain.kink->slope;
    rate_at_joint = -chain.kink->rate;
  }
  return result;
}

/// Motion of the material point x.
template <int D>
PointMotion<double, D> point_motion(const ChainState<D>& chain, WeightTransport transport, double x) {
  int k = 0;
  while (k + 1 < chain.mesh.elements() && x > chain.mesh.x[static_cast<std::size_t>(k) + 1]) ++k;
  const auto q = chain.coordinates(k);
  const bool at_joint = chain.joint != no_joint && (k == chain.joint || k + 1 == chain.joint);
  const MovingKinematics<double, D> kinematics(q, chain.rates(k), at_joint ? transport : WeightTransport::frozen,
                                               chain.mesh.weights[static_cast<std::size_t>(k)]);
  const double u = (x - q.x_a) / (q.x_b - q.x_a);
  return kinematics.at(u, rational_shape(kinematics.weights(), u));
}

}  // namespace vlbeam::test
