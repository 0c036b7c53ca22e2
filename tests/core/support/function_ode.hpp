#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

#include "mechanics/time/integrate.hpp"

namespace vlbeam::test {

/// A small equation written as functions; what it does not say has no effect.
class FunctionOde : public EventedOde {
 public:
  using RightHandSide = std::function<Eigen::VectorXd(const Eigen::VectorXd& y, double t)>;

  FunctionOde(Eigen::Index size, RightHandSide f) : size_(size), f_(std::move(f)) {}

  Eigen::Index size() const override { return size_; }
  void rhs(const Eigen::VectorXd& y, Eigen::VectorXd& dydt, double t) override {
    EXPECT_EQ(dydt.size(), y.size());
    dydt = f_(y, t);
  }
  /// By central differences.
  void jacobian(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) override {
    constexpr double step = 5e-7;
    for (Eigen::Index k = 0; k < y.size(); ++k) {
      const Eigen::VectorXd d = step * Eigen::VectorXd::Unit(y.size(), k);
      dfdy.col(k) = (f_(y + d, t) - f_(y - d, t)) / (2 * step);
    }
    dfdt = (f_(y, t + step) - f_(y, t - step)) / (2 * step);
  }
  Guards guards(const Eigen::VectorXd& y, double t) const override {
    return {{0, 0, guard ? guard(y, t) : -1}, {1, 0, second_guard ? second_guard(y, t) : -1}};
  }
  void handle_event(int index, Eigen::VectorXd& y, double t) override {
    events.push_back({index, t});
    if (on_event) on_event(index, y);
  }
  void sample(const Eigen::VectorXd& y, double t) override { samples.push_back({t, y}); }
  bool proceed(const Eigen::VectorXd& /*y*/, double t) override { return t < interrupt_at; }

  std::function<double(const Eigen::VectorXd&y, double t)> guard, second_guard;
  std::function<void(int index, Eigen::VectorXd& y)> on_event;
  double interrupt_at = 1e300;

  struct EventSeen {
    int index;
    double t;
  };
  struct SampleSeen {
    double t;
    Eigen::VectorXd y;
  };
  std::vector<EventSeen> events;
  std::vector<SampleSeen> samples;

 private:
  Eigen::Index size_;
  RightHandSide f_;
};

/// y'' = -y; from (1, 0) it is (cos t, -sin t).
inline FunctionOde oscillator() {
  return {2, [](const Eigen::VectorXd& y, double) -> Eigen::VectorXd { return Eigen::Vector2d(y[1], -y[0]); }};
}

/// The methods that choose their step.
inline constexpr std::array<IntegrationMethod, 5> integrators{
    IntegrationMethod::dopri5, IntegrationMethod::cash_karp, IntegrationMethod::fehlberg78,
    IntegrationMethod::bulirsch_stoer, IntegrationMethod::rosenbrock4};

}  // namespace vlbeam::test
