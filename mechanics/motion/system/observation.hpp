#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/beam/node_map.hpp"
#include "core/element/element_sums.hpp"
#include "core/geometry/vec.hpp"
#include "mechanics/motion/system/energy.hpp"
#include "mechanics/motion/system/section_inertia.hpp"

namespace vlbeam {

/// Gauss points an element of what is reported of a run, whatever the model's own are.
inline constexpr int ledger_points = 25;

template <int D>
Energy energy_of(const ElementSums<double, D>& sums) {
  return {.kinetic = sums.kinetic, .axial = sums.axial, .bending = sums.bending, .gravity = sums.gravity};
}

/// Quantities of the whole system at one instant.
template <int D>
struct Observation {
  Energy energy;
  double beam_length = 0;                                    ///< [m]
  double beam_length_rate = 0;                               ///< [m/s], by stretching and by what comes in
  Vec<double, D> momentum = Vec<double, D>::Zero();          ///< [kg m/s]
  Vec<double, 3> angular_momentum = Vec<double, 3>::Zero();  ///< about the origin [kg m^2/s]
  Vec<double, D> mass_moment = Vec<double, D>::Zero();       ///< integral of r over the mass [kg m]
  double mass = 0;                                           ///< of the beam, between its end nodes [kg]
  double momentum_about_axis = 0;                            ///< about the axis [kg m^2/s]
  double load_work = 0, end_work = 0, mesh_work = 0;         ///< what EnergyBalance has of it, where counted [J]
  double mass_in = 0;                                        ///< the same [kg]
  std::optional<StrainExtremes> extremes = {};               ///< at the points of the rule and the elements' ends

  void add(const ElementSums<double, D>& sums) {
    *this += {.energy = energy_of(sums),
              .beam_length = sums.length,
              .beam_length_rate = sums.length_rate,
              .momentum = sums.momentum,
              .angular_momentum = sums.angular_momentum,
              .mass_moment = sums.mass_moment,
              .mass = sums.mass};
  }
  /// Adds another part. Extremes are kept where this one has a place for them.
  Observation& operator+=(const Observation& part) {
    energy += part.energy;
    beam_length += part.beam_length;
    beam_length_rate += part.beam_length_rate;
    momentum += part.momentum;
    angular_momentum += part.angular_momentum;
    mass_moment += part.mass_moment;
    mass += part.mass;
    momentum_about_axis += part.momentum_about_axis;
    load_work += part.load_work;
    end_work += part.end_work;
    mesh_work += part.mesh_work;
    mass_in += part.mass_in;
    if (extremes && part.extremes) extremes->add(*part.extremes);
    return *this;
  }
  friend Observation operator+(Observation a, const Observation& b) { return a += b; }
  /// A lumped mass at r that moves with v.
  void add_mass(double m, const Vec<double, D>& r, const Vec<double, D>& v, const Vec<double, D>& gravity) {
    energy.kinetic += 0.5 * m * v.squaredNorm();
    energy.gravity -= m * gravity.dot(r);
    momentum += m * v;
    angular_momentum += m * moment_about_origin(r, v);
    mass_moment += m * r;
  }
};

/// Forces between the beam and what it is connected to, at one instant.
template <int D>
struct OuterForces {
  using OnNode = Eigen::Matrix<double, node_size<D>, 1>;  ///< generalized: position [N], slope [N m]

  std::array<OnNode, 2> supports{OnNode::Zero(), OnNode::Zero()};  ///< on the first and the last node
  std::vector<OnNode> guides;                                      ///< on inner nodes that supports hold
  /// With which the beam acts on the sliding masses [N], one of the model's joints each; zero off the beam.
  std::vector<Vec<double, D>> on_masses;
  std::vector<double> guiding;             ///< of what guides the model's joints, on their material coordinates [N]
  std::vector<double> mark_accelerations;  ///< of the joints on the beam, in the order of the chain [m/s^2]
  std::vector<double> drives;              ///< about the axis, of what drives angles on the beam [N m]
  std::vector<double> links;               ///< of the beam's links, times dC/dq each: see BeamLink [N]
  std::vector<double> carried;             ///< of masses that the beam carries, along their directions [N]
};

/// Sums energies, momenta and length of a beam's axis, element by element, by a rule of one's own.
template <int D>
class Observer {
 public:
  /// All but `gravity` must outlive this object; `inertia` and `pieces` are null without.
  Observer(const BeamSection& section, const Vec<double, D>& gravity, const SumTables& tables,
           const SectionInertia<D>* inertia = nullptr, const SectionPieces* pieces = nullptr);

  /// `rest` are the nodes of the element's rest shape, null for a straight, unstrained one. Strains are looked at
  /// where `seen` has a place for them.
  void add(const SummedElement<D>& element, const NodalCubic<double, D>* rest, Observation<D>& seen) const;
  /// Energies alone.
  Energy energies(const SummedElement<D>& element, const NodalCubic<double, D>* rest) const;

 private:
  ElementSums<double, D> sums(const SummedElement<D>& element, const NodalCubic<double, D>* rest, bool energies_alone,
                              StrainExtremes* extremes) const;
  /// Of any element, point by point, in which the section changes, or is that of `sections`.
  ElementSums<double, D> by_points(const SummedElement<D>& element, const FeltSections& sections,
                                   const NodalCubic<double, D>* rest, StrainExtremes* extremes) const;

  const BeamSection& section_;
  FeltSections sections_;
  Vec<double, D> gravity_;
  const SumTables& tables_;
  const SectionInertia<D>* inertia_;
  const SectionPieces* pieces_;
};

extern template class Observer<2>;
extern template class Observer<3>;

}  // namespace vlbeam
