#pragma once

#include <functional>
#include <limits>
#include <optional>

#include "core/dynamics/fields.hpp"
#include "core/element/active.hpp"
#include "core/parts/one_sided.hpp"
#include "core/parts/part.hpp"

namespace vlbeam {

/// What stops a drum near the least and the most that it may have paid out [m]: springs, and dampers where they push.
struct EndStop {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  OneSided spring;     ///< [N/m], [m]
  double damping = 0;  ///< [N s/m]

  /// Its push on what a drum has paid out.
  template <class Real>
  Real push(const Real& length) const {
    return spring.push(Real(Real(least) - length)) - spring.push(Real(length - Real(most)));
  }
  /// What its dampers take from that.
  template <class Real>
  Real drag(const Real& length, const Real& rate) const {
    const Real share = spring.share(Real(Real(least) - length)) + spring.share(Real(length - Real(most)));
    return rate * Real(damping) * share;
  }
};

/// What a metre of beam brings along that comes in at r with the velocity x' [J/m]: it is straight, unstrained and as
/// fast as the drum, x' outwards, and has the potential of its weight and of the force p along the beam,
///   e = rhoA x'^2/2 - (rhoA g + p).r.
template <int D>
double energy_fed(double rhoA, double rate, const Vec<double, D>& gravity, const Vec<double, D>& line,
                  const Vec<double, D>& r) {
  return rhoA * rate * rate / 2 - (rhoA * gravity + line).dot(r);
}

/// A drum that pays the beam out through one of its ends, or draws it in, by a given push F on it. The power of the
/// generalized force on the material coordinate of the end is that of the push, and of the energy e that comes in:
///   Q_x = -+(F + e), - at the start of the beam, where x falls as beam comes in.
/// The drum's own inertia stands in its joint (SlidingJoint::turning). Derived: docs/theory/joints.md, Drums.
template <int D>
class Drum final : public Part<D> {
 public:
  using LineForce = std::function<Vec<double, D>(double t)>;

  struct End {
    bool at_start;
    double from;  ///< its material coordinate at t = 0 [m]

    /// Of x, along what is paid out.
    double outwards() const { return at_start ? -1 : 1; }
  };

  /// `push` is a function of time [N], negative where the drum pulls. `rhoA` [kg/m]. `line` is the force along the
  /// whole beam [N/m], or empty.
  Drum(const End& end, double rhoA, TimeFunction push, LineForce line, const std::optional<EndStop>& stop = {})
      : end_(end), rhoA_(rhoA), push_(std::move(push)), line_(std::move(line)), stop_(stop) {}

  Tally add_force(const Motion<D>& motion, double* force) const override {
    const JointPlace* const end = place(motion.beam);
    if (end == nullptr) return {};  // in the equilibrium before the start
    const double speed = motion.beam.rate[end->mark], out = end_.outwards();
    const Vec<double, D> r = position<D>(motion.beam.q, end->node), line = line_at(motion.t);
    double push = push_(motion.t).value + energy_fed<D>(rhoA_, speed, motion.gravity, line, r), drag = 0;
    if (stop_) {
      const double length = out * (motion.beam.q[end->mark] - end_.from);
      push += stop_->push(length);
      drag = stop_->drag(length, out * speed);
    }
    force[end->mark] += out * (push - drag);
    return {
        .dissipated = drag * out * speed,
        .loads = out * push * speed + line.dot(motion.beam.inflow_at(*end))};  // matter has no potential of the line
  }
  void add_tangent(const Motion<D>& motion, const TangentWeights& by, BeamMatrix<D>& tangent) const override {
    const JointPlace* const end = place(motion.beam);
    if (end == nullptr) return;
    const double out = end_.outwards(), speed = motion.beam.rate[end->mark];
    double& own = tangent.entry(end->mark, end->mark);
    own -= by.v * out * rhoA_ * speed;
    const Vec<double, D> along = rhoA_ * motion.gravity + line_at(motion.t);
    for (int c = 0; c < D; ++c) {
      tangent.entry(end->mark, Eigen::Index{node_size<D>} * end->node + c) += by.q * out * along[c];
    }
    if (!stop_) return;
    using Real = Active<2>;
    const Real length(out * (motion.beam.q[end->mark] - end_.from), 0), rate(out * speed, 1);
    const Real push = stop_->push(length) - stop_->drag(length, rate);
    own -= by.q * push.derivatives()[0] + by.v * push.derivatives()[1];  // out stands in it twice
  }

 private:
  const JointPlace* place(const ChainView<D>& beam) const {
    return beam.joint_at(end_.at_start ? 0 : beam.mesh.last());
  }
  Vec<double, D> line_at(double t) const { return line_ ? line_(t) : Vec<double, D>(Vec<double, D>::Zero()); }

  End end_;
  double rhoA_;
  TimeFunction push_;
  LineForce line_;
  std::optional<EndStop> stop_;
};

}  // namespace vlbeam
