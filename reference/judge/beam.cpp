#include "beam.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>

namespace judge {
namespace {

constexpr int most = 128;  // free coordinates of marks
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;

/// Numbers of the ten coordinates of the stretch between two marks.
std::array<int, 10> ends_of(const Mark& a, const Mark& b) {
  return {a.r[0], a.r[1], a.after[0], a.after[1], b.r[0], b.r[1], b.before[0], b.before[1], a.x, b.x};
}

Eigen::Map<const Bubbles> bubbles_at(const double* from, int n) { return {from, n, 2}; }

}  // namespace

void Beam::gather(const State& y, double t) {
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    const Coordinate& c = coordinates_[i];
    if (c.free >= 0) {
      q_[i] = y[c.free];
      rate_[i] = y[unknowns_ + c.free];
      acceleration_[i] = 0;
    } else if (c.direction == 0) {
      q_[i] = c.base;
      rate_[i] = acceleration_[i] = 0;
    } else {
      const auto f = c.displacement.derivatives(t);
      q_[i] = c.base + c.direction * f[0];
      rate_[i] = c.direction * f[1];
      acceleration_[i] = c.direction * f[2];
    }
  }
}

Eigen::Vector2d Beam::gravity(double t) const { return gravity_share_.at(t) * gravity_; }

void Beam::rates(const State& y, State& out, double t) {
  gather(y, t);
  const Eigen::Vector2d g = gravity(t);
  Small mass = Small::Zero(free_, free_);
  SmallVector force = SmallVector::Zero(free_);
  std::size_t at = free_;
  for (std::size_t s = 0; s < stretches_.size(); ++s) {
    Stretch& stretch = stretches_[s];
    const std::array<int, 10> ends = ends_of(marks_[s], marks_[s + 1]);
    Ends q, rate, given;
    for (int i = 0; i < 10; ++i) {
      q[i] = q_[ends[i]];
      rate[i] = rate_[ends[i]];
      given[i] = acceleration_[ends[i]];
    }
    const int n = stretch.bubbles();
    stretch.evaluate(q, rate, bubbles_at(&y[at], n), bubbles_at(&y[unknowns_ + at], n), g);
    const Ends f = stretch.force() - stretch.mass() * given;
    for (int i = 0; i < 10; ++i) {
      const int row = coordinates_[ends[i]].free;
      if (row < 0) continue;
      force[row] += f[i];
      for (int j = 0; j < 10; ++j) {
        const int column = coordinates_[ends[j]].free;
        if (column >= 0) mass(row, column) += stretch.mass()(i, j);
      }
    }
    at += 2 * n;
  }
  for (const Mark& mark : marks_) {  // d/dt of m dr/dt = m g
    for (int k = 0; k < 2; ++k) {
      const int row = coordinates_[mark.r[k]].free;
      if (mark.mass == 0 || row < 0) continue;
      mass(row, row) += mark.mass;
      force[row] += mark.mass * g[k];
    }
  }
  // Slopes weigh little: equal diagonals first.
  const SmallVector scale = mass.diagonal().cwiseSqrt().cwiseInverse();
  const Small scaled = scale.asDiagonal() * mass * scale.asDiagonal();
  const Eigen::LLT<Small> solver(scaled);
  if (solver.info() != Eigen::Success) throw std::runtime_error("the mass matrix is not positive definite");
  const SmallVector solved = solver.solve(SmallVector(scale.asDiagonal() * force));
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    const int row = coordinates_[i].free;
    if (row >= 0) acceleration_[i] = solved[row] * scale[row];
  }

  for (std::size_t i = 0; i < unknowns_; ++i) out[i] = y[unknowns_ + i];
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    if (coordinates_[i].free >= 0) out[unknowns_ + coordinates_[i].free] = acceleration_[i];
  }
  at = free_;
  for (std::size_t s = 0; s < stretches_.size(); ++s) {
    const std::array<int, 10> ends = ends_of(marks_[s], marks_[s + 1]);
    Ends acceleration;
    for (int i = 0; i < 10; ++i) acceleration[i] = acceleration_[ends[i]];
    const int n = stretches_[s].bubbles();
    Eigen::Map<Bubbles> into(&out[unknowns_ + at], n, 2);
    stretches_[s].bubble_accelerations(acceleration, into);
    at += 2 * n;
  }
}

