#include "mechanics/motion/system/beam_system.hpp"

#include "core/error.hpp"
#include "mechanics/motion/system/beam_observation.hpp"
#include "mechanics/motion/system/implicit_beam.hpp"

namespace vlbeam {

template <int D>
BeamSystem<D>::BeamSystem(const BeamModel<D>& of, const ChainState<D>& chain)
    : Beam(of, chain),
      links_(*this),
      mass_(*this, links_),
      accelerations_(*this, links_, mass_),
      velocities_(*this, mass_),
      sources_(sources_of_rooms<D>({*this, links_, mass_, accelerations_})) {
  if (of.driven() && !of.joints.empty() && of.length_control.velocities == VelocityTransfer::conservative) {
    throw ModelError("velocities at events", "\"conservative\"",
                     "moving supports need \"nodal\" or \"projected\": they give energy and momentum away");
  }
  initial_ = Beam::start(chain);
  links_.tie_blocks(initial_.data());
  adopt_parts();
  Beam::impose(initial_, 0);
  come_back_to_links(initial_, 0);
  ramp_ = RampWork<D>(of.gravity, of.gravity_ramp);
}

template <int D>
std::string BeamSystem<D>::fastest(const Eigen::VectorXd& y) const {
  double most = 0;
  std::string who;
  const auto look = [&](double speed, const std::string& name) {
    if (!(speed > most)) return;
    most = speed;
    who = name;
  };
  const double* const rate = y.data() + coordinates();
  for (std::size_t i = 0; i < places().size(); ++i) {
    const std::string end = places()[i].node == 0 ? "start" : "end";
    look(std::abs(rate[places()[i].mark]),
         Beam::feeds(i) ? "the beam that is paid out at its " + end : "the joint " + std::to_string(joint_index(i)));
  }
  for (int k = 0; k <= mesh().last(); ++k) {
    look(position<D>(rate, k).norm(), "node " + std::to_string(k));
    look(slope<D>(rate, k).norm() * model().length_control.standard_length, "the slope of node " + std::to_string(k));
  }
  return who.empty() ? "" : who + " moves fastest, at " + six_digits(most) + " m/s";
}

template <int D>
BeamSystem<D>::~BeamSystem() = default;

template <int D>
void BeamSystem<D>::take(const ChainState<D>& chain) {
  Beam::adopt(chain);
  links_.adopt();
  adopt_parts();
}

/// Sources first: they may tell the links what rests.
template <int D>
void BeamSystem<D>::adopt_parts() {
  for (const auto& source : sources_) source->adopt();
  mass_.adopt();
  accelerations_.adopt();
}

template <int D>
void BeamSystem<D>::sample(const Eigen::VectorXd& y, double t) {
  if (!on_sample) return;
  if (!Beam::imposes()) return on_sample(y, t);
  Eigen::VectorXd exact = y;
  Beam::impose(exact, t);
  on_sample(exact, t);
}

template <int D>
Observation<D> BeamSystem<D>::observe(const Eigen::VectorXd& y, double t, int points, bool strains) const {
  Observation<D> seen = observe_beam(*this, y, t, points, strains);
  seen.energy.supplied += ramp_.until(t, {seen.mass_moment, moment_rate(seen, y)});
  return seen;
}

template <int D>
ConstrainedSystem* BeamSystem<D>::second_order() {
  if (!implicit_) implicit_ = std::make_unique<ImplicitBeam<D>>(accelerations_);
  return implicit_.get();
}

template <int D>
void BeamSystem<D>::jacobian(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) {
  second_order();
  implicit_->jacobian(y, t, dfdy, dfdt);
}

template <int D>
std::unique_ptr<SecondOrderSystem> BeamSystem<D>::new_second_order() {
  return std::make_unique<ImplicitBeam<D>>(accelerations_);
}

template <int D>
void BeamSystem<D>::exchange(Archive& memory) {
  std::size_t evaluations = rhs_evaluations();
  memory(evaluations);
  accelerations_.set_evaluations(evaluations);
  ramp_.exchange(memory);
  if (Beam::unknowns() != nullptr) Beam::unknowns()->exchange(memory);
  bool viewed = implicit_ != nullptr;
  memory(viewed);
  if (viewed) second_order()->exchange(memory);
}

template <int D>
OuterForces<D> BeamSystem<D>::forces(const Eigen::VectorXd& y, double t) {
  second_order();
  const std::size_t evaluations = rhs_evaluations();  // those of the integrator
  const OuterForces<D> forces = implicit_->forces(y, t);
  accelerations_.set_evaluations(evaluations);
  return forces;
}

template <int D>
OuterForces<D> BeamSystem<D>::forces_at_rest(const Eigen::VectorXd& y, double t, const Eigen::VectorXd& of_links) {
  second_order();
  return implicit_->forces_at_rest(y, t, of_links);
}

template <int D>
void BeamSystem<D>::correct(Eigen::VectorXd& y, double t) {
  if (corrects) come_back_to_links(y, t);
}

/// Along what impulses of the links would do: Newton's iteration for the positions, whose conditions are quadratic at
/// most or nearly linear so near to them.
template <int D>
void BeamSystem<D>::come_back_to_links(Eigen::VectorXd& y, double t) {
  if (!links_.holds_points()) return;
  constexpr int most_rounds = 4;
  const std::vector<BeamLink<D>> held = links_.tied();
  const Eigen::Index n = coordinates(), count = std::ssize(held);
  const double nothing = 1e-15 * mesh().length();
  Eigen::VectorXd off(count), change(n);
  for (int round = 0; round < most_rounds; ++round) {
    const ChainView<D> beam = Beam::view(y.data(), y.data() + n);
    for (Eigen::Index i = 0; i < count; ++i) off[i] = held[static_cast<std::size_t>(i)].value(beam);
    if (!(off.cwiseAbs().maxCoeff() > nothing)) break;
    change.setZero();
    if (!mass_.press(held, Beam::masses_at(y, t), y.data(), -off, change.data())) return;
    y.head(n) += change;
  }
  const ChainView<D> beam = Beam::view(y.data(), y.data() + n);
  for (Eigen::Index i = 0; i < count; ++i) off[i] = held[static_cast<std::size_t>(i)].rate(beam);
  if (off.isZero(0)) return;
  change.setZero();
  if (mass_.press(held, Beam::masses_at(y, t), y.data(), -off, change.data())) y.segment(n, n) += change;
}

template class BeamSystem<2>;
template class BeamSystem<3>;

}  // namespace vlbeam
