#include "core/system/beam_observation.hpp"

#include "core/length_control/chain_motion.hpp"
#include "core/pieces.hpp"

namespace vlbeam {

namespace {

/// The sum of what add(sum, observer, element, nodes of its rest shape or null) adds for these elements. `none` is that
/// of none.
template <int D, class Sum, class Add>
Sum sum_of_elements(const CurrentBeam<D>& beam, const ChainState<D>& chain, int first, int last, double t, int points,
                    const Sum& none, const Add& add) {
  const BeamSection section = beam.model().axis_section();
  const Observer<D> observer(section, beam.gravity(t), beam.tables(points),
                             beam.model().rotary.present() ? &beam.model().rotary : nullptr);
  return sum_in_pieces<Sum>(last - first, node_size<D>, [&](std::ptrdiff_t start, std::ptrdiff_t count) {
    Sum sum = none;
    for (int k = first + static_cast<int>(start), end = k + static_cast<int>(count); k < end; ++k) {
      const SummedElement<D> element{chain.coordinates(k), chain.rates(k),
                                     chain.moves(k) ? beam.model().transport : WeightTransport::frozen,
                                     chain.mesh.weights[static_cast<std::size_t>(k)]};
      if (chain.curved_at_rest()) {
        const NodalCubic<double, D> rest = chain.rest_nodes(k);
        add(sum, observer, element, &rest);
      } else {
        add(sum, observer, element, nullptr);
      }
    }
    return sum;
  });
}

template <int D>
void add_point_masses(const CurrentBeam<D>& beam, const ChainState<D>& chain, int first, int last, double t,
                      Observation<D>& seen) {
  for (const PointMass& point : beam.model().masses.points) {
    const int k = chain.mesh.element_at(point.x);
    if (k < first || k >= last) continue;
    const auto at = motion_at(chain, k, point.x, beam.model().transport);
    seen.add_mass(point.mass, at.r, at.v, beam.gravity(t));
  }
}

}  // namespace

template <int D>
Observation<D> observe_elements(const CurrentBeam<D>& beam, const ChainState<D>& chain, int first, int last, double t,
                                int points, bool strains) {
  Observation<D> none;
  if (strains) none.extremes.emplace();
  Observation<D> seen =
      sum_of_elements(beam, chain, first, last, t, points, none,
                      [](Observation<D>& sum, const Observer<D>& observer, const SummedElement<D>& element,
                         const NodalCubic<double, D>* rest) { observer.add(element, rest, sum); });
  add_point_masses(beam, chain, first, last, t, seen);
  return seen;
}

template <int D>
Energy energies_of_elements(const CurrentBeam<D>& beam, const ChainState<D>& chain, int first, int last, double t,
                            int points) {
  Observation<D> seen;
  seen.energy = sum_of_elements(beam, chain, first, last, t, points, Energy{},
                                [](Energy& sum, const Observer<D>& observer, const SummedElement<D>& element,
                                   const NodalCubic<double, D>* rest) { sum += observer.energies(element, rest); });
  add_point_masses(beam, chain, first, last, t, seen);
  return seen.energy;
}

template <int D>
Observation<D> observe_beam(const CurrentBeam<D>& beam, const Eigen::VectorXd& y, double t, int points, bool strains) {
  Observation<D> seen = observe_elements(beam, beam.chain(y, t), 0, beam.mesh().elements(), t, points, strains);
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

template Observation<2> observe_elements(const CurrentBeam<2>&, const ChainState<2>&, int, int, double, int, bool);
template Energy energies_of_elements(const CurrentBeam<2>&, const ChainState<2>&, int, int, double, int);
template Observation<2> observe_beam(const CurrentBeam<2>&, const Eigen::VectorXd&, double, int, bool);
template Observation<3> observe_elements(const CurrentBeam<3>&, const ChainState<3>&, int, int, double, int, bool);
template Energy energies_of_elements(const CurrentBeam<3>&, const ChainState<3>&, int, int, double, int);
template Observation<3> observe_beam(const CurrentBeam<3>&, const Eigen::VectorXd&, double, int, bool);

}  // namespace vlbeam
