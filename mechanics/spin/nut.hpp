#pragma once

#include <Eigen/Core>

#include "mechanics/spin/spin.hpp"

namespace vlbeam {

/// A nut on a beam that spins, a lead screw. It does not turn itself, so that its thread ties where it is, x, to the
/// angle there:  theta(x, t) + 2 pi x/pitch  stays what it was. With N the shape functions of the angles at x, the
/// twist theta_x, and  a = 2 pi/pitch + theta_x,
///   x' = -theta_t/a,   x'' = g . theta'' + c,   g = -N/a,   c = -(2 theta_tx x' + theta_xx x'^2)/a.
/// The thread pushes the nut by R along the beam and turns the beam by -R g: it does no work. With M the inertia of the
/// angles, and theta'' = a_0 without the nut, R = I (g . a_0 + c - x'') where 1/I = g . M^-1 g: to the rest of the beam
/// the nut is a mass I along the beam, with a force on it.
class Nut {
 public:
  /// `pitch` [m a turn], right-handed where it is positive; the nut is at `x` where the angle is `angle`.
  Nut(double pitch, double x, double angle);

  /// Where it is by the angles, and how fast it is; `x` is a first guess. Nan where there is no such place.
  struct Place {
    double x, rate;
  };
  Place place(const Spin& spin, const double* q, const double* rate, double x) const;

  /// As the equation of x sees it, by the accelerations `a` that the angles would have without it.
  struct Load {
    double inertia, force;  ///< [kg], [N]
  };
  /// False where nothing is free to turn.
  bool couple(Spin& spin, const double* q, const double* rate, const double* a, double x, double x_rate);
  const Load& load() const { return load_; }
  /// Corrects the accelerations of the angles by that of x; returns the thread's push R on the nut [N].
  double turn(double x_acceleration, double* a) const;
  /// What the thread does to the angles as it pushes the nut by `push`, after couple().
  const Eigen::VectorXd& torque(double push) { return torque_ = -push * by_angles_; }
  /// For Newton's method: how far the nut is beyond its place by the angles [m], g and what changes it,
  /// dg = slope dx + share (twist . dq); the twist there is twist . q.
  struct Thread {
    double off;
    Eigen::VectorXd by_angles, slope, share, twist;
  };
  Thread thread(const Spin& spin, const double* q, const double* rate, double x) const;
  double off(const Spin& spin, const double* q, const double* rate, double x) const;
  /// The same of a state.
  Eigen::VectorXd torque(const Spin& spin, const double* q, const double* rate, double x, double push) const;

 private:
  double per_length_;  ///< 2 pi/pitch [rad/m]
  double sum_;         ///< theta + 2 pi x/pitch
  Load load_{};
  Eigen::VectorXd by_angles_, answer_, torque_;  ///< g, M^-1 g and -R g
};

}  // namespace vlbeam
