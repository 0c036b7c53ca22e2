#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mechanics/motion/system/energy.hpp"
#include "mechanics/motion/system/event_type.hpp"
#include "mechanics/time/solver_counters.hpp"
#include "scene/run_error.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// Generalized force of a support on its node: conjugate to position [N] and to slope [N m].
struct Reaction {
  Point position{};
  Point slope{};
};

/// What else there is to see of a beam that spins, flows or bears loads.
struct FlowSample {
  /// What has crossed the boundary since the start; energy is kept if the total has changed by the last three.
  struct Ledger {
    double mass;   ///< [kg], in through the ends
    double ends;   ///< [J], in through the ends with the matter, and from supports and drives
    double loads;  ///< [J], work of the loads
    double mesh;   ///< [J], work of moving inner nodes along the beam: discretisation error only
  };

  double mass = 0;                                  ///< between the end nodes [kg]
  std::optional<std::array<double, 2>> end_angles;  ///< of the first and the last node [rad]; with spin
  double spin_momentum = 0;                         ///< about the axis [N m s]
  std::vector<Point> loads;                         ///< where the concentrated ones are [m]
  std::vector<Reaction> supports;                   ///< of inner nodes, in the order of the scene
  std::vector<double> torques;                      ///< of the drives of the angle, about the axis [N m]
  Ledger ledger;
};

/// Between the sliding mass and the beam, while it is on it.
struct JointSample {
  double velocity;    ///< rate of its material coordinate, x_i' [m/s]
  Point force;        ///< with which the beam acts on the mass [N]
  double tangential;  ///< of the force: along the beam's tangent, towards its end [N]
  double normal;      ///< and across it, the magnitude [N]
  double guiding;     ///< of what guides the mass, on its material coordinate: its power over `velocity` [N]
};

/// Least and largest over the beam; of strains from the rest shape, as the strain law measures them.
struct StrainSample {
  std::array<double, 2> axial_strain{};  ///< [-]
  std::array<double, 2> axial_force{};   ///< EA (strain + damping c times its rate), along the axis [N]
  double curvature = 0;                  ///< largest magnitude [1/m]
};

/// Of an equilibrium.
struct StaticSample {
  double load_factor = 0;    ///< what loads, gravity and displacements of supports are scaled by
  int negative_pivots = 0;   ///< of the tangent: directions in which the potential energy falls; 0 is stable
  double holding_force = 0;  ///< on the material coordinate of a joint, along the beam [N]; 0 once it is released
  int hidden_pivots = 0;     ///< directions of which rounding hides whether the energy falls
};

/// One of several joints.
struct SlidingSample {
  std::optional<double> position;      ///< material coordinate [m], while it is on the beam
  std::optional<Point> mass_position;  ///< [m]; of a ring or a sleeve while it is on the beam
  std::optional<JointSample> on_beam;
};

/// What a winch has done.
struct WinchSample {
  double length;   ///< paid out since t = 0 [m]
  double rate;     ///< [m/s]
  double tension;  ///< with which the beam pulls at it, by the length before stretching [N]
  double power;    ///< of its push, without the energy that the beam brings along [W]
};

/// What a cross-section bears. In the plane moment and shear have a sign: a beam that is drawn from left to right sags
/// under a positive moment, and the shear is the moment's growth along the beam. In space both are magnitudes.
struct SectionForce {
  double axial = 0;   ///< along the axis, tension positive [N]
  double shear = 0;   ///< across it [N]
  double moment = 0;  ///< of bending [N m]
  double torque = 0;  ///< about the axis [N m]; of sections that have frames
  double stress = 0;  ///< largest magnitude by axial force and bending [Pa]; of a section with sizes
};

/// Least and largest of one of these along the beam, and where [m].
struct AlongBeam {
  double least, largest, at_least, at_largest;
};

/// A place of the scene.
struct PlaceSample {
  Point position{};  ///< [m]
  Point velocity{};  ///< of what is there: the material point, or the joint [m/s]
  double angle = 0;  ///< see beam_angle() [degrees]
  SectionForce force;
};

/// What holds a material point between the ends.
struct BearingSample {
  Point position{};  ///< of that point [m]
  Point force{};     ///< on the beam [N]
};

/// A wheel of a vehicle.
struct AxleSample {
  double x = 0;                 ///< its material coordinate, on the beam or off it [m]
  std::optional<double> force;  ///< with which it pushes the beam, while it is on it [N]
  double height = 0;  ///< of the mass that it carries, counted from rest on a level road; without one its own [m]
};

