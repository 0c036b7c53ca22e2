#include "mechanics/motion/system/beam_observation.hpp"

#include <optional>

#include "core/length_control/chain_motion.hpp"
#include "core/pieces.hpp"

namespace vlbeam {

namespace {

template <int D>
std::optional<NodalCubic<double, D>> rest_nodes(const ChainState<D>& chain, int k) {
  return chain.curved_at_rest() ? std::optional(chain.rest_nodes(k)) : std::nullopt;
}
/// A view knows no rest shape: it is for beams that are straight at rest.
template <int D>
std::optional<NodalCubic<double, D>> rest_nodes(const ChainView<D>& /*chain*/, int /*k*/) {
  return std::nullopt;
}

template <int D, class Chain>
SummedElement<D> element_of(const CurrentBeam<D>& beam, const Chain& chain, int k) {
  return {chain.coordinates(k), chain.rates(k), chain.moves(k) ? beam.model().transport : WeightTransport::frozen,
          chain.mesh.weights[static_cast<std::size_t>(k)]};
}

/// The sum of what add(sum, observer, element, nodes of its rest shape or null) adds for these elements of a ChainState
/// or a ChainView. `none` is that of none.
template <int D, class Chain, class Sum, class Add>
Sum sum_of_elements(const CurrentBeam<D>& beam, const Chain& chain, int first, int last, double t, int points,
                    const Sum& none, const Add& add) {
  const BeamSection section = beam.model().axis_section();
  const PrescribedMesh<D>* const mesh = beam.prescribed_mesh();
  const Observer<D> observer(section, beam.gravity(t), beam.tables(points),
                             mesh != nullptr ? mesh->section_inertia() : nullptr, beam.model().several_sections());
  return sum_in_pieces<Sum>(last - first, node_size<D>, [&](std::ptrdiff_t start, std::ptrdiff_t count) {
    Sum sum = none;
    for (int k = first + static_cast<int>(start), end = k + static_cast<int>(count); k < end; ++k) {
      const auto rest = rest_nodes(chain, k);
      add(sum, observer, element_of(beam, chain, k), rest ? &*rest : nullptr);
    }
    return sum;
  });
}

template <int D, class Chain>
void add_point_masses(const CurrentBeam<D>& beam, const Chain& chain, int first, int last, double t,
                      Observation<D>& seen) {
  for (const PointMass& point : beam.model().masses.points) {
    const int k = chain.element_at(point.x);
    if (k < first || k >= last) continue;
    const auto at = motion_at(element_of(beam, chain, k).kinematics(), point.x);
    seen.add_mass(point.mass, at.r, at.v, beam.gravity(t));
  }
}

template <int D, class Chain>
Observation<D> observe_chain(const CurrentBeam<D>& beam, const Chain& chain, int first, int last, double t, int points,
                             bool strains) {
  Observation<D> none;
  if (strains) none.extremes.emplace();
  Observation<D> seen =
      sum_of_elements(beam, chain, first, last, t, points, none,
                      [](Observation<D>& sum, const Observer<D>& observer, const SummedElement<D>& element,
                         const NodalCubic<double, D>* rest) { observer.add(element, rest, sum); });
  add_point_masses(beam, chain, first, last, t, seen);
  return seen;
}

}  // namespace

template <int D>
Observation<D> observe_elements(const CurrentBeam<D>& beam, const ChainState<D>& chain, int first, int last, double t,
                                int points, bool strains) {
  return observe_chain(beam, chain, first, last, t, points, strains);
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
  const bool needs_chain = beam.model().rest || beam.prescribed_mesh() != nullptr;
  const int elements = beam.mesh().elements();
  Observation<D> seen = needs_chain ? observe_chain(beam, beam.chain(y, t), 0, elements, t, points, strains)
                                    : observe_chain(beam, beam.view(y.data(), y.data() + beam.coordinates()), 0,
                                                    elements, t, points, strains);
  for (std::size_t i = 0; i < beam.model().joints.size(); ++i) {
    const auto mass = beam.mass_motion(y, static_cast<int>(i));
    if (mass) seen.add_mass(beam.model().joints[i].law.mass, mass->r, mass->v, beam.gravity(t));
  }
  for (std::size_t i = 0; i < beam.places().size(); ++i) {
    const double x_rate = y[beam.coordinates() + beam.places()[i].mark];
    seen.energy.kinetic += 0.5 * beam.turning_inertia(i, y.data()) * x_rate * x_rate;
  }
  if (beam.unknowns() != nullptr) {
    beam.unknowns()->observe(y.data(), y.data() + beam.coordinates(),
                             points == own_points ? beam.model().points_of_polynomials() : points, seen);
  }
  const EnergyBalance counted = beam.dofs().balance.of(y);
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
