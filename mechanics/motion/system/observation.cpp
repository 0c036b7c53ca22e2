#include "mechanics/motion/system/observation.hpp"

#include <optional>
#include <type_traits>

#include "core/element/piece_bending.hpp"

namespace vlbeam {

template <int D>
Observer<D>::Observer(const BeamSection& section, const Vec<double, D>& gravity, const SumTables& tables,
                      const SectionInertia<D>* inertia, const SectionPieces* pieces)
    : section_(section), sections_(section), gravity_(gravity), tables_(tables), inertia_(inertia), pieces_(pieces) {}

template <int D>
ElementSums<double, D> Observer<D>::by_points(const SummedElement<D>& of, const FeltSections& sections,
                                              const NodalCubic<double, D>* rest, StrainExtremes* extremes) const {
  const MovingKinematics<double, D> element = of.kinematics();
  const auto at_rest = [&](const BeamSection& section,
                           const PointMotion<double, D>& at) -> std::optional<RestStrain<double>> {
    if (rest == nullptr) return std::nullopt;
    return rest_strain<D>(combine_nodes(at.s_x, *rest), combine_nodes(at.s_xx, *rest), section);
  };
  const auto look = [&](const BeamSection& section, const PointMotion<double, D>& at,
                        const std::optional<RestStrain<double>>& strain, Feels feels) {
    if (extremes != nullptr) extremes->add(section, at, strain ? &*strain : nullptr, feels);
  };
  ElementSums<double, D> sums;
  std::optional<PieceBending<double, D>> bending;  // where EI changes inside the element
  const auto bent = [&]<class Point>(const Point& point, const PointMotion<double, D>& at, double otherwise) {
    if constexpr (std::is_same_v<Point, PiecePoint<double>>) {
      const double EI = point.here_felt().stiffness.EI;
      if (bending && EI > 0) return bending->stress(point.x, at.r_x, at.r_xx, EI).stored;
    }
    return otherwise;
  };
  const auto add = [&](const auto& point, const PointMotion<double, D>& at, const auto*) {
    const BeamSection& section = point.felt(sections);
    const double wl = point.weight;
    const auto strain = at_rest(section, at);
    if (strain) {
      const RestStress<double, D> stress(at.r_x, at.r_xx, *strain, section);
      sums.axial += wl * stress.axial;
      sums.bending += wl * stress.bending;
    } else {
      const ElasticStress<double, D> stress(at.r_x, at.r_xx, section.stiffness);
      sums.axial += wl * stress.axial;
      sums.bending += wl * bent(point, at, stress.bending);
    }
    look(point.whole(sections), at, strain, point.feels);
    if (point.feels == Feels::stretch) return;
    sums.template add_motion<false>(point, at, section.rhoA, gravity_);
    if (inertia_ != nullptr) sums.kinetic += inertia_->kinetic(wl, at.v_x);
  };
  const auto motion = [&](double u, const ShapeTable<double>& shape) { return element.at(u, shape); };
  const RestKinematics<double, D, MovingEnds::both>* none = nullptr;  // rest strains stand still here
  const ShapeTabulation& table = tables_.of(of.weights.w);
  const double x_a = of.q.x_a, x_b = of.q.x_b;
  const bool changes = pieces_ != nullptr && pieces_->change_between(x_a, x_b);
  if (changes) {
    if (rest == nullptr) bending = piece_bending(element, table.rule, section_, *pieces_);
    for_each_point_in_pieces(element, table.rule, section_, *pieces_, none, motion, add);
  } else {
    for_each_point(element, table, of.is_rational(), none, motion, add);
  }
  if (extremes == nullptr) return sums;
  for (const double u : {0.0, 1.0}) {
    const PointMotion<double, D> at = element.at(u, rational_shape(element.weights(), u));
    const SectionShare share = changes ? pieces_->at(u == 0 ? x_a : x_b) : SectionShare{};
    const BeamSection section = share.of(sections.everything);
    look(section, at, at_rest(section, at), Feels::everything);
  }
  return sums;
}

template <int D>
ElementSums<double, D> Observer<D>::sums(const SummedElement<D>& element, const NodalCubic<double, D>* rest,
                                         bool energies_alone, StrainExtremes* extremes) const {
  const double x_a = element.q.x_a, x_b = element.q.x_b;
  if (pieces_ != nullptr && pieces_->change_between(x_a, x_b)) return by_points(element, sections_, rest, extremes);
  const auto sums_of = [&](const FeltSections& sections) {
    if (rest != nullptr || inertia_ != nullptr) return by_points(element, sections, rest, extremes);
    const auto& kernels = fastest_sum_kernels<D>();
    const auto kernel = energies_alone ? kernels.energies : kernels.all;
    return kernel(element, tables_.of(element.weights.w), sections, gravity_, extremes);
  };
  return pieces_ == nullptr ? sums_of(sections_) : sums_of(FeltSections(pieces_->at((x_a + x_b) / 2).of(section_)));
}

template <int D>
void Observer<D>::add(const SummedElement<D>& element, const NodalCubic<double, D>* rest, Observation<D>& seen) const {
  seen.add(sums(element, rest, false, seen.extremes ? &*seen.extremes : nullptr));
}

template <int D>
Energy Observer<D>::energies(const SummedElement<D>& element, const NodalCubic<double, D>* rest) const {
  return energy_of(sums(element, rest, true, nullptr));
}

template class Observer<2>;
template class Observer<3>;

}  // namespace vlbeam
