#include "core/system/beam_observation.hpp"

#include "core/length_control/chain_motion.hpp"

namespace vlbeam {

namespace {

/// Calls add(observer, element, nodes of its rest shape or null) for these elements, and adds point masses on them.
template <int D, class Add>
void at_elements(const CurrentBeam<D>& beam, const ChainState<D>& chain, int first, int last, double t, int points,
                 Observation<D>& seen, const Add& add) {
  const BeamSection section = beam.model().axis_section();
  const Observer<D> observer(section, beam.gravity(t), beam.tables(points),
                             beam.model().rotary.present() ? &beam.model().rotary : nullptr);
  for (int k = first; k < last; ++k) {
    const SummedElement<D> element{chain.coordinates(k), chain.rates(k),
                                   chain.moves(k) ? beam.model().transport : WeightTransport::frozen,
                                   chain.mesh.weights[static_cast<std::size_t>(k)]};
    if (chain.curved_at_rest()) {
      const NodalCubic<double, D> rest = chain.rest_nodes(k);
      add(observer, element, &rest);
    } else {
      add(observer, element, nullptr);
    }
  }
  for (const PointMass& point : beam.model().masses.points) {
    const int k = chain.mesh.element_at(point.x);
    if (k < first || k >= last) continue;
    const auto at = motion_at(chain, k, point.x, beam.model().transport);
    seen.add_mass(point.mass, at.r, at.v, beam.gravity(t));
  }
}

}  // namespace

template <int D>
void observe_elements(const CurrentBeam<D>& beam, const ChainState<D>& chain, int first, int last, double t, int points,
                      Observation<D>& seen) {
  at_elements(beam, chain, first, last, t, points, seen,
              [&](const Observer<D>& observer, const SummedElement<D>& element, const NodalCubic<double, D>* rest) {
                observer.add(element, rest, seen);
              });
}

template <int D>
Energy energies_of_elements(const CurrentBeam<D>& beam, const ChainState<D>& chain, int first, int last, double t,
                            int points) {
  Observation<D> seen;
  at_elements(beam, chain, first, last, t, points, seen,
              [&](const Observer<D>& observer, const SummedElement<D>& element, const NodalCubic<double, D>* rest) {
                seen.energy += observer.energies(element, rest);
              });
  return seen.energy;
}

template <int D>
Observation<D> observe_beam(const CurrentBeam<D>& beam, const Eigen::VectorXd& y, double t, int points, bool strains) {
  Observation<D> seen;
  if (strains) seen.extremes.emplace();
  observe_elements(beam, beam.chain(y, t), 0, beam.mesh().elements(), t, points, seen);
  for (std::size_t i = 0; i < beam.model().joints.size(); ++i) {
    const auto mass = beam.mass_motion(y, static_cast<int>(i));
    if (mass) seen.add_mass(beam.model().joints[i].law.mass, mass->r, mass->v, beam.gravity(t));
  }
  for (std::size_t i = 0; i < beam.places().size(); ++i) {
    const double x_rate = y[beam.coordinates() + beam.places()[i].mark];
    seen.energy.kinetic += 0.5 * beam.joint(i).law.turning * x_rate * x_rate;
  }
  if (beam.spin()) {
    const Spin::Seen turning =
        beam.spin()->observe(y.data() + beam.angles(), y.data() + beam.coordinates() + beam.angles(),
                             points == own_points ? beam.model().points_of_polynomials() : points);
    seen.energy.kinetic += turning.kinetic;
    seen.energy.torsion += turning.torsion;
    seen.spin_momentum += turning.momentum;
  }
  if (beam.frames()) {
    const Frames::Seen bent = beam.frames()->observe(y.data(), y.data() + beam.coordinates());
    seen.energy.kinetic += bent.kinetic;
    seen.energy.bending += bent.bending;
    seen.energy.torsion += bent.torsion;
    seen.angular_momentum += bent.momentum;
    if (strains) seen.extremes->curvature = bent.curvature;
  }
  const Tally counted = beam.layout().tallies.of(y);
  seen.energy.dissipated = counted.dissipated;
  seen.load_work = counted.loads;
  seen.end_work = counted.ends;
  seen.mesh_work = counted.mesh;
  seen.mass_in = counted.mass;
  seen.energy.supplied = counted.supports;
  return seen;
}

template void observe_elements(const CurrentBeam<2>&, const ChainState<2>&, int, int, double, int, Observation<2>&);
template Energy energies_of_elements(const CurrentBeam<2>&, const ChainState<2>&, int, int, double, int);
template Observation<2> observe_beam(const CurrentBeam<2>&, const Eigen::VectorXd&, double, int, bool);
template void observe_elements(const CurrentBeam<3>&, const ChainState<3>&, int, int, double, int, Observation<3>&);
template Energy energies_of_elements(const CurrentBeam<3>&, const ChainState<3>&, int, int, double, int);
template Observation<3> observe_beam(const CurrentBeam<3>&, const Eigen::VectorXd&, double, int, bool);

}  // namespace vlbeam
