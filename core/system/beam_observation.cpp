#include "core/length_control/chain_motion.hpp"
#include "core/system/beam_system.hpp"

namespace vlbeam {

template <int D>
void BeamSystem<D>::observe_elements(const ChainState<D>& chain, int first, int last, double t, int points,
                                     Observation<D>& seen) const {
  const BeamSection section = model_.axis_section();
  const Observer<D> observer(section, gravity(t), beam_rule(points, model_.axial_strain),
                             model_.rotary.present() ? &model_.rotary : nullptr);
  for (int k = first; k < last; ++k) {
    const MovingKinematics<double, D> element(chain.coordinates(k), chain.rates(k),
                                              chain.moves(k) ? model_.transport : WeightTransport::frozen,
                                              chain.mesh.weights[static_cast<std::size_t>(k)]);
    if (chain.curved_at_rest()) {
      const NodalCubic<double, D> rest = chain.rest_nodes(k);
      observer.add(element, &rest, seen);
    } else {
      observer.add(element, nullptr, seen);
    }
  }
  for (const PointMass& point : model_.masses.points) {
    const int k = chain.mesh.element_at(point.x);
    if (k < first || k >= last) continue;
    const auto at = motion_at(chain, k, point.x, model_.transport);
    seen.add_mass(point.mass, at.r, at.v, gravity(t));
  }
}

template <int D>
double BeamSystem<D>::line_power(const ChainView<D>& beam, double t) const {
  if (!model_.loads.line_force) return 0;
  const double rhoA = model_.section.rhoA;
  Vector sum = (left_->first_moment(beam.rate) + right_->first_moment(beam.rate)) / rhoA;
  for (const SpanBetween<D>& span : between_) sum += span.span().first_moment(beam.rate) / rhoA;
  for (const MovingPart& part : parts_) {
    const bool reshaped =
        model_.transport == WeightTransport::transported && beam.weights(part.element).w != unit_weights;
    sum += swept(beam.kinematics(part.element), part.tables.one, reshaped, model_.formulation);
  }
  return model_.loads.line_force(t).dot(sum - beam.inflow());  // what comes in is not moved by it
}

template <int D>
Observation<D> BeamSystem<D>::observe(const Eigen::VectorXd& y, double t, int points, bool strains) const {
  Observation<D> seen;
  if (strains) seen.extremes.emplace();
  observe_elements(chain(y, t), 0, mesh_.elements(), t, points, seen);
  for (std::size_t i = 0; i < model_.joints.size(); ++i) {
    const auto mass = mass_motion(y, static_cast<int>(i));
    if (mass) seen.add_mass(model_.joints[i].law.mass, mass->r, mass->v, gravity(t));
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const double x_rate = y[coordinates() + places_[i].mark];
    seen.energy.kinetic += 0.5 * joint(i).law.turning * x_rate * x_rate;
  }
  if (spin_) {
    const Spin::Seen turning = spin_->observe(y.data() + angles(), y.data() + coordinates() + angles(), points);
    seen.energy.kinetic += turning.kinetic;
    seen.energy.torsion += turning.torsion;
    seen.spin_momentum += turning.momentum;
  }
  if (frames_) {
    const Frames::Seen bent = frames_->observe(y.data(), y.data() + coordinates());
    seen.energy.kinetic += bent.kinetic;
    seen.energy.bending += bent.bending;
    seen.energy.torsion += bent.torsion;
    seen.angular_momentum += bent.momentum;
    if (strains) seen.extremes->curvature = bent.curvature;
  }
  const Tally counted = layout_.tallies.of(y);
  seen.energy.dissipated = counted.dissipated;
  seen.load_work = counted.loads;
  seen.end_work = counted.ends;
  seen.mesh_work = counted.mesh;
  seen.mass_in = counted.mass;
  seen.energy.supplied = counted.supports;
  seen.energy.supplied += ramp_.until(t, {seen.mass_moment, moment_rate(seen, y)});
  return seen;
}

template void BeamSystem<2>::observe_elements(const ChainState<2>&, int, int, double, int, Observation<2>&) const;
template double BeamSystem<2>::line_power(const ChainView<2>&, double) const;
template Observation<2> BeamSystem<2>::observe(const Eigen::VectorXd&, double, int, bool) const;
template void BeamSystem<3>::observe_elements(const ChainState<3>&, int, int, double, int, Observation<3>&) const;
template double BeamSystem<3>::line_power(const ChainView<3>&, double) const;
template Observation<3> BeamSystem<3>::observe(const Eigen::VectorXd&, double, int, bool) const;

}  // namespace vlbeam