State Beam::initial() const {
  State y(2 * unknowns_, 0.0);
  for (const Coordinate& c : coordinates_) {
    if (c.free >= 0) y[c.free] = c.base;
  }
  std::size_t at = free_;
  for (std::size_t s = 0; s < stretches_.size(); ++s) {
    const std::array<int, 10> ends = ends_of(marks_[s], marks_[s + 1]);
    Ends q;
    for (int i = 0; i < 10; ++i) q[i] = coordinates_[ends[i]].base;
    const Eigen::VectorXd& xi = stretches_[s].modes().xi;
    Eigen::Matrix<double, Eigen::Dynamic, 2> places(xi.size(), 2);
    for (int g = 0; g < xi.size(); ++g) {
      places.row(g) = curve((q[8] + q[9]) / 2 + xi[g] * (q[9] - q[8]) / 2).col(0).transpose();
    }
    const Bubbles c = stretches_[s].fit(q, places);
    std::copy(c.data(), c.data() + c.size(), y.begin() + static_cast<long>(at));
    at += c.size();
  }
  return y;
}

Energies Beam::energies(const State& y, double t) {
  gather(y, t);
  const Eigen::Vector2d g = gravity(t);
  Energies sum;
  std::size_t at = free_;
  for (std::size_t s = 0; s < stretches_.size(); ++s) {
    const std::array<int, 10> ends = ends_of(marks_[s], marks_[s + 1]);
    Ends q, rate;
    for (int i = 0; i < 10; ++i) {
      q[i] = q_[ends[i]];
      rate[i] = rate_[ends[i]];
    }
    const int n = stretches_[s].bubbles();
    const Energies e = stretches_[s].energies(q, rate, bubbles_at(&y[at], n), bubbles_at(&y[unknowns_ + at], n), g);
    sum.kinetic += e.kinetic;
    sum.axial += e.axial;
    sum.bending += e.bending;
    sum.gravity += e.gravity;
    at += 2 * n;
  }
  for (const Mark& mark : marks_) {
    for (int k = 0; k < 2; ++k) {
      sum.kinetic += 0.5 * mark.mass * rate_[mark.r[k]] * rate_[mark.r[k]];
      sum.gravity -= mark.mass * g[k] * q_[mark.r[k]];
    }
  }
  return sum;
}

std::vector<std::pair<std::string, double>> Beam::quantities(const State& y, double t) {
  const Energies e = energies(y, t);
  std::vector<std::pair<std::string, double>> all;
  for (const int j : joints_) {
    all.emplace_back("joint_position", q_[marks_[j].x]);
    if (marks_[j].mass > 0) {
      all.emplace_back("mass_position.x", q_[marks_[j].r[0]]);
      all.emplace_back("mass_position.y", q_[marks_[j].r[1]]);
    }
  }
  for (const auto& [name, mark] : {std::pair{"start", &marks_.front()}, {"end", &marks_.back()}}) {
    for (int k = 0; k < 2; ++k) {
      if (coordinates_[mark->r[k]].free >= 0) {
        all.emplace_back(std::string(name) + (k == 0 ? ".x" : ".y"), q_[mark->r[k]]);
      }
    }
  }
  all.emplace_back("energy.kinetic", e.kinetic);
  all.emplace_back("energy.axial", e.axial);
  all.emplace_back("energy.bending", e.bending);
  all.emplace_back("energy.gravity", e.gravity);
  return all;
}

}  // namespace judge
