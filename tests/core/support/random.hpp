#pragma once

#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "core/geometry/vec.hpp"
#include "core/geometry/weights.hpp"

namespace vlbeam::test {

/// Reproducible random numbers, the same with every standard library.
class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_()) / 4294967296.0;
  }

  template <int N>
  Vec<double, N> vector(double size = 1) {
    Vec<double, N> v;
    for (int i = 0; i < N; ++i) v[i] = uniform(-size, size);
    return v;
  }

  template <int D>
  Eigen::Matrix<double, D, D> rotation() {
    const double angle = uniform(-std::numbers::pi, std::numbers::pi);
    if constexpr (D == 2) {
      return Eigen::Rotation2Dd(angle).toRotationMatrix();
    } else {
      return Eigen::AngleAxisd(angle, vector<3>().normalized()).toRotationMatrix();
    }
  }

  /// Weights of which none is more than `ratio` times another.
  Weights<double> weights(double ratio) {
    return {uniform(1, ratio), uniform(1, ratio), uniform(1, ratio), uniform(1, ratio)};
  }

 private:
  std::mt19937 generator_;
};

}  // namespace vlbeam::test
