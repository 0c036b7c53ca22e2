// A beam whose nodes travel along it as prescribed: what its guards are, and what flows in and out.
#include <algorithm>

#include "core/element/driven_residual.hpp"
#include "core/error.hpp"
#include "core/system/beam_system.hpp"

namespace vlbeam {
namespace {

enum TravelGuard { nodes_tangle, weight_is_lost };

}  // namespace

template <int D>
Guards BeamSystem<D>::travel_guards(double t) const {
  travel(t);
  const bool reshapes = model_.transport == WeightTransport::transported;
  return {{nodes_tangle, 0, moving_->tangle()},
          {weight_is_lost, 0, reshapes ? moving_->least_weight(mesh_.weights) : -1}};
}

template <int D>
void BeamSystem<D>::stop_travelling(int index, double t) const {
  travel(t);
  throw ComputationFailed(index == weight_is_lost ? "a transported weight is about to vanish" : moving_->tangled(t), t);
}

template <int D>
double BeamSystem<D>::add_travelling_residual(const double* q, const double* rate, const double* a, double t,
                                              double* r) {
  fill_elements(q, rate, t, elements_);
  moving_->add_residual(elements_, a, r);
  flow_forces_.setZero(coordinates());
  moving_->add_inflow(view(q, rate), flow_forces_.data());
  Eigen::Map<Eigen::VectorXd>(r, layout_.mark()) -= flow_forces_.head(layout_.mark());
  double lost = 0;
  for (const auto& element : elements_) lost += element.dissipation;
  return lost;
}

template <int D>
Tally BeamSystem<D>::flow_power(const double* q, const double* rate, const double* a, double t) {
  const std::vector<Prescribed>& marks = moving_->marks();
  const ChainView<D> beam = view(q, rate);
  const Eigen::Index turns = angles();
  flow_residual_.setZero(coordinates());
  moving_->add_residual(elements_, a, flow_residual_.data());
  if (spin_) spin_->inner_residual(q + turns, rate + turns, a + turns, flow_residual_.data() + turns);
  double power = flow_residual_.dot(Eigen::Map<const Eigen::VectorXd>(rate, coordinates()));  // all that comes in
  double loads = 0, mesh = 0;
  const auto drive = [&](int k, double force) {  // along the beam at node k
    const double p = force * marks[static_cast<std::size_t>(k)].rate;
    power += p;
    if (k > 0 && k < mesh_.last()) mesh += p;
  };
  const Vector line = model_.loads.line_force ? model_.loads.line_force(t) : Vector::Zero();
  for (const MovingPart& part : parts_) {
    const int k = part.element;
    const auto i = static_cast<std::size_t>(k);
    auto [force_a, force_b] = guiding_forces(elements_[i], moving_->accelerations(a, k));
    if (spin_) {
      const auto spin = spin_->guiding_forces(k, a + turns);
      force_a += spin[0];
      force_b += spin[1];
    }
    if (model_.loads.line_force) {
      // moving_equations took the line force for a potential, of which the moving ends carry a part; it is none
      const MovingKinematics<double, D> kinematics = beam.kinematics(k);
      for (const auto& [u, w, feels] : with_mass(part.tables.one.rule)) {
        const PointMotion<double, D> point = kinematics.at(u, rational_shape(kinematics.weights(), u));
        const double along = line.dot(point.r_x) * kinematics.length();
        force_a += w * ((1 - u) * along - line.dot(point.r));
        force_b += w * (u * along + line.dot(point.r));
        const double work = w * kinematics.length() * line.dot(point.v);
        loads += work;
        power += work;
      }
    }
    if (model_.rotary.present()) {  // what its nodes' residual does not supply comes in along the beam
      power += moving_->rotary_power(beam, part, a);
    }
    drive(k, force_a);
    drive(k + 1, force_b);
  }
  // of concentrated loads and torques, on material points: what is along the beam goes into the motion of the nodes
  on_marks_.assign(marks.size(), 0);
  flow_forces_.setZero(coordinates());
  loads += model_.loads.add_forces(beam, t, flow_forces_.data(), on_marks_.data());
  if (spin_) {
    loads += spin_->add_torques(q + turns, rate + turns, t, flow_forces_.data() + turns, on_marks_.data());
  }
  double taken = 0;
  if (model_.drag.present()) taken = model_.drag.add_forces(beam, flow_forces_.data(), on_marks_.data()).dissipated;
  for (int k = 1; k < mesh_.last(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    mesh -= on_marks_[i] * marks[i].rate;
  }

  Tally result;
  result.ends = power + taken - loads - mesh;
  result.loads = loads;
  result.mesh = mesh;
  result.mass = model_.section.rhoA * (marks.back().rate - marks.front().rate);
  Vector impulse = beam_gravity(t) * (model_.section.rhoA * (marks.back().value - marks.front().value));
  for (int k = 0; k <= mesh_.last(); ++k) impulse += position<D>(flow_residual_.data(), k);
  result.impulse.template head<D>() = impulse;
  for (int k = 0; spin_ && k <= mesh_.last(); ++k) result.spin_impulse += flow_residual_[angle(k)];
  return result;
}

template Guards BeamSystem<2>::travel_guards(double) const;
template Guards BeamSystem<3>::travel_guards(double) const;
template void BeamSystem<2>::stop_travelling(int, double) const;
template void BeamSystem<3>::stop_travelling(int, double) const;
template double BeamSystem<2>::add_travelling_residual(const double*, const double*, const double*, double, double*);
template double BeamSystem<3>::add_travelling_residual(const double*, const double*, const double*, double, double*);
template Tally BeamSystem<2>::flow_power(const double*, const double*, const double*, double);
template Tally BeamSystem<3>::flow_power(const double*, const double*, const double*, double);

}  // namespace vlbeam