/// How the sections of a beam are loaded and turned.
struct SectionSample {
  std::optional<AlongBeam> axial, moment;          ///< of a beam that bends
  std::optional<AlongBeam> shear, torque;          ///< without frames; with them
  std::optional<AlongBeam> stress;                 ///< of a section with sizes
  std::array<double, 2> angles{};                  ///< of the beam at its start and its end, see beam_angle() [degrees]
  std::array<std::optional<double>, 2> tension;    ///< there, by what holds it [N]; empty where an end is free
  std::vector<std::optional<PlaceSample>> places;  ///< of the scene, empty where they are not on the beam
  std::vector<BearingSample> bearings = {};        ///< of the scene
  std::vector<AxleSample> axles = {};              ///< of all vehicles
};

/// The largest and the least value of a quantity until a sample, and when they were [s].
struct Extreme {
  double largest, at_largest, least, at_least;
};

struct AssemblySample;

/// The observed quantities at one instant. Of an assembly energies and momenta are those of the whole, and all else is
/// in `assembly`.
struct Sample {
  double t = 0;                          ///< in statics the number of the equilibrium, from 0
  std::optional<double> joint_position;  ///< of the first joint: material coordinate x_i [m]; empty once the mass has
                                         ///< left, or without one
  std::optional<Point> mass_position;    ///< [m]; empty without a sliding mass
  Point end{};                           ///< position of the beam's last node [m]
  double beam_length = 0;                ///< current arc length [m]
  double beam_length_rate = 0;           ///< [m/s]
  std::array<std::optional<WinchSample>, 2> winches = {};  ///< at the start and the end of the beam
  Energy energy;              ///< by a 25-point rule, independent of the model's own points
  double discrete_total = 0;  ///< total energy summed over the model's own quadrature points [J]
  Point momentum{};           ///< linear momentum of beam and mass [kg m/s]
  Point angular_momentum{};   ///< of the same about the origin [kg m^2/s]; in the plane the last component
  std::array<Reaction, 2>
      reactions{};  ///< of the supports at start and end, by the accelerations that belong to the state
  StrainSample strains;
  std::optional<JointSample> joint;   ///< as `joint_position`
  std::vector<SlidingSample> joints;  ///< all of them, where there are several
  std::shared_ptr<const FlowSample> flow;
  std::optional<StaticSample> equilibrium;
  std::shared_ptr<const SectionSample> sections;
  std::shared_ptr<const std::vector<Extreme>> extremes;  ///< one a number of this sample, where the scene asks for them
  std::shared_ptr<const AssemblySample> assembly = {};
};

/// Of a rigid body.
struct BodySample {
  Point position{};  ///< of its center of mass [m]
  Point velocity{};  ///< [m/s]
  Point rotation{};  ///< from the axes of the scene, a rotation vector; in the plane an angle, the last [degrees]
  Point angular_velocity{};  ///< in space [rad/s]
};

/// Of a link.
struct LinkSample {
  Point force{};       ///< on its first end, of one on the ground on the other [N]
  double length = 0;   ///< between its ends [m]
  double tension = 0;  ///< with which it pulls its ends together [N]
};

/// Of the parts of an assembly, in the order of the scene.
struct AssemblySample {
  std::vector<Sample> beams;
  std::vector<BodySample> bodies;
  std::vector<LinkSample> links;
};

/// The beam's whole shape at one instant: one entry a node, one entry of weights an element.
struct Configuration {
  double t = 0;
  std::string beam = {};       ///< which of an assembly
  std::vector<double> x;       ///< material coordinates [m]
  std::vector<Point> r;        ///< positions [m]
  std::vector<Point> r_x;      ///< slopes [-]
  std::vector<double> angles;  ///< of the sections about the axis [rad]; empty without spin
  std::vector<std::array<double, 4>> weights;
  /// Nodes of the elements' rest shape; empty where it is straight and unstrained.
  struct Rest {
    std::vector<Point> r;    ///< [m]
    std::vector<Point> r_x;  ///< [-]
  };
  Rest rest;
  /// Where the beam may be kinked, at a joint: `r_x` has the slope before it, this is the one behind.
  struct Kink {
    std::size_t node;
    Point r_x;
    Point r_x_rate{};  ///< [1/s]
  };
  std::vector<Kink> kinks;
  /// The one at a node, or null.
  const Kink* kink_at(std::size_t node) const {
    for (const Kink& kink : kinks) {
      if (kink.node == node) return &kink;
    }
    return nullptr;
  }
  /// How fast all this changes.
  struct Rates {
    std::vector<double> x;      ///< of the material coordinates [m/s]
    std::vector<Point> v;       ///< velocities of the material points at the nodes [m/s]
    std::vector<Point> r_x;     ///< of the slopes [1/s]
    std::vector<double> spins;  ///< rates of the angles [rad/s]; with spin
  };
  Rates rates;
  /// What acts on the beam at one material point: there the moment has a kink, or the shear jumps.
  struct Action {
    double x;       ///< material coordinate [m]
    Point force{};  ///< [N]; matters inside an element
  };
  std::vector<Action> actions = {};
  /// Of sections with frames, at the two Gauss points of an element: moments about the axes y and z of the section, and
  /// the torque [N m].
  std::vector<std::array<Point, 2>> moments = {};
};

