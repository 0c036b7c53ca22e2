#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/tangent_weights.hpp"
#include "mechanics/spin/spin_chain.hpp"
#include "mechanics/time/energy_balance.hpp"
#include "mechanics/time/fields.hpp"

namespace vlbeam {

/// The section's angle at a node as a function of time [rad].
struct DrivenAngle {
  int node;
  TimeFunction theta;
};

/// Throws ModelError where angles are driven at nodes that do not exist, twice at one, or at two places apart.
void check_drives(const std::vector<DrivenAngle>& drives, int last_node);

/// Torques about the axis, as functions of time.
struct Torques {
  struct Point {
    int node = -1;                                ///< it acts where this node is,
    std::function<double(double t)> x = {};       ///< or at this material coordinate [m]
    std::function<double(double t)> torque = {};  ///< [N m]
  };
  std::vector<Point> points = {};
  std::function<double(double t)> line = {};  ///< on the whole beam [N m/m]

  bool present() const { return !points.empty() || line; }
};

/// How a section turns about the axis of a beam.
struct SpinModel {
  SpinSection section;
  AngleField field = AngleField::linear;
  double rate = 0;  ///< of the whole beam at t = 0 [rad/s]
  std::vector<DrivenAngle> drives = {};
  Torques torques = {};
  std::vector<double> pitch = {};  ///< of the model's joints that are nuts [m a turn], right-handed where > 0; else 0

  double pitch_of(int joint) const {
    const auto i = static_cast<std::size_t>(joint);
    return i < pitch.size() ? pitch[i] : 0;
  }
  /// Whether energy comes in.
  bool supplied() const { return torques.present() || !drives.empty(); }
};

/// The section's angle along a beam. It couples to the rest of the motion through the material coordinates of the nodes
/// alone: where these rest or are prescribed, its equations are linear.
class Spin {
 public:
  /// `marks` are the material coordinates of the nodes.
  Spin(const SpinModel& model, std::vector<Prescribed> marks, Formulation formulation, int quadrature_points);

  const SpinModel& model() const { return model_; }
  Eigen::Index coordinates() const { return chain_.coordinates(); }
  /// Where the angle of a node stands among them.
  Eigen::Index angle(int node) const { return Eigen::Index{chain_.per_node()} * node; }
  /// The runs of angles and twists among a state whose coordinates begin at `first`.
  std::vector<FieldRun> fields(Eigen::Index first) const;
  /// Angles and their rates at t = 0.
  void start(double* q, double* rate) const;
  /// Where the nodes are now, if they move.
  void move(const std::vector<Prescribed>& marks) { marks_ = marks; }

  /// Writes the accelerations; false where the mass matrix is singular. Adds the power lost to damping [W].
  bool accelerate(const double* q, const double* rate, double t, double* a, double& dissipated);
  /// Writes M a - Q before driven angles; returns the power lost to damping [W].
  double residual(const double* q, const double* rate, const double* a, double t, double* r);
  /// The same of the elements alone, without torques and what flows in with the matter.
  double inner_residual(const double* q, const double* rate, const double* a, double* r);
  /// Writes M a, and of driven angles a itself.
  void inertia(const double* a, double* r) const;
  /// Puts the equations of driven angles in place of theirs.
  void drive(const double* a, double t, double* r) const;
  /// Powers of drives and torques at the accelerations `a`; `more` acts on the angles, too, unless it is null.
  EnergyBalance power(const double* q, const double* rate, const double* a, double t,
                      const Eigen::VectorXd* more = nullptr);
  /// Torque of each drive on the beam [N m], from what residual() wrote.
  std::vector<double> drive_torques(const double* residual) const;
  /// Adds the torques; returns their power [W]. What they do along the beam [N] is added to `on_marks`, one entry a
  /// node, unless that is null.
  double add_torques(const double* q, const double* rate, double t, double* f, double* on_marks = nullptr) const;
  /// Forces along the beam [N] that move the ends of element k as their marks move, at the accelerations of the last
  /// residual() or inner_residual().
  const std::array<double, 2>& guiding_forces(int k) const { return chain_.guiding_forces(k); }
  /// The tangent of residual(), before driven angles.
  void assemble(const TangentWeights& by, SpinTangent& tangent) const;
  /// Factors it; false where it is singular.
  bool factor(double by_a, SpinTangent& tangent) const { return tangent.factor(chain_, by_a); }
  bool driven(int node) const { return chain_.driven(node); }

  /// What is at the material coordinate x, and the element that it is in.
  struct Section {
    int element;
    SpinChain::Point at;
  };
  Section section(const double* q, const double* rate, double x) const;
  /// Adds a torque times the shape functions there, and `couple` [N m^2] times their gradients.
  void scatter(const Section& at, double torque, double couple, double* f) const;
  /// M a = f in place by the factor of the last accelerate().
  void solve_again(double* f) { chain_.solve_again(f); }

  struct Seen {
    double kinetic = 0, torsion = 0, momentum = 0;  ///< [J], [J], [N m s]
  };
  Seen observe(const double* q, const double* rate, int points) const;

 private:
  /// An end of the beam that moves along it: its node, the element there, and the length that comes in a second.
  struct Inlet {
    int node, element;
    double rate, in;
  };
  std::array<Inlet, 2> inlets() const;
  /// Takes from `r` the torques and what flows in with the matter.
  void take_forces(const double* q, const double* rate, double t, double* r);
  /// Adds the momentum that comes in with the matter at the ends.
  void add_inflow(const double* q, const double* rate, double* f) const;

  SpinModel model_;
  std::vector<Prescribed> marks_;
  Formulation formulation_;
  SpinChain chain_;
  Eigen::VectorXd prescribed_, forces_, residual_;
};

}  // namespace vlbeam
