#include "mechanics/spin/nut.hpp"

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
    const double beyond = off(spin, q, rate, x);
    x -= beyond;
    if (std::abs(beyond) <= small * (std::abs(x) + std::abs(sum_ / per_length_))) {
      const SpinChain::Point there = spin.section(q, rate, x).at;
      return {x, -there.spin / (per_length_ + there.twist)};
    }
  }
  return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
}

double Nut::off(const Spin& spin, const double* q, const double* rate, double x) const {
  const SpinChain::Point at = spin.section(q, rate, x).at;
  return (at.angle + per_length_ * x - sum_) / (per_length_ + at.twist);
}

Nut::Thread Nut::thread(const Spin& spin, const double* q, const double* rate, double x) const {
  const Spin::Section section = spin.section(q, rate, x);
  const double per_turn = 1 / (per_length_ + section.at.twist);
  const auto scattered = [&](double torque, double couple) {
    Eigen::VectorXd angles = Eigen::VectorXd::Zero(spin.coordinates());
    spin.scatter(section, torque, couple, angles.data());
    return angles;
  };
  return {off(spin, q, rate, x), scattered(-per_turn, 0),
          scattered(section.at.twist_gradient * per_turn * per_turn, -per_turn), scattered(per_turn * per_turn, 0),
          scattered(0, 1)};
}

bool Nut::couple(Spin& spin, const double* q, const double* rate, const double* a, double x, double x_rate) {
  const Spin::Section section = spin.section(q, rate, x);
  const SpinChain::Point& at = section.at;
  const double turned = per_length_ + at.twist;
  by_angles_.setZero(spin.coordinates());
  spin.scatter(section, -1 / turned, 0, by_angles_.data());
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
  spin.scatter(section, push / (per_length_ + section.at.twist), 0, on_angles.data());
  return on_angles;
}

}  // namespace vlbeam
