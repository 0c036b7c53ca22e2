#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/geometry/prescribed.hpp"
#include "mechanics/assembly/handle.hpp"
#include "mechanics/motion/system/observation.hpp"
#include "mechanics/motion/system/ramp_work.hpp"
#include "mechanics/time/integrate.hpp"

namespace vlbeam {

/// A load on a body.
template <int D>
struct BodyLoad {
  /// A force at a place in body axes; without it a torque, about the normal of the plane in the plane.
  std::optional<Vec<double, D>> place;
  std::function<Vec<double, 3>(double t)> value;  ///< [N] or [N m], in space
};

/// A rigid body, or a point mass where it has no moments of inertia.
template <int D>
struct BodyModel {
  double mass = 1;                                  ///< [kg]
  Vec<double, 3> inertia = Vec<double, 3>::Zero();  ///< about the axes of the body, its main ones [kg m^2]; in the
                                                    ///< plane the last; all zero: a point mass
  Vec<double, D> center = Vec<double, D>::Zero();   ///< of mass, at t = 0 [m]
  Eigen::Matrix<double, D, D> axes = Eigen::Matrix<double, D, D>::Identity();  ///< columns: body axes at t = 0
  Vec<double, D> velocity = Vec<double, D>::Zero();                            ///< of the center at t = 0 [m/s]
  Vec<double, 3> spin = Vec<double, 3>::Zero();     ///< angular velocity at t = 0, in space [rad/s]
  Vec<double, D> gravity = Vec<double, D>::Zero();  ///< [m/s^2]
  double gravity_ramp = 0;                          ///< [s]
  bool time_is_load_factor = false;                 ///< gravity is t times what it says: statics
  std::vector<BodyLoad<D>> loads = {};

  bool turns() const { return !inertia.isZero(0); }
  /// Second moments of the mass along the body axes, E_i = integral of b_i^2 dm [kg m^2].
  Vec<double, D> second_moments() const {
    if constexpr (D == 2) {
      return Vec<double, 2>::Constant(inertia[2] / 2);
    } else {
      return Vec<double, 3>::Constant(inertia.sum() / 2) - inertia;
    }
  }
  Vec<double, D> gravity_at(double t) const {
    return gravity * (time_is_load_factor ? t : smooth_ramp(t, gravity_ramp).value);
  }
};

/// A rigid body as equations of motion. Its coordinates are its center c and its D axes d_i, vectors of length 1 across
/// each other; a place b in body axes is at c + sum b_i d_i. So its mass matrix is constant, points of it are linear in
/// the coordinates, and no rotation is a special one. The D (D + 1)/2 conditions on the axes have multipliers. A point
/// mass has its center alone.
///
/// Kinetic energy: (m c'.c' + sum E_i d_i'.d_i')/2 with the second moments of the mass E_i, in main axes.
template <int D>
class BodySystem final : public EventedOde {
 public:
  explicit BodySystem(BodyModel<D> model);

  const BodyModel<D>& model() const { return model_; }
  Eigen::Index coordinates() const { return model_.turns() ? Eigen::Index{D} * (D + 1) : Eigen::Index{D}; }
  Eigen::Index multipliers() const { return model_.turns() ? Eigen::Index{D} * (D + 1) / 2 : 0; }
  BalanceEntries balance() const { return {.loads = !model_.loads.empty()}; }
  Eigen::VectorXd initial_state() const;
  Handle<D> point(const Vec<double, D>& place) const;
  Handle<D> direction(const Vec<double, D>& place) const;
  LinkForces<D>& link_forces() { return forces_; }

  Eigen::Index size() const override { return 2 * coordinates() + balance().count(); }
  std::vector<FieldRun> fields() const override;
  void rhs(const Eigen::VectorXd& y, Eigen::VectorXd& dydt, double t) override;
  void jacobian(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) override;
  std::unique_ptr<SecondOrderSystem> new_second_order() override;
  Guards guards(const Eigen::VectorXd& /*y*/, double /*t*/) const override { return {}; }
  void handle_event(int /*index*/, Eigen::VectorXd& /*y*/, double /*t*/) override {}
  void sample(const Eigen::VectorXd& /*y*/, double /*t*/) override {}
  bool proceed(const Eigen::VectorXd& y, double t) override;

  /// Energies and momenta at a state.
  Observation<D> observe(const Eigen::VectorXd& y, double t) const;
  /// Columns: the body axes.
  Eigen::Matrix<double, D, D> axes(const double* q) const;
  /// Angular velocity in space; in the plane its last component [rad/s].
  Vec<double, 3> spin(const double* q, const double* rate) const;

  /// Adds the forces of links and loads to an array like q; returns the power of the loads [W]. `rate` may be null.
  double add_forces(const double* q, const double* rate, double t, double* force) const;
  /// Brings the axes of a state back to length 1, across each other, and their rates to a rotation; false for a point
  /// mass.
  bool square_up(Eigen::VectorXd& y) const;
  /// M, its diagonal.
  Eigen::VectorXd masses() const;
  /// Writes the conditions on the axes, and dC/dq.
  void conditions(const double* q, double* values) const;
  Eigen::MatrixXd gradients(const double* q) const;
  /// Pairs of axes, in the order of the conditions.
  static constexpr int pairs = D * (D + 1) / 2;
  static std::pair<int, int> pair(int condition);

 private:
  BodyModel<D> model_;
  LinkForces<D> forces_;
  RampWork<D> ramp_;
};

extern template class BodySystem<2>;
extern template class BodySystem<3>;

}  // namespace vlbeam
