#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/element/beam_rule.hpp"
#include "core/element/strain_law.hpp"
#include "core/element/transport.hpp"
#include "core/length_control/merge_shape.hpp"
#include "mechanics/contact/at_support.hpp"
#include "mechanics/motion/joint/axial_friction.hpp"
#include "mechanics/motion/joint/joint_slopes.hpp"
#include "mechanics/motion/system/constraints.hpp"
#include "mechanics/ropes/winding.hpp"
#include "mechanics/spin/angle_field.hpp"
#include "scene/integrator_type.hpp"
#include "scene/standard_profiles.hpp"

namespace vlbeam {

/// A point or vector of the scene; planar scenes use the first two components and keep the third at 0.
using Point = std::array<double, 3>;

/// What the options that are not given stand for.
enum class SceneSetting {
  standard,
  ding_ouyang_2022,  ///< what the paper does, as far as it says so
};

/// Rational or polynomial cubic elements, with a node that may move (ALE) or without.
enum class ElementKind { ale_rancf, ale_ancf, rancf, ancf };
/// What strains are measured from: the initial shape, or, as in the paper, a straight beam.
enum class RestShape {
  as_built,
  straight,  ///< an unstrained line
  paper,     ///< the same, by its old name
};
/// How elements follow a curved initial axis.
enum class AxisForm {
  even,   ///< elements run along the initial axis at its arc length, to a high order
  exact,  ///< elements are the axis exactly, at an uneven speed
};
/// What holds an end of the beam.
enum class SupportType {
  clamp,
  pin,
  slide,  ///< position free along the initial tangent of the axis only
  free,
};
/// What of the slope a clamp holds.
enum class ClampType {
  direction,  ///< position fixed, slope free along the initial tangent
  full,       ///< position and slope vector fixed
};

/// Kinds of initial axes.
enum class CurveType { line, arc, nurbs, polyline };

/// The initial axis of the beam; its length is the beam's length.
struct CurveSpec {
  CurveType type = CurveType::line;
  Point start{0, 0, 0};                          ///< line [m]
  Point end{1, 0, 0};                            ///< line [m]
  Point center{};                                ///< arc [m]
  double radius = 1;                             ///< arc [m]
  double pitch = 0;                              ///< arc in space: by which a helix rises in a turn [m]
  double from_degrees = 0, to_degrees = 180;     ///< arc, in the plane of the first two axes
  int degree = 3;                                ///< nurbs
  std::vector<double> knots = {}, weights = {};  ///< nurbs; no weights are equal weights
  std::vector<Point> control_points = {};        ///< nurbs [m]
  std::vector<Point> points = {};                ///< polyline [m]

