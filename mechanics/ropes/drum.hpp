#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "core/element/active.hpp"
#include "core/element/section.hpp"
#include "core/error.hpp"
#include "mechanics/contact/one_sided.hpp"
#include "mechanics/motion/parts/part.hpp"
#include "mechanics/ropes/winding.hpp"
#include "mechanics/time/fields.hpp"

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

/// What a metre of beam brings along that comes in at the rate s' [m/s], straight, with the slope r_x of the outlet or
/// unstretched: its speed is |r_x| s', or s', and it may be strained.
template <class Real, int D>
struct ComingIn {
  Real stretch;          ///< |r_x|, or 1
  Real strain, kinetic;  ///< energies [J/m]

  ComingIn(const BeamSection& section, Winding winding, const Real& rate, const Vec<Real, D>& slope)
      : stretch(1), strain(0) {
    if (winding == Winding::stretched) {
      using std::sqrt;
      Stiffness axial = section.stiffness;
      axial.EI = 0;
      stretch = sqrt(Real(slope.dot(slope)));
      strain = ElasticStress<Real, D>(slope, Vec<Real, D>(Vec<Real, D>::Zero()), axial).axial;
    }
    kinetic = Real(section.rhoA / 2) * stretch * stretch * rate * rate;
  }
};

/// Of a metre of beam at r, the potential of its weight and of the force p along the beam, -(rhoA g + p).r [J/m].
template <int D>
double potential_fed(double rhoA, const Vec<double, D>& gravity, const Vec<double, D>& line, const Vec<double, D>& r) {
  return -(rhoA * gravity + line).dot(r);
}

/// The tension [N] of the beam at the outlet of a winch, from the generalized force along what is paid out, without
/// potentials,
///   Q_s = -T |r_x| + W + rhoA |r_x|^2 s'^2/2:
/// the power through the outlet, over s'.
template <int D>
double outlet_tension(const BeamSection& section, double force, double rate, const Vec<double, D>& slope) {
  const ComingIn<double, D> matter(section, Winding::stretched, rate, slope);
  return (matter.strain + matter.kinetic - force) / matter.stretch;
}

