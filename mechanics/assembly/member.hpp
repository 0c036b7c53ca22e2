#pragma once

#include <memory>

#include "mechanics/assembly/acting_links.hpp"
#include "mechanics/assembly/body.hpp"
#include "mechanics/assembly/link.hpp"
#include "mechanics/motion/system/beam_system.hpp"

namespace vlbeam {

/// One of what an assembly consists of, as equations with events, between which links act.
template <int D>
class Member {
 public:
  virtual ~Member() = default;
  virtual EventedOde& ode() = 0;
  virtual Eigen::Index coordinates() const = 0;
  virtual BalanceEntries balance() const = 0;
  virtual Eigen::VectorXd initial_state() const = 0;
  /// What a link takes hold of, as the member is now. Throws ComputationFailed where it is there no more.
  virtual Handle<D> handle(const LinkEnd<D>& end, double t) const = 0;
  virtual LinkForces<D>& link_forces() = 0;
  /// Brings a state back onto the member's own conditions; false where it has none.
  virtual bool correct(Eigen::VectorXd& /*y*/) const { return false; }
  /// By `points` points an element, or own_points.
  virtual Observation<D> observe(const Eigen::VectorXd& y, double t, int points) const = 0;
};

/// A beam. Its model must have ActingLinks of these forces among its parts.
template <int D>
class BeamMember final : public Member<D> {
 public:
  BeamMember(BeamSystem<D>& system, std::shared_ptr<LinkForces<D>> forces)
      : system_(system), forces_(std::move(forces)) {}

  EventedOde& ode() override { return system_; }
  Eigen::Index coordinates() const override { return system_.coordinates(); }
  BalanceEntries balance() const override { return system_.model().balance(); }
  Eigen::VectorXd initial_state() const override { return system_.initial_state(); }
  Handle<D> handle(const LinkEnd<D>& end, double t) const override;
  LinkForces<D>& link_forces() override { return *forces_; }
  Observation<D> observe(const Eigen::VectorXd& y, double t, int points) const override {
    return system_.observe(y, t, points);
  }

 private:
  BeamSystem<D>& system_;
  std::shared_ptr<LinkForces<D>> forces_;
};

template <int D>
class BodyMember final : public Member<D> {
 public:
  explicit BodyMember(BodySystem<D>& system) : system_(system) {}

  EventedOde& ode() override { return system_; }
  Eigen::Index coordinates() const override { return system_.coordinates(); }
  BalanceEntries balance() const override { return system_.balance(); }
  Eigen::VectorXd initial_state() const override { return system_.initial_state(); }
  Handle<D> handle(const LinkEnd<D>& end, double /*t*/) const override {
    return end.direction ? system_.direction(end.place) : system_.point(end.place);
  }
  LinkForces<D>& link_forces() override { return system_.link_forces(); }
  bool correct(Eigen::VectorXd& y) const override { return system_.square_up(y); }
  Observation<D> observe(const Eigen::VectorXd& y, double t, int /*points*/) const override {
    return system_.observe(y, t);
  }

 private:
  BodySystem<D>& system_;
};

}  // namespace vlbeam