  bool operator==(const CurveSpec&) const = default;
};

/// What a rope is made of.
enum class RopeConstruction { wire_fibre_core, wire_wire_core, nylon, polyester, polypropylene };
enum class ChainLinks { studless, studlink };

/// The cross-section: full or hollow, of the beam's material; a rope or a chain by its diameter; or stiffnesses and
/// masses per length.
struct Section {
  /// A profile has two flanges and a web between them.
  enum class Type { circle, rectangle, stiffness, tube, box, profile, rope, chain } type = Type::circle;
  double radius = 0.01;  ///< circle; tube: the outer one [m]
  double EA = 0;         ///< stiffness [N]
  double EI = 0;         ///< stiffness [N m^2]; 0 is a cable
  double rhoA = 0;       ///< stiffness [kg/m]
  double GIp = 0;        ///< stiffness [N m^2], used with spin and with frames
  double rhoIp = 0;      ///< stiffness, moment of inertia per length about the axis [kg m]
  double width = 0,
         height = 0;  ///< rectangle, box, profile: along its axes y and z [m]; in the plane height lies in it
  std::optional<double> EI_y = {};  ///< stiffness, in place of EI: bending about the section's axis y [N m^2]
  std::optional<double> EI_z = {};  ///< stiffness, in place of EI: bending about the section's axis z [N m^2]
  Point orientation{};              ///< of the section's axis y, as far as it is across the beam; zero: not given
  double wall = 0;                  ///< tube, box: thickness [m]
  double web = 0, flange = 0;       ///< profile: thicknesses [m]
  double diameter = 0;              ///< rope; chain: of the bar of its links [m]
  RopeConstruction construction = RopeConstruction::wire_wire_core;
  ChainLinks links = ChainLinks::studless;
  double fillet = 0;                             ///< profile: radius between web and flanges [m]
  std::optional<StandardProfile> standard = {};  ///< profile: in place of its sizes
};

/// Materials with their usual data.
enum class MaterialName { own, steel, aluminium, timber };

/// Properties of the material.
struct Material {
  double density = 7200;                  ///< [kg/m^3], used with a circle or a rectangle
  double youngs_modulus = 2e7;            ///< [Pa], used with a circle or a rectangle
  double poisson_ratio = 0.3;             ///< used with a circle or rectangle that twists
  double damping = 0;                     ///< Kelvin-Voigt time c [s]
  double mass_damping = 0;                ///< alpha [1/s]: forces -alpha rhoA v per length
  double curvature_regularization = 0;    ///< kappa_reg [1/m], needed by bending damping in 3D
  MaterialName name = MaterialName::own;  ///< any other stands for density, youngs_modulus and poisson_ratio
};

/// A quantity as a function of time:
/// S(t/ramp) (value + rate t + acceleration t^2/2 + amplitude sin(2 pi frequency t + phase)), S of gravity_ramp; from
/// `until` on it goes on evenly, at the rate it has then. With a `rate_ramp` the rate itself grows as S(t/rate_ramp).
/// Or a table of its values, of which the others say nothing.
struct TimeSpec {
  double value = 0, rate = 0, acceleration = 0;
  double amplitude = 0;
  double frequency = 0;              ///< [Hz]
  double phase_degrees = 0;          ///< [degrees]
  double ramp = 0;                   ///< [s]
  double rate_ramp = 0;              ///< [s], in place of `ramp`
  std::optional<double> until = {};  ///< [s]; if not given it never does
  std::vector<Point> table = {};     ///< times [s], in order, and values: two components each
  std::optional<bool> smooth = {};   ///< of a table: a curve whose acceleration does not jump; see smooth_by_default()
};

/// Rotary inertia of bending.
enum class BendingInertia {
  none,
  rayleigh,    ///< of sections that turn with the axis
  gyroscopic,  ///< and that spin: valid for small slopes against the initial axis and an even spin
};

/// Whether a rope bears compression.
enum class Compression {
  full,  ///< as it bears tension
  none,  ///< it goes slack
};

/// What resists loads across the plane of a beam that is curved at rest, in space.
enum class OutOfPlane {
  none,  ///< nothing but the change of the curvature's magnitude, which is of second order
};

/// How a beam bends in space.
enum class SpaceLaw {
  frames,  ///< about two axes of its sections, and twists as it does
  scalar,  ///< by the size of its curvature, whatever way it bends
};

/// Force per unstretched length against the velocity of the beam in still air, across and along its axis.
struct DragSpec {
  struct Coefficients {
    double normal = 0, tangential = 0;
  };

  Coefficients linear = {};     ///< over the velocity [N s/m^2]
  Coefficients quadratic = {};  ///< over its square [N s^2/m^3]
};

/// A piece of a beam that has several sections.
struct BeamPieceSpec {
  std::optional<double> to = {};      ///< material coordinate where it ends [m]; the last one's may be left out
  Section section;                    ///< of the beam's material
  std::optional<double> area = {};    ///< displaced per length [m^2], of a section that does not say it
  std::optional<DragSpec> drag = {};  ///< in place of the scene's
};

/// The beam: its initial axis, section and material, and how it is divided into elements.
struct BeamSpec {
  CurveSpec curve;
  Section section;                           ///< all along, where there are no `sections`
  std::vector<BeamPieceSpec> sections = {};  ///< in order
  Material material;
  int elements = 20;
  ElementKind element = ElementKind::ale_rancf;
  std::optional<AxisForm> axis = {};  ///< used with a curved axis; see axis_form()
  RestShape rest_shape = RestShape::as_built;
  StrainLaw strain_law = StrainLaw::engineering;  ///< that of data sheets: force = EA elongation
  std::optional<Compression> compression = {};    ///< see compression()
  std::optional<double> slack_over = {};          ///< strain over which a rope goes slack; see slack_over()
  BendingInertia rotary_inertia = BendingInertia::none;
  std::optional<SpaceLaw> space_law = {};        ///< in space; see has_frames()
  std::optional<OutOfPlane> out_of_plane = {};   ///< to be said of a curved beam in space whose law is scalar
  std::optional<AxialStrain> axial_strain = {};  ///< see axial_strain()
  int quadrature_points = 0;                     ///< Gauss points an element; 0 stands for the element's default
  int polynomial_points = 0;                     ///< of one with unit weights; 0 stands for its default
  std::array<double, 4> weights{1, 1, 1, 1};     ///< initial weights of every element
};

/// How a clamp or a pin moves as a function of time, counted from where it is at t = 0.
struct SupportMotionSpec {
  Point direction{};                               ///< of the displacement; need not have unit length
  TimeSpec displacement;                           ///< [m]
  std::optional<TimeSpec> angle = {};              ///< [rad], of a clamp in the plane, about its point
  std::optional<TimeSpec> x = {}, y = {}, z = {};  ///< along the axes, beside `displacement` [m]

