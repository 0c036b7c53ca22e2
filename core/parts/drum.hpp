#pragma once

#include <functional>

#include "core/dynamics/fields.hpp"
#include "core/parts/part.hpp"

namespace vlbeam {

/// A drum that pays the beam out through one of its ends, or draws it in, by a given push F on it. What comes in is
/// straight, unstrained and as fast as the drum, x' outwards, so that it brings e = rhoA x'^2/2 - (rhoA g + p).r along,
/// p the force along the beam, which its equations take for a potential, too. The power of the generalized force on the
/// material coordinate of the end is that of both:
///   Q_x = -+(F + e), - at the start of the beam, where x falls as beam comes in.
/// The drum's own inertia stands in its joint (SlidingJoint::turning). Derived: docs/theory/joints.md, Drums.
template <int D>
class Drum final : public Part<D> {
 public:
  using LineForce = std::function<Vec<double, D>(double t)>;

  /// `push` is a function of time [N], negative where the drum pulls. `rhoA` [kg/m]. `line` is the force along the
  /// whole beam [N/m], or empty.
  Drum(bool at_start, double rhoA, TimeFunction push, LineForce line)
      : at_start_(at_start), rhoA_(rhoA), push_(std::move(push)), line_(std::move(line)) {}

  Tally add_force(const Motion<D>& motion, double* force) const override {
    const JointPlace* const end = place(motion.beam);
    if (end == nullptr) return {};  // in the equilibrium before the start
    const double speed = motion.beam.rate[end->mark];
    const Vec<double, D> r = position<D>(motion.beam.q, end->node), line = line_at(motion.t);
    const double brought = rhoA_ * speed * speed / 2 - (rhoA_ * motion.gravity + line).dot(r);
    const double size = outwards() * (push_(motion.t).value + brought);
    force[end->mark] += size;
    return {.loads = size * speed + line.dot(motion.beam.inflow_at(*end))};  // matter has no potential of the line
  }
  void add_tangent(const Motion<D>& motion, const TangentWeights& by, BeamMatrix<D>& tangent) const override {
    const JointPlace* const end = place(motion.beam);
    if (end == nullptr) return;
    tangent.entry(end->mark, end->mark) -= by.v * outwards() * rhoA_ * motion.beam.rate[end->mark];
    const Vec<double, D> along = rhoA_ * motion.gravity + line_at(motion.t);
    for (int c = 0; c < D; ++c) {
      tangent.entry(end->mark, Eigen::Index{node_size<D>} * end->node + c) += by.q * outwards() * along[c];
    }
  }

 private:
  const JointPlace* place(const ChainView<D>& beam) const { return beam.joint_at(at_start_ ? 0 : beam.mesh.last()); }
  double outwards() const { return at_start_ ? -1 : 1; }
  Vec<double, D> line_at(double t) const { return line_ ? line_(t) : Vec<double, D>(Vec<double, D>::Zero()); }

  bool at_start_;
  double rhoA_;
  TimeFunction push_;
  LineForce line_;
};

}  // namespace vlbeam
