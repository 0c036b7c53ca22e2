#pragma once

#include <optional>

#include "mechanics/motion/system/current_beam.hpp"
#include "mechanics/spin/nut.hpp"
#include "mechanics/spin/spin_room.hpp"

namespace vlbeam {

/// The angles of a section that spins, at the nodes that there were at t = 0: joints and what they do to the mesh leave
/// them alone; where all nodes travel, at these. A nut is a joint that is tied to them.
template <int D>
class SpinUnknowns final : public Unknowns<D> {
 public:
  /// `beam` must outlive this object; `x` are the material coordinates of its nodes.
  SpinUnknowns(const CurrentBeam<D>& beam, const std::vector<double>& x);

  Spin& spin() const { return spin_; }
  const Nut& nut() const { return *nut_; }

  Eigen::Index count() const override { return spin_.coordinates(); }
  void add_fields(Eigen::Index first, std::vector<FieldRun>& runs) const override;
  void start(double* q, double* rate) override;
  void write(const ChainState<D>& chain, const double* old_q, const double* old_rate, double* q,
             double* rate) const override;
  void move() override { spin_.move(*beam_.marks()); }

  bool ties(std::size_t joint) const override { return nut_ && spin_.model().pitch_of(beam_.joint_index(joint)) != 0; }
  typename Unknowns<D>::Tied tied(std::size_t joint, const double* q, const double* rate) const override;

  bool accelerate(const double* q, const double* rate, double t, double* a, double& dissipated) override;
  bool load(const double* q, const double* rate, double* a, std::vector<JointMotion<D>>& joints) override;
  void follow(const double* q, const double* rate, double* a) override;
  bool supplied() const override { return spin_.model().supplied(); }
  EnergyBalance power(const double* q, const double* rate, const double* a, double t, const double* free) override;

  double residual(const double* q, const double* v, const double* a, double t, double* r) override;
  void inertia(const double* a, double* r) const override { spin_.inertia(a + at(), r + at()); }
  std::unique_ptr<UnknownsTangent<D>> new_tangent() override;

  void observe(const double* q, const double* rate, int points, Observation<D>& seen) const override;
  void observe_forces(const double* q, const double* v, const double* free, OuterForces<D>& forces) const override;

  /// Where the angles stand, and the place of the nut among the joints on the beam; nothing where there is none.
  Eigen::Index at() const { return beam_.angles(); }
  std::optional<std::size_t> nut_place() const;
  /// What the thread does to the angles as it pushes the nut [N].
  Eigen::VectorXd nut_torque(std::size_t which, const double* q, const double* v, double push) const {
    return nut_->torque(spin_, q + at(), v + at(), q[beam_.places()[which].mark], push);
  }
  const CurrentBeam<D>& beam() const { return beam_; }

 private:
  const CurrentBeam<D>& beam_;
  mutable Spin spin_;
  std::optional<Nut> nut_;
  const Eigen::VectorXd* by_nut_ = nullptr;  ///< after follow()
};

extern template class SpinUnknowns<2>;
extern template class SpinUnknowns<3>;

/// How the section of a beam turns; null if it does not.
template <int D>
Spin* spin_of(const CurrentBeam<D>& beam) {
  const auto* const of = dynamic_cast<const SpinUnknowns<D>*>(beam.unknowns());
  return of == nullptr ? nullptr : &of->spin();
}

/// Where the angle of a node of the mesh at t = 0 stands.
template <int D>
Eigen::Index angle_of(const CurrentBeam<D>& beam, int node) {
  return beam.angles() + spin_of(beam)->angle(node);
}

}  // namespace vlbeam