  /// Calls f(key, function) for each displacement that there is.
  template <class F>
  void each_way(const F& f) const {
    if (direction != Point{}) f("", displacement);
    if (x) f("/x", *x);
    if (y) f("/y", *y);
    if (z) f("/z", *z);
  }
  bool along_axes() const { return x || y || z; }
};

/// A drum that a motor turns: the length of beam that it pays out is an unknown.
struct DrumSpec {
  double radius = 0;                 ///< [m]
  double inertia = 0;                ///< about its axis, with what is wound up at t = 0 [kg m^2]
  TimeSpec torque = {};              ///< of the motor, paying out where it is > 0 [N m]
  std::optional<double> wound = {};  ///< length of beam on it at t = 0 [m]; else as much as its inertia can be
};

/// What stops a winch whose length is an unknown, smoothly.
struct EndStopSpec {
  std::optional<double> least = {}, most = {};  ///< paid out since t = 0 [m]
  double stiffness = 0;                         ///< [N/m]
  double depth = 0;                             ///< over which it sets in [m]
  double damping = 0;                           ///< [N s/m]
};

/// The support of one end.
struct SupportSpec {
  SupportType type = SupportType::free;
  ClampType clamp = ClampType::direction;  ///< used with a clamp
  std::optional<SupportMotionSpec> motion = {};
  std::optional<TimeSpec> feed = {};  ///< length of beam that has come in through this end since t = 0: a winch [m]
  std::optional<TimeSpec> held_tension = {};  ///< with which a winch without inertia pulls, in place of it [N]
  std::optional<DrumSpec> drum = {};          ///< in place of both
  Winding winding = Winding::stretched;       ///< of the latter two
  std::optional<EndStopSpec> end_stop = {};   ///< of them, too

  /// Whether beam comes in or leaves there; whether as much as it wants.
  bool pays_out() const { return feed || held_tension || drum; }
  bool winds_freely() const { return held_tension || drum; }
};

/// What holds a material point between the ends of the beam; joints pass over it.
enum class BearingType {
  pin,     ///< its place
  roller,  ///< its place across the beam, as it is drawn there
  spring,
};
struct BearingSpec {
  std::string name = {};  ///< of its quantities; if not given, its number
  double x = 0;           ///< material coordinate [m]
  BearingType type = BearingType::roller;
  double stiffness = 0;               ///< of a spring [N/m]
  double damping = 0;                 ///< of a spring [N s/m]
  Point direction{};                  ///< along which a spring bears; zero: along all
  std::optional<Point> to = {};       ///< other end of a spring that bears along its own line [m]
  std::optional<double> length = {};  ///< of that spring when it bears nothing; else its distance at t = 0 [m]
  bool tension_only = false;          ///< a spring goes slack where it would push
};

/// A place on the drawn axis.
struct CornerSpec {
  int corner = 1;  ///< which inner point of a polyline, which kink of a NURBS curve, from the start
};

/// The mass that slides on the beam.
struct SlidingMassSpec {
  double mass = 0.8;      ///< [kg]
  double position = 0.1;  ///< material coordinate at t = 0 [m]
  double velocity = 0;    ///< rate of the material coordinate at t = 0 [m/s]
  JointSlopes slopes = JointSlopes::continuous;
  std::optional<AxialFriction> friction;      ///< none unless given
  std::optional<double> separation_distance;  ///< distance from a free end where the mass leaves [m]; default 1e-3 L
  AtSupport at_support = AtSupport::stop;     ///< where it reaches an end that is not free
  double restitution = 1;                     ///< of a rebound
  std::optional<CornerSpec> at_corner = {};   ///< in place of `position`, which place_at_corners() then fills in
};

/// A wheel over which the beam runs without slip, about a ring: its path round the wheel is not modelled.
struct PulleySpec {
  double radius = 0;   ///< [m]
  double inertia = 0;  ///< about its axis [kg m^2]
};

/// What slides along the beam: a lumped mass, or, held in space, a ring (`pin`) or a sleeve (`clamp`), which holds the
/// direction of the beam, too. What is held needs no mass.
struct SlidingJointSpec : SlidingMassSpec {
  SlidingJointSpec() { mass = 0; }

