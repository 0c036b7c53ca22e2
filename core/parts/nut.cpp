#include "core/parts/nut.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace vlbeam {
namespace {

constexpr int most_steps = 50;  // of Newton, to where the thread has the nut

}  // namespace

Nut::Nut(double pitch, double x, double angle)
    : per_length_(2 * std::numbers::pi / pitch), sum_(angle + per_length_ * x) {}

Nut::Place Nut::place(const Spin& spin, const double* q, const double* rate, double x) const {
  const double small = 4 * std::numeric_limits<double>::epsilon();
  for (int step = 0; step < most_steps; ++step) {
    const SpinChain::Point at = spin.section(q, rate, x).at;
    const double off = (at.angle + per_length_ * x - sum_) / (per_length_ + at.twist);
    x -= off;
    if (std::abs(off) <= small * (std::abs(x) + std::abs(sum_ / per_length_))) {
      const SpinChain::Point there = spin.section(q, rate, x).at;
      return {x, -there.spin / (per_length_ + there.twist)};
    }
  }
  return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
}

bool Nut::couple(Spin& spin, const double* q, const double* rate, const double* a, double x, double x_rate) {
  const Spin::Section section = spin.section(q, rate, x);
  const SpinChain::Point& at = section.at;
  const double turned = per_length_ + at.twist;
  by_angles_.setZero(spin.coordinates());
  spin.scatter(section, -1 / turned, by_angles_.data());
  answer_ = by_angles_;
  spin.solve_again(answer_.data());
  const double gives = by_angles_.dot(answer_);
  if (!(gives > 0)) return false;
  const double c = -(2 * at.twist_rate * x_rate + at.twist_gradient * x_rate * x_rate) / turned;
  load_.inertia = 1 / gives;
  load_.force = (by_angles_.dot(Eigen::Map<const Eigen::VectorXd>(a, by_angles_.size())) + c) / gives;
  return true;
}

double Nut::turn(double x_acceleration, double* a) const {
  const double push = load_.force - load_.inertia * x_acceleration;
  Eigen::Map<Eigen::VectorXd>(a, answer_.size()) -= push * answer_;
  return push;
}

Eigen::VectorXd Nut::torque(const Spin& spin, const double* q, const double* rate, double x, double push) const {
  Eigen::VectorXd on_angles = Eigen::VectorXd::Zero(spin.coordinates());
  const Spin::Section section = spin.section(q, rate, x);
  spin.scatter(section, push / (per_length_ + section.at.twist), on_angles.data());
  return on_angles;
}

}  // namespace vlbeam
