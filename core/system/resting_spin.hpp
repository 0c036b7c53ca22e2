#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/dynamics/fields.hpp"
#include "core/dynamics/tallies.hpp"
#include "core/system/spin_chain.hpp"

namespace vlbeam {

/// The section's angle at a node as a function of time [rad].
struct DrivenAngle {
  int node;
  TimeFunction theta;
};

/// Throws InvalidInput where angles are driven at nodes that do not exist, twice at one, or at two places apart.
void check_drives(const std::vector<DrivenAngle>& drives, int last_node);

/// Torques about the axis, as functions of time.
struct Torques {
  struct Point {
    std::function<double(double t)> x;       ///< material coordinate [m]
    std::function<double(double t)> torque;  ///< [N m]
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
};

/// The section's angle along a beam whose nodes rest: it couples to nothing else, its equations are linear and their
/// mass matrix is constant.
class RestingSpin {
 public:
  /// `x` are the material coordinates of the nodes.
  RestingSpin(const SpinModel& model, const std::vector<double>& x, Formulation formulation, int quadrature_points);

  const SpinModel& model() const { return model_; }
  Eigen::Index coordinates() const { return chain_.coordinates(); }
  /// Where the angle of a node stands among them.
  Eigen::Index angle(int node) const { return Eigen::Index{chain_.per_node()} * node; }
  /// What they are, the first of them at `first`.
  std::vector<FieldRun> fields(Eigen::Index first) const;
  /// Angles and their rates at t = 0.
  void start(double* q, double* rate) const;

  /// Writes the accelerations and adds powers; false where the mass matrix is singular.
  bool accelerate(const double* q, const double* rate, double t, double* a, Tally& power);
  /// Writes M a - Q before driven angles; returns the power lost to damping [W].
  double residual(const double* q, const double* rate, const double* a, double t, double* r);
  /// Puts the equations of driven angles in place of theirs.
  void drive(const double* a, double t, double* r) const;
  /// Powers of drives and torques, from what residual() wrote.
  Tally power(const double* q, const double* rate, const double* residual, double t) const;
  /// Torque of each drive on the beam [N m], from the same.
  std::vector<double> drive_torques(const double* residual) const;
  /// Its tangent, factored into `tangent`.
  bool linearize(double by_v, double by_a, SpinTangent& tangent) const;

  struct Seen {
    double kinetic = 0, torsion = 0, momentum = 0;  ///< [J], [J], [N m s]
  };
  Seen observe(const double* q, const double* rate, int points) const;

 private:
  /// Adds the torques, unless `f` is null; returns their power.
  double add_torques(const double* q, const double* rate, double t, double* f) const;

  SpinModel model_;
  SpinChain::Nodes nodes_;
  SpinChain chain_;
  Eigen::VectorXd prescribed_, residual_;
};

}  // namespace vlbeam