  SupportType support = SupportType::free;
  std::optional<SupportMotionSpec> motion;  ///< of what holds it, without an angle
  std::optional<TimeSpec> x;    ///< way of the joint along the beam as a function of time, counted from `position` [m]
  std::optional<double> pitch;  ///< of a nut on a beam that spins [m a turn], right-handed where > 0
  std::optional<PulleySpec> pulley = {};  ///< of a ring that is a wheel
};

/// Joints that keep their distances in space, as the sheaves of a block do that does not turn.
struct BlockSpec {
  std::vector<int> joints = {};  ///< of /sliding_joints, from 0
  double mass = 0;               ///< of the block [kg], beside those of its joints
};

/// How several joints touch: each other, and the supports that they strike.
struct ContactSpec {
  AtSupport joints = AtSupport::stop;  ///< where two meet
  double restitution = 1;              ///< of their rebound
  double distance = 0.1;               ///< between the nodes of what touches, over L_std
};

/// The section's rotation about the axis of the beam.
struct SpinSpec {
  /// A node whose angle is prescribed [rad].
  struct Drive {
    int node = 0;
    TimeSpec angle;
  };

  AngleField angles = AngleField::linear;
  std::optional<double> rate;  ///< of the whole beam at t = 0 [rad/s]; if not given, that of the first drive, or 0
  std::vector<Drive> drives = {};
};

/// Nodes that move along the beam as prescribed: the beam flows through its supports, a load travels with a node.
struct FlowSpec {
  /// A node whose material coordinate is given; those between two of them are equally spaced.
  struct Guide {
    int node = 0;
    TimeSpec x;                               ///< [m], 0 where the curve starts at t = 0
    SupportType support = SupportType::free;  ///< of an inner node, through which the beam flows
  };

