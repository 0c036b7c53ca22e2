#include "core/system/observation.hpp"

namespace vlbeam {

template <int D>
Observer<D>::Observer(const BeamSection& section, const Vec<double, D>& gravity, const BeamRule& rule,
                      const RotaryInertia<D>* rotary)
    : section_(section), sections_(section), gravity_(gravity), polynomial_(rule, unit_weights), rotary_(rotary) {}

template <int D>
template <bool energies_alone>
void Observer<D>::sum(const MovingKinematics<double, D>& element, const NodalCubic<double, D>* rest,
                      Observation<D>& seen) const {
  struct Seen {
    PointMotion<double, D> at;
    RestStrain<double> strain;
  };
  const auto see = [&](double u, const ShapeTable<double>& shape) {
    Seen point{element.at(u, shape), {}};
    if (rest != nullptr) {
      point.strain = rest_strain<D>(combine_nodes(point.at.s_x, *rest), combine_nodes(point.at.s_xx, *rest), section_);
    }
    return point;
  };
  const auto add_strains = [&](const Seen& point, Feels feels) {
    seen.extremes->add(section_, point.at, rest != nullptr ? &point.strain : nullptr, feels);
  };
  const auto visit = [&](const auto& point, const Seen& look, const auto*) {
    const BeamSection& section = sections_[point.feels];
    const double wl = point.weight, mass = wl * section.rhoA;
    const auto& at = look.at;
    if (!energies_alone && seen.extremes) add_strains(look, point.feels);
    if (rest != nullptr) {
      const RestStress<double, D> stress(at.r_x, at.r_xx, look.strain, section);
      seen.energy.axial += wl * stress.axial;
      seen.energy.bending += wl * stress.bending;
    } else {
      const ElasticStress<double, D> stress(at.r_x, at.r_xx, section.stiffness);
      seen.energy.axial += wl * stress.axial;
      seen.energy.bending += wl * stress.bending;
    }
    if (point.feels == Feels::stretch) return;
    seen.energy.kinetic += 0.5 * mass * at.v.squaredNorm();
    if (rotary_ != nullptr) {
      seen.energy.kinetic += 0.5 * wl * rotary_->rhoJ * rotary_->across(at.v_x).squaredNorm();
    }
    seen.energy.gravity -= mass * gravity_.dot(at.r);
    if constexpr (energies_alone) return;
    seen.mass += mass;
    seen.momentum += mass * at.v;
    seen.angular_momentum += mass * moment_about_origin<D>(at.r, at.v);
    seen.mass_moment += mass * at.r;
    const double stretch = at.r_x.norm();
    seen.beam_length += wl * stretch;
    // at a fixed reference point, which moves along the beam
    seen.beam_length_rate +=
        wl * at.r_x.dot(at.v_x + point.mesh_velocity * at.r_xx) / stretch + point.weight_rate * stretch;
  };
  const RestKinematics<double, D, MovingEnds::both>* none = nullptr;  // rest strains stand still here
  if (element.weights() == unit_weights) {
    for_each_point(element, polynomial_, false, none, see, visit);
  } else {
    for_each_point(element, ShapeTabulation(polynomial_.rule, element.weights()), false, none, see, visit);
  }
  if (energies_alone || !seen.extremes) return;
  for (const double u : {0.0, 1.0}) add_strains(see(u, rational_shape(element.weights(), u)), Feels::everything);
}

template class Observer<2>;
template class Observer<3>;

}  // namespace vlbeam