/// A length-control event, located in time, with what it cost.
struct Event {
  double t = 0;
  EventType type = EventType::segment_merge;
  std::string beam = {};  ///< which of an assembly
  int joint = 0;          ///< which of the scene's joints; the ends that feed the beam come behind them
  double joint_position = 0;
  std::array<double, 3> weights{1, 1, 1};  ///< k_0, k_1, k_2 of the merged element (k_3 = 1)
  bool unit_fallback = false;              ///< a k_i <= 0 was found and unit weights taken instead (Eq. 38)
  Energy energy_jump;                      ///< after minus before, 25-point rule
  double discrete_jump = 0;                ///< jump of the total over the model's own points [J]
  std::vector<double> momentum_jump;       ///< linear [kg m/s], then angular about the origin [kg m^2/s]
  int relaxation = 0;                      ///< iterations until nodes had given way, where they are relaxed
  bool restored = true;                    ///< false: `conservative` velocities could not restore the energy
  /// The whole shapes, but of a beam of more than 200 elements with one joint eight nodes on either side of it.
  Configuration before, after;
};

/// How a run ended.
enum class RunStatus {
  completed,
  separated,  ///< the mass left the beam and the run went on to its end
  failed,     ///< the computation broke down; what was computed until then is here
  interrupted,
};

/// What a run warns of.
enum class WarningKind {
  energy_at_events,        ///< length control has changed the total energy
  energy_not_restored,     ///< `conservative` velocities could not restore the total energy
  energy_between_events,   ///< the integrator or the formulation has changed the total energy
  energy_unexplained,      ///< the model's own quadrature points do not see a change of it
  stability_limits_steps,  ///< of an explicit method; an implicit one would need fewer
  large_strain,            ///< more than a structural beam bears: a unit may be wrong
  thick_elements,          ///< the section's radius exceeds an element's length: a unit may be wrong
  light_material,          ///< lighter than foam: a unit may be wrong
  buckled_elements,        ///< compressed beyond what a single element bears: it is slack, and its folds have no mesh
  hidden_stability,        ///< rounding hides whether an equilibrium is stable
  assumed_material,        ///< a file left out what the beam is of: the paper's soft one is run
  rounded_corner,          ///< a rope's corner beside a joint is rounded off: the joint is not on the corner
  held_ring,               ///< a motion starts from an equilibrium in which something has to hold a ring on its rope
  ringing_friction,        ///< the force that friction goes by is that of a vibration
  error_in_time,           ///< the steps err more than the accuracy asked allows
  error_of_mesh,           ///< the elements err by more than 1 % of the motion
  redundant_links,         ///< links hold what others hold already
  sudden_gravity,          ///< gravity that acts at once on an unstrained beam makes it vibrate
  lifting_wheel,           ///< a wheel would leave the beam, which holds it
  free_twist,              ///< a clamp in space lets a beam without frames turn about its axis
  no_ground_friction,      ///< an equilibrium on a ground whose friction does nothing
};

/// Something that the results of a run do not show by themselves, and that its user should know.
struct Warning {
  WarningKind kind;
  std::string message;  ///< what has happened, with numbers
  std::string remedy;   ///< what to try
};

/// The force across the beam by which friction at a joint goes, from step to step, over the way that it slides.
struct FrictionPressure {
  double size = 0;  ///< mean of its magnitude [N]
  double mean = 0;  ///< magnitude of what it is over some steps [N]: less where it swings
  double way = 0;   ///< that it slides [m]
};

/// Wall times [s]; never part of a committed report.
struct RunTiming {
  double motion = 0;
  double length_control = 0;
};

/// All that a run gives; what is not there for a scene is empty.
struct RunResult {
  RunStatus status = RunStatus::completed;
  std::string failure;      ///< what happened, with status `failed`
  double failure_time = 0;  ///< [s]
  std::vector<Sample> samples;
  std::vector<Configuration> configurations;
  std::vector<Event> events;
  double max_kinetic = 0;       ///< largest kinetic energy of the samples [J]
  double max_energy_drift = 0;  ///< over the samples: max |E - E_0 - supplied - jumps|, the model's own points [J]
  ConstraintResidual slopes;    ///< largest of the samples: how far a kinked joint's slopes are from what ties them
  std::vector<FrictionPressure> pressures;  ///< of joints, where some with friction slide freely
  std::vector<double> frequencies;          ///< about the last equilibrium [Hz]; see natural_frequencies()
  SolverCounters solver;
  std::vector<Warning> warnings;
  std::shared_ptr<const RunError> error;  ///< where the run was checked, see checked_run()
  RunTiming timing;
};

}  // namespace vlbeam
