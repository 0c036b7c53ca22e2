// Compiled once for each instruction set, as moving_kernels.cpp is.
#include "core/element/element_sums.hpp"
#include "core/element/pack_lanes.hpp"

namespace vlbeam::VLBEAM_KERNELS {
namespace {

template <int D, bool energies_alone>
[[gnu::flatten]] ElementSums<double, D> sums_of(const SummedElement<D>& of, const ShapeTabulation& table,
                                                const FeltSections& sections, const Vec<double, D>& gravity,
                                                StrainExtremes* extremes) {
  const MovingKinematics<Pack, D> element(in_all_lanes<D>(of.q), in_all_lanes<D>(of.rate), of.transport, of.weights);
  const Vec<Pack, D> g = gravity.template cast<Pack>();
  const auto motion = [&](const auto& u, const auto& shape) { return element.at(u, shape); };
  const RestKinematics<double, D, MovingEnds::both>* const none = nullptr;
  ElementSums<Pack, D> lanes;
  for_each_point(element, table, of.is_rational(), none, motion,
                 [&](const auto& point, const PointMotion<Pack, D>& at, const auto*) {
                   const BeamSection& section = sections[point.feels];
                   if (!energies_alone && extremes != nullptr)
                     extremes->add(sections.everything, at, nullptr, point.feels);
                   const ElasticStress<Pack, D> stress(at.r_x, at.r_xx, section.stiffness);
                   lanes.axial += point.weight * stress.axial;
                   lanes.bending += point.weight * stress.bending;
                   if (point.feels == Feels::stretch) return;
                   lanes.template add_motion<energies_alone>(point, at, section.rhoA, g);
                 });
  if (!energies_alone && extremes != nullptr) {
    const Pack ends(0, 1, 0, 1);
    extremes->add(sections.everything, element.at(ends, rational_shape(element.weights(), ends)), nullptr);
  }
  ElementSums<double, D> sums;
  sums.axial = total(lanes.axial);
  sums.bending = total(lanes.bending);
  sums.kinetic = total(lanes.kinetic);
  sums.gravity = total(lanes.gravity);
  if constexpr (energies_alone) return sums;
  sums.mass = total(lanes.mass);
  sums.length = total(lanes.length);
  sums.length_rate = total(lanes.length_rate);
  sums.momentum = total<D>(lanes.momentum);
  sums.mass_moment = total<D>(lanes.mass_moment);
  sums.angular_momentum = total<3>(lanes.angular_momentum);
  return sums;
}

}  // namespace

template <int D>
SumKernels<D> sum_kernels() {
  return {&sums_of<D, false>, &sums_of<D, true>};
}
template SumKernels<2> sum_kernels();
template SumKernels<3> sum_kernels();

}  // namespace vlbeam::VLBEAM_KERNELS
