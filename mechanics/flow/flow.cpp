#include "mechanics/flow/flow.hpp"

#include "core/element/moving_tangent.hpp"
#include "mechanics/flow/driven_residual.hpp"
#include "mechanics/ropes/drag.hpp"
#include "mechanics/spin/spin_unknowns.hpp"

namespace vlbeam {

template <int D>
double Flow<D>::add_residual(const double* q, const double* rate, const double* a, double t, double* r) {
  beam_.fill_elements(q, rate, t, elements_);
  mesh().add_residual(elements_, a, r);
  forces_.setZero(beam_.coordinates());
  mesh().add_entering(beam_.view(q, rate), forces_.data());
  Eigen::Map<Eigen::VectorXd>(r, beam_.dofs().mark()) -= forces_.head(beam_.dofs().mark());
  double lost = 0;
  for (const auto& element : elements_) lost += element.dissipation;
  return lost;
}

template <int D>
EnergyBalance Flow<D>::power(const Elements* of, const double* q, const double* rate, const double* a, double t) {
  const FlowRoom<D>& room = *room_of<FlowRoom<D>>(beam_.model());
  if (!room.books) return {};
  const Elements& elements = of == nullptr ? elements_ : *of;
  const std::vector<Prescribed>& marks = mesh().marks();
  const ChainView<D> beam = beam_.view(q, rate);
  const Eigen::Index turns = beam_.angles();
  Spin* const spin = spin_of(beam_);
  residual_.setZero(beam_.coordinates());
  mesh().add_residual(elements, a, residual_.data());
  if (spin != nullptr) spin->inner_residual(q + turns, rate + turns, a + turns, residual_.data() + turns);
  double power = residual_.dot(Eigen::Map<const Eigen::VectorXd>(rate, beam_.coordinates()));  // all that comes in
  double loads = 0, meshed = 0;
  const auto drive = [&](int k, double force) {  // along the beam at node k
    const double p = force * marks[static_cast<std::size_t>(k)].rate;
    power += p;
    if (k > 0 && k < beam_.mesh().last()) meshed += p;
  };
  const Vector line = beam_.model().loads.line_force ? beam_.model().loads.line_force(t) : Vector::Zero();
  for (const MovingPart& part : beam_.moving_parts()) {
    const int k = part.element;
    const auto i = static_cast<std::size_t>(k);
    auto [force_a, force_b] = guiding_forces(elements[i], mesh().accelerations(a, k));
    if (spin != nullptr) {
      const auto& by_spin = spin->guiding_forces(k);
      force_a += by_spin[0];
      force_b += by_spin[1];
    }
    if (beam_.model().loads.line_force) {
      // moving_equations took the line force for a potential, of which the moving ends carry a part; it is none
      const MovingKinematics<double, D> kinematics = beam.kinematics(k);
      for (const auto& [u, w, feels] : with_mass(part.table.rule)) {
        const PointMotion<double, D> point = kinematics.at(u, rational_shape(kinematics.weights(), u));
        const double along = line.dot(point.r_x) * kinematics.length();
        force_a += w * ((1 - u) * along - line.dot(point.r));
        force_b += w * (u * along + line.dot(point.r));
        const double work = w * kinematics.length() * line.dot(point.v);
        loads += work;
        power += work;
      }
    }
    if (room.rotary.present()) {  // what its nodes' residual does not supply comes in along the beam
      power += mesh().rotary_power(beam, part, a);
    }
    drive(k, force_a);
    drive(k + 1, force_b);
  }
  // of concentrated loads and torques, on material points: what is along the beam goes into the motion of the nodes
  on_marks_.assign(marks.size(), 0);
  forces_.setZero(beam_.coordinates());
  loads += beam_.model().loads.add_forces(beam, t, forces_.data(), on_marks_.data());
  if (spin != nullptr) {
    loads += spin->add_torques(q + turns, rate + turns, t, forces_.data() + turns, on_marks_.data());
  }
  double taken = 0;
  if (const Drag<D>* const drag = drag_of(beam_.model()))
    taken = drag->add_forces(beam, forces_.data(), on_marks_.data()).dissipated;
  for (int k = 1; k < beam_.mesh().last(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    meshed -= on_marks_[i] * marks[i].rate;
  }

  EnergyBalance result;
  result.ends = power + taken - loads - meshed;
  result.loads = loads;
  result.mesh = meshed;
  result.mass = beam_.model().section.rhoA * (marks.back().rate - marks.front().rate);
  Vector impulse = beam_.beam_gravity(t) * (beam_.model().section.rhoA * (marks.back().value - marks.front().value));
  for (int k = 0; k <= beam_.mesh().last(); ++k) impulse += position<D>(residual_.data(), k);
  result.impulse.template head<D>() = impulse;
  for (int k = 0; spin != nullptr && k <= beam_.mesh().last(); ++k)
    result.impulse_about_axis += residual_[angle_of(beam_, k)];
  return result;
}

/// Elements whose nodes all travel as prescribed, and what flows in.
template <int D>
void Flow<D>::add_tangent(const Motion<D>& now, const TangentWeights& by, BeamMatrix<D>& tangent) const {
  beam_.move_nodes(now.t);
  const RotaryInertia<D>& rotary = room_of<FlowRoom<D>>(beam_.model())->rotary;
  const MovingMesh<D>& mesh = this->mesh();
  const ChainView<D>& beam = now.beam;
  MovingLaw<D> law = beam_.moving_law(now.t);
  for (const MovingPart& part : beam_.moving_parts()) {
    const auto rest = beam_.rest_of(part, beam.q);
    law.rest = rest ? &*rest : nullptr;
    const int k = part.element;
    tangent.add_element(
        beam, k,
        moving_tangent<MovingEnds::both, D, 0>(beam.coordinates(k), beam.rates(k), mesh.accelerations(now.a, k), by,
                                               beam.weights(k), part.table, law));
    if (!rotary.present()) continue;
    const auto i = static_cast<std::size_t>(k);
    tangent.add_element(beam, k, RotaryElement(mesh.marks()[i], mesh.marks()[i + 1], part.table).tangent(rotary, by));
  }
  mesh.add_inflow_tangent(beam, by, [&](int row, int column, const auto& block) {
    auto& band = column == row ? tangent.diagonal : column > row ? tangent.upper : tangent.lower;
    band[static_cast<std::size_t>(row)] += block;
  });
}

template class Flow<2>;
template class Flow<3>;

}  // namespace vlbeam
