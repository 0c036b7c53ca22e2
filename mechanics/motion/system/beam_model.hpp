#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "core/beam/support_motion.hpp"
#include "core/element/section_pieces.hpp"
#include "core/element/transport.hpp"
#include "core/length_control/length_control.hpp"
#include "mechanics/motion/joint/joint_law.hpp"
#include "mechanics/motion/parts/loads.hpp"
#include "mechanics/motion/parts/point_masses.hpp"
#include "mechanics/motion/system/constraints.hpp"
#include "mechanics/time/energy_balance.hpp"

namespace vlbeam {

/// Something that slides along the beam.
template <int D>
struct ModelJoint {
  SlidingJoint law;
  /// What holds the place of its node in space: of a ring, a pin; of a sleeve, a clamp of the direction.
  std::optional<Support<D>> support = std::nullopt;
  SupportMotion<D> motion = {};    ///< of what holds it; it does not turn
  double separation_distance = 0;  ///< [m]
  TimeFunction x = {};             ///< its material coordinate, where a guide prescribes it [m]
};

/// What holds the axis at a node, through which the beam may flow.
template <int D>
struct NodeSupport {
  int node;
  Support<D> support;
};

template <int D>
class Axis;
template <int D>
class Part;
template <int D>
class Room;

/// Stands for a model's own Gauss points, which need not be as many in all elements.
inline constexpr int own_points = 0;

/// What a beam system is made of and which choices its equations follow.
template <int D>
struct BeamModel {
  BeamSection section;
  SectionPieces pieces = {};  ///< of a beam that has more than one: which share of `section` there is where
  Formulation formulation = Formulation::variational;
  WeightTransport transport = WeightTransport::frozen;
  int quadrature_points = 5;  ///< Gauss points an element
  int polynomial_points = 0;  ///< of one whose weights are 1; 0 for `quadrature_points`
  AxialStrain axial_strain = AxialStrain::full;
  Vec<double, D> gravity = Vec<double, D>::Zero();  ///< [m/s^2]
  double gravity_ramp = 0;                          ///< T_r [s], 0 for gravity that is there from the start
  bool time_is_load_factor = false;                 ///< gravity is t times what it says, as loads may be: statics
  Support<D> start, end;
  SupportMotion<D> start_motion, end_motion;
  bool start_releases = false, end_releases = false;  ///< joints may leave the beam there
  Loads<D> loads;
  PointMasses<D> masses;
  std::vector<std::shared_ptr<const Part<D>>> parts = {};  ///< what else acts on the beam
  std::vector<std::shared_ptr<const Room<D>>> rooms = {};  ///< what else there is: see room.hpp
  double contact_distance = 0.1;  ///< of L_std: where joints with nodes touch each other, or a support that they strike
  /// In the order of the chain; behind them the ends of the beam through which it is fed, whose way is given.
  std::vector<ModelJoint<D>> joints;
  /// Of these, which keep the distances in space that they have at t = 0: each row is a block that does not turn.
  std::vector<std::vector<int>> blocks = {};
  LengthControl length_control;
  Constraints constraints = Constraints::eliminated;
  std::vector<NodeSupport<D>> held_nodes;  ///< what holds inner nodes in space, of a beam without joints
  /// What nodes that move or that are new follow in the rest shape, by arc length, where the chain's `rest` has the
  /// others; null for a straight, unstrained rest shape.
  std::shared_ptr<const Axis<D>> rest;

  int points_of_polynomials() const { return polynomial_points > 0 ? polynomial_points : quadrature_points; }
  BeamRules rules() const { return {points_of_polynomials(), quadrature_points, axial_strain}; }
  /// What elements of the axis alone resist.
  BeamSection axis_section() const;
  BeamSections sections() const { return {axis_section(), pieces}; }
  /// Null for a beam of one section all along.
  const SectionPieces* several_sections() const { return pieces.empty() ? nullptr : &pieces; }
  /// Mass per length at a material coordinate [kg/m].
  double mass_at(double x) const { return pieces.empty() ? section.rhoA : section.rhoA * pieces.at(x).mass; }
  /// Whether one of its own parts may take or give power.
  bool parts_work() const;
  /// Whether there is friction at a joint.
  bool rubs() const {
    return std::any_of(joints.begin(), joints.end(), [](const auto& joint) { return joint.law.friction.has_value(); });
  }
  /// Whether material coordinates of joints are prescribed.
  bool guides() const {
    return std::any_of(joints.begin(), joints.end(), [](const auto& joint) { return static_cast<bool>(joint.x); });
  }
  bool supports_move() const {
    return start_motion || end_motion ||
           std::any_of(joints.begin(), joints.end(), [](const auto& joint) { return bool{joint.motion}; });
  }
  /// Whether a run ends where two joints meet.
  bool joints_stop_each_other() const;
  /// Whether something moves as prescribed, and so does work.
  bool driven() const { return supports_move() || guides(); }
  bool turns() const { return start_motion.turns() || end_motion.turns(); }
  /// The energies that the state counts.
  BalanceEntries balance() const;
};

extern template struct BeamModel<2>;
extern template struct BeamModel<3>;

}  // namespace vlbeam
