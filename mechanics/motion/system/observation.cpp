#include "mechanics/motion/system/observation.hpp"

#include <optional>

namespace vlbeam {

template <int D>
Observer<D>::Observer(const BeamSection& section, const Vec<double, D>& gravity, const SumTables& tables,
                      const RotaryInertia<D>* rotary)
    : section_(section), sections_(section), gravity_(gravity), tables_(tables), rotary_(rotary) {}

template <int D>
ElementSums<double, D> Observer<D>::sums(const SummedElement<D>& of, const NodalCubic<double, D>* rest,
                                         StrainExtremes* extremes) const {
  const MovingKinematics<double, D> element = of.kinematics();
  const auto at_rest = [&](const PointMotion<double, D>& at) -> std::optional<RestStrain<double>> {
    if (rest == nullptr) return std::nullopt;
    return rest_strain<D>(combine_nodes(at.s_x, *rest), combine_nodes(at.s_xx, *rest), section_);
  };
  const auto look = [&](const PointMotion<double, D>& at, const std::optional<RestStrain<double>>& strain,
                        Feels feels) {
    if (extremes != nullptr) extremes->add(section_, at, strain ? &*strain : nullptr, feels);
  };
  ElementSums<double, D> sums;
  const auto add = [&](const auto& point, const PointMotion<double, D>& at, const auto*) {
    const BeamSection& section = sections_[point.feels];
    const double wl = point.weight;
    const auto strain = at_rest(at);
    if (strain) {
      const RestStress<double, D> stress(at.r_x, at.r_xx, *strain, section);
      sums.axial += wl * stress.axial;
      sums.bending += wl * stress.bending;
    } else {
      const ElasticStress<double, D> stress(at.r_x, at.r_xx, section.stiffness);
      sums.axial += wl * stress.axial;
      sums.bending += wl * stress.bending;
    }
    look(at, strain, point.feels);
    if (point.feels == Feels::stretch) return;
    sums.template add_motion<false>(point, at, section.rhoA, gravity_);
    if (rotary_ != nullptr) sums.kinetic += 0.5 * wl * rotary_->rhoJ * rotary_->across(at.v_x).squaredNorm();
  };
  const auto motion = [&](double u, const ShapeTable<double>& shape) { return element.at(u, shape); };
  const RestKinematics<double, D, MovingEnds::both>* none = nullptr;  // rest strains stand still here
  for_each_point(element, tables_.of(of.weights.w), of.is_rational(), none, motion, add);
  if (extremes == nullptr) return sums;
  for (const double u : {0.0, 1.0}) {
    const PointMotion<double, D> at = element.at(u, rational_shape(element.weights(), u));
    look(at, at_rest(at), Feels::everything);
  }
  return sums;
}

template <int D>
void Observer<D>::add(const SummedElement<D>& element, const NodalCubic<double, D>* rest, Observation<D>& seen) const {
  StrainExtremes* const extremes = seen.extremes ? &*seen.extremes : nullptr;
  const bool plain = rest == nullptr && rotary_ == nullptr;
  seen.add(plain ? fastest_sum_kernels<D>().all(element, tables_.of(element.weights.w), sections_, gravity_, extremes)
                 : sums(element, rest, extremes));
}

template <int D>
Energy Observer<D>::energies(const SummedElement<D>& element, const NodalCubic<double, D>* rest) const {
  const bool plain = rest == nullptr && rotary_ == nullptr;
  return energy_of(
      plain ? fastest_sum_kernels<D>().energies(element, tables_.of(element.weights.w), sections_, gravity_, nullptr)
            : sums(element, rest, nullptr));
}

template class Observer<2>;
template class Observer<3>;

}  // namespace vlbeam