  std::vector<Guide> nodes = {};
  double tension = 0;              ///< initial axial force [N]
  std::optional<double> velocity;  ///< of the matter along the axis at t = 0 [m/s]; if not given, node 0 stands still
  bool steady = false;             ///< start from the steady flow under the loads at t = 0
};

/// A wheel of a vehicle, and what stands on it.
struct AxleSpec {
  double distance = 0;     ///< behind the first axle [m]
  double force = 0;        ///< down, on the wheel [N]
  double mass = 0;         ///< of the wheel [kg]
  double sprung_mass = 0;  ///< [kg]
  double stiffness = 0;    ///< of the spring under it [N/m]
  double damping = 0;      ///< beside that spring [N s/m]
};
/// Axles that roll along the beam, onto it and off it.
struct VehicleSpec {
  std::string name = {};
  TimeSpec x = {};  ///< material coordinate of the first axle, on the beam or off it [m]
  std::vector<AxleSpec> axles = {};
};

/// A lumped mass on the material point that a node marks at t = 0.
struct PointMassSpec {
  int node = 0;
  double mass = 1;                      ///< [kg]
  std::optional<double> position = {};  ///< material coordinate [m], in place of a node: one moves there
};

/// Of a rigid motion, as far as supports allow it.
struct InitialVelocitySpec {
  Point translation{};  ///< [m/s]
  double rotation = 0;  ///< [rad/s], in the plane from the first axis towards the second
  Point axis{0, 0, 1};  ///< of the rotation in space; need not have unit length
  Point about{};        ///< a point on that axis [m]
};

/// What a load is.
enum class LoadType {
  force,     ///< in a direction of its own, which may turn about the initial axis
  follower,  ///< along the tangent of the axis
  moment,    ///< turns the tangent, in the plane
  torque,    ///< about the axis
};
/// Where a load acts.
enum class LoadPlace {
  node,
  point,  ///< a material point, which may travel
  beam,   ///< all of it, per unstretched length
};

/// A load on the beam.
struct LoadSpec {
  LoadType type = LoadType::force;
  LoadPlace at = LoadPlace::node;
  int node = 0;
  TimeSpec x;                ///< at a point: its material coordinate [m]
  TimeSpec magnitude;        ///< force [N] or torque [N m], per length [m] on the beam
  Point direction{0, 1, 0};  ///< force, or axis of a moment in space; need not have unit length
  bool follows = false;      ///< moment in space: it turns with the section
  TimeSpec turn;             ///< force: angle by which the direction has turned about the initial axis [rad]
};

/// The fluid around the beam.
struct FluidSpec {
  double density = 0;               ///< [kg/m^3], of what the beam displaces
  Point velocity{};                 ///< [m/s], against which drag counts
  std::optional<double> area = {};  ///< displaced per length [m^2]; if not given, a circle's own
};

/// A floor that bears the beam from below, against gravity.
struct GroundSpec {
  double height = 0;                           ///< of the floor, against gravity from the origin [m]
  double stiffness = 0;                        ///< push per length over the depth [N/m^2]
  std::optional<double> depth = {};            ///< over which it sets in [m]; if not given, the beam's weight over it
  double damping = 0;                          ///< per length, of the velocity into it [N s/m^2]
  std::optional<AxialFriction> friction = {};  ///< against the velocity along it
};

/// How the shape of a merged element is found: as MergeShape says.
enum class MergePolicy {
  point_fit,
  unit,
  rest_arc,
  least_change,
  own,
  relaxed,  ///< weights by rest_arc where the beam is curved at rest, else by point_fit; then the outer nodes give way
};

/// Where the new node of a cut element is.
enum class CutPolicy {
  exact,    ///< on its curve (Ding & Ouyang 2022, Eq. 21-28)
  relaxed,  ///< at the least strain energy of the two halves
};

/// How the lengths of the elements beside the sliding mass are controlled.
struct LengthControlSpec {
  bool enabled = true;
  double upper = 1.5;                     ///< trigger length over L_std
  double hysteresis = 1e-3;               ///< the trigger is upper (1 + hysteresis) L_std, in [1.5, 2) L_std
  std::optional<CutPolicy> cut = {};      ///< see cut_policy()
  std::optional<MergePolicy> merge = {};  ///< see merge_policy()
  MergeRule merge_rule = {};              ///< of the policy `own`; no scene file can hold it
  VelocityTransfer velocities = VelocityTransfer::projected;
  std::optional<double> end_merge;   ///< over L_std: a shorter last element loses its moving node; see end_merge()
  std::optional<double> lower = {};  ///< over L_std: a shorter element beside a joint is merged; see merge_below()
};

/// Absolute tolerances by kind. That of slopes is the one of lengths over L_std, that of twist the one of angles; of
/// rates likewise.
struct AbsoluteTolerances {
  double length = 0;            ///< positions and material coordinates [m]
  double velocity = 0;          ///< of their rates [m/s]
  std::optional<double> angle;  ///< about the axis [rad]; if not given that of slopes
  std::optional<double> spin;   ///< of its rate [rad/s]; if not given that of the rates of slopes
  /// [m] of displacement, from which they hold in full (generalized-alpha): see Tolerances
  std::optional<double> motion = {};
};

/// The time integrator; the comments say which methods use what.
struct IntegratorSpec {
  IntegratorType type = IntegratorType::dopri5;
  double rtol = 1e-9;  ///< error-controlled methods
  double atol = 1e-9;  ///< error-controlled methods; of all of the state, in its own units
  std::optional<AbsoluteTolerances> atol_by_kind = {};  ///< in place of it
  double step = 1e-3;                                   ///< methods of fixed step [s]
  double rho_inf = 0.9;                                 ///< generalized-alpha: spectral radius at infinity
  NewtonKind newton = NewtonKind::modified;             ///< generalized-alpha
  double newton_tolerance = 0;                          ///< generalized-alpha: what Newton leaves, over the increment
  bool adaptive = false;                                ///< generalized-alpha: the step follows rtol and atol
  ErrorEstimate error_estimate = ErrorEstimate::all;    ///< generalized-alpha, adaptive
  bool locate_events = true;
  bool automatic = false;   ///< chosen for the scene ("auto"), not by its writer
  double accuracy = 1e-4;   ///< asked of an automatic run, of the beam's length and of the motion
  std::string reason = {};  ///< why it was chosen
};

/// An end of the beam.
enum class BeamEnd { start, end };

/// A place on the beam whose motion and section forces the samples have; one of what says where.
struct PlaceSpec {
  std::string name = {};
  std::optional<double> x = {};        ///< material coordinate [m]
  std::optional<BeamEnd> end = {};     ///< the node there, wherever a winch moves it to
  std::optional<int> joint = {};       ///< of /sliding_joints, from 0; the sliding mass is 0
  std::optional<int> point_mass = {};  ///< of /point_masses, from 0
};

/// What is recorded.
struct OutputSpec {
  double interval = 0.005;             ///< [s]
  std::vector<double> configurations;  ///< times [s] at which the whole shape is kept
  int points = 0;         ///< intervals an element at whose ends the report has the axis of each such shape; 0: none
  bool extremes = false;  ///< of each quantity of the samples over all steps, and when
};

/// What is computed of a scene.
enum class Analysis {
  dynamics,
  statics,  ///< equilibria under loads that grow
};

/// The shape that a motion starts from.
enum class InitialShape {
  built,
  equilibrium,  ///< under what acts at t = 0
};

/// What makes the loads of an equilibrium grow.
enum class LoadControl {
  load,
  arc_length,  ///< steps along the path of equilibria, on which the load factor may also fall
};

/// What becomes of joints that slide, which keep their place on the beam while the load grows.
enum class StaticJoints {
  released,  ///< then they find theirs
  held,
};

struct StaticsSpec {
  int steps = 10;
  LoadControl control = LoadControl::load;
  double tolerance = 1e-12;  ///< largest last correction: of positions over the beam's length, and of slopes
  int frequencies = 0;       ///< how many, about the last equilibrium
  std::optional<StaticJoints> joints = {};  ///< see static_joints()
};

struct AssemblySpec;

/// One beam, its supports and loads, and what slides on it; or a shaft that spins or flows through its
/// supports; or several beams and bodies. SI units.
struct Scene {
  std::string title;
  SceneSetting setting = SceneSetting::standard;
  int dimension = 2;
  Point gravity{0, -9.81, 0};  ///< [m/s^2]
  double gravity_ramp = 0;     ///< T_r [s]: gravity grows as S(t/T_r), S(s) = s^4 (35 - 84 s + 70 s^2 - 20 s^3)
  BeamSpec beam;
  SupportSpec start;
  SupportSpec end;
  std::vector<BearingSpec> bearings = {};             ///< in /supports beside those of the ends
  std::optional<SlidingMassSpec> sliding_mass;        ///< short for one sliding joint that is free
  std::vector<SlidingJointSpec> sliding_joints = {};  ///< in order along the beam; none beside a sliding mass
  std::vector<BlockSpec> blocks = {};
  std::optional<ContactSpec> contact = {};  ///< of several joints
  std::optional<SpinSpec> spin;
  std::optional<FlowSpec> flow;
  std::vector<LoadSpec> loads = {};
  std::vector<VehicleSpec> vehicles = {};
  std::vector<PointMassSpec> point_masses = {};
  std::vector<PlaceSpec> places = {};
  std::optional<InitialVelocitySpec> initial_velocity;
  std::optional<DragSpec> drag = {};
  std::optional<FluidSpec> fluid = {};
  std::optional<GroundSpec> ground = {};
  Analysis analysis = Analysis::dynamics;
  InitialShape initial_shape = InitialShape::built;
  StaticsSpec statics;
  Formulation formulation = Formulation::variational;
  std::optional<WeightTransport> weights = {};  ///< see weight_transport()
  LengthControlSpec length_control;
  Constraints constraints = Constraints::eliminated;
  IntegratorSpec integrator;
  double duration = 0.5;  ///< [s]
  OutputSpec output;
  /// Several beams and bodies; `beam` is then the longest of them, by which lengths go, and all else is that of beams.
  std::shared_ptr<const AssemblySpec> assembly = {};
  std::string assumed = {};  ///< what its file left out of section and material, as pointers in a sentence; no option
};

}  // namespace vlbeam