/// A drum that pays the beam out through one of its ends, or draws it in, by a given push P on the beam there. The
/// power of the generalized force on the material coordinate of the end is that of the push, at the speed l s' of the
/// beam on the drum, and of the energy e that comes in:
///   Q_x = -+(P l + e), - at the start of the beam, where x falls as beam comes in.
/// The drum's own inertia stands in its joint (SlidingJoint::turning). What comes in feeds the vibration of an element
/// at the outlet that is shorter than its neighbours, which goes with a stretch of the outlet: that is damped by
///   rhoA |s'| L^2 d|r_x|/dt   on the stretch,
/// of second order in the length L of an element. Derived: docs/theory/joints.md, Drums.
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
  /// What there is of the beam on a drum that turns with it.
  struct Store {
    double length = std::numeric_limits<double>::infinity();  ///< at t = 0 [m]
  };
  struct Law {
    BeamSection section;
    Winding winding = Winding::stretched;
    double element_length = 0;  ///< L [m]
    TimeFunction push;          ///< [N], negative where the drum pulls
    LineForce line = {};        ///< along the whole beam [N/m], or empty
    std::optional<EndStop> stop = {};
    std::function<double(double t)> stretch = {};  ///< that of what comes in, where the push tells; else the outlet's
    std::optional<Store> store = {};  ///< its kinetic energy, and that of what comes in, are the turning drum's
  };

  Drum(const End& end, Law law) : end_(end), law_(std::move(law)) {}

  EnergyBalance add_force(const Motion<D>& motion, double* force) const override {
    const JointPlace* const end = place(motion.beam);
    if (end == nullptr) return {};  // in the equilibrium before the start
    const double out = end_.outwards(), rate = out * motion.beam.rate[end->mark];
    check_store(motion.beam.q[end->mark], motion.t);
    const Vec<double, D> r = position<D>(motion.beam.q, end->node), line = line_at(motion.t);
    const Vec<double, D> s = slope<D>(motion.beam.q, end->node), s_rate = slope<D>(motion.beam.rate, end->node);
    const ComingIn<double, D> matter(law_.section, law_.winding, rate, slope_of<double>(s, motion.t));
    double push = law_.push(motion.t).value * matter.stretch + matter.strain + matter.kinetic +
                  potential_fed<D>(law_.section.rhoA, motion.gravity, line, r);
    double drag = 0;
    if (law_.stop) {
      const double length = out * (motion.beam.q[end->mark] - end_.from);
      push += law_.stop->push(length);
      drag = law_.stop->drag(length, rate);
    }
    force[end->mark] += out * (push - drag);
    const Vec<double, D> damping = stretch_damping<double>(rate, s, s_rate);
    slope<D>(force, end->node) -= damping;
    return {.dissipated = drag * rate + damping.dot(s_rate),
            .loads = (push - (law_.store ? matter.kinetic : 0)) * rate +
                     line.dot(motion.beam.entering_at(*end))};  // matter has no potential of the line
  }
  double load_power(const Motion<D>& motion, double* scratch) const override {
    return place(motion.beam) == nullptr ? 0 : add_force(motion, scratch).loads;
  }
  void add_tangent(const Motion<D>& motion, const TangentWeights& by, BeamMatrix<D>& tangent) const override {
    const JointPlace* const end = place(motion.beam);
    if (end == nullptr) return;
    const double out = end_.outwards();
    const Eigen::Index mark = end->mark, node = Eigen::Index{node_size<D>} * end->node;
    const Vec<double, D> along = law_.section.rhoA * motion.gravity + line_at(motion.t);
    for (int c = 0; c < D; ++c) tangent.entry(mark, node + c) += by.q * out * along[c];
    // variables: length and rate of what is paid out, slope, rate of the slope
    using Real = Active<2 + 2 * D>;
    const Real length(out * (motion.beam.q[mark] - end_.from), 0), rate(out * motion.beam.rate[mark], 1);
    Vec<Real, D> s, s_rate;
    for (int c = 0; c < D; ++c) {
      s[c] = Real(motion.beam.q[node + D + c], 2 + c);
      s_rate[c] = Real(motion.beam.rate[node + D + c], 2 + D + c);
    }
    const ComingIn<Real, D> matter(law_.section, law_.winding, rate, slope_of<Real>(s, motion.t));
    Real push = matter.stretch * Real(law_.push(motion.t).value) + matter.strain + matter.kinetic;
    if (law_.stop) push += law_.stop->push(length) - law_.stop->drag(length, rate);
    const Vec<Real, D> damping = stretch_damping<Real>(rate, s, s_rate);
    const auto add = [&](Eigen::Index row, const Real& force) {  // of -Q
      tangent.entry(row, mark) -= out * (by.q * force.derivatives()[0] + by.v * force.derivatives()[1]);
      for (int c = 0; c < D; ++c) {
        tangent.entry(row, node + D + c) -= by.q * force.derivatives()[2 + c] + by.v * force.derivatives()[2 + D + c];
      }
    };
    add(mark, push * Real(out));
    for (int c = 0; c < D; ++c) add(node + D + c, -damping[c]);
  }

 private:
  const JointPlace* place(const ChainView<D>& beam) const {
    return beam.joint_at(end_.at_start ? 0 : beam.mesh.last());
  }
  Vec<double, D> line_at(double t) const { return law_.line ? law_.line(t) : Vec<double, D>(Vec<double, D>::Zero()); }
  /// Of what comes in, where s is that of the outlet. A tension that is given tells it to all digits; the outlet's is
  /// that of one point of an element.
  template <class Real>
  Vec<Real, D> slope_of(const Vec<Real, D>& s, double t) const {
    if (!law_.stretch) return s;
    Vec<Real, D> given = Vec<Real, D>::Zero();
    given[0] = Real(law_.stretch(t));
    return given;
  }
  /// What takes from the rate of the stretch at the outlet, a force against the slope [N m].
  template <class Real>
  Vec<Real, D> stretch_damping(const Real& rate, const Vec<Real, D>& s, const Vec<Real, D>& s_rate) const {
    const double L = law_.element_length;
    const Real speed = rate < Real(0) ? Real(-rate) : rate;
    const Real share = Real(law_.section.rhoA * L * L) * speed * Real(s.dot(s_rate)) / Real(s.dot(s));
    return s * share;
  }
  void check_store(double x, double t) const {
    if (!law_.store || !(end_.outwards() * (x - end_.from) > law_.store->length)) return;
    throw ComputationFailed(std::string("the drum at the beam's ") + (end_.at_start ? "start" : "end") +
                                " is empty: the " + six_digits(law_.store->length) +
                                " m that it had wound up have run "
                                "off (its \"wound\", or all that its \"inertia\" can be)",
                            t);
  }

  End end_;
  Law law_;
};

}  // namespace vlbeam
