#pragma once

#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <memory>
#include <string>
#include <vector>

#include "mechanics/assembly/assembly.hpp"
#include "mechanics/time/second_order.hpp"

namespace vlbeam {

/// An assembly as an implicit method sees it. Its coordinates are those of all members, then the multipliers of all
/// members, then those of links.
///
/// With K_b the tangent of member b, and t = B^T x what links take hold of, the tangent of the whole is
/// K x + B (L t + G^T eta) = r, G t = c: L is what springs and curved conditions add, G the conditions' gradients, eta
/// their forces. The members' own factors give F = B^T K^-1 B, a column a vector that a link takes hold of; what is
/// left is a dense system of eta and of the t that L acts on.
template <int D>
class AssemblyEquations final : public SecondOrderSystem {
 public:
  explicit AssemblyEquations(AssemblySystem<D>& system);

  Eigen::Index coordinates() const override;
  Eigen::Index multipliers() const override;
  std::vector<FieldRun> fields() const override;
  void expand(const Eigen::VectorXd& y, Eigen::VectorXd& q, Eigen::VectorXd& v) const override;
  void contract(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& y) const override;
  void acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, Eigen::VectorXd& a) override {
    find_acceleration(q, v, t, a);
  }
  double residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                  Eigen::VectorXd& r) override;
  bool inertia(const Eigen::VectorXd& q, const Eigen::VectorXd& a, double t, Eigen::VectorXd& r) override;
  ConstraintResidual constraint_residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t) const override;
  bool driven() const override;
  bool driven_offset(const Eigen::VectorXd& q, double t, Eigen::VectorXd& offset) const override;
  double turning(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const override;
  BalanceEntries balance() const override { return system_.balance(); }
  EnergyBalance supplied_power(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                               double t) override;
  std::optional<double> power_lost_between(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1,
                                           const Eigen::VectorXd& a0, const Eigen::VectorXd& a1, double h,
                                           double t) override;
  bool linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                 const TangentWeights& by) override;
  void solve(Eigen::VectorXd& r) const override;
  void follow(const SecondOrderSystem& other) override;
  void exchange(Archive& memory) override;

  /// acceleration(), and the power that dampers of links take [W].
  double find_acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, Eigen::VectorXd& a);
  /// Takes from the rates v what links do not allow, by impulses.
  void project(const Eigen::VectorXd& q, Eigen::VectorXd& v, double t);
  /// Brings coordinates that are next to what links hold onto it, and rates.
  void approach(Eigen::VectorXd& q, Eigen::VectorXd& v, double t);

 private:
  struct View {
    std::unique_ptr<SecondOrderSystem> equations;
    Eigen::Index first = 0, own = 0, first_multiplier = 0, multipliers = 0;  ///< where it stands in the whole
    std::vector<std::size_t> handles = {};                                   ///< that links have on it
    Eigen::MatrixXd columns = {};  ///< K^-1 of a unit force on each component of these
    mutable Eigen::VectorXd q = {}, v = {}, a = {}, r = {};
  };
  /// Of the largest pivot: below, a condition follows from others.
  static constexpr double redundant_share = 1e-11;

  void refresh() const;
  void gather(const View& view, const Eigen::VectorXd& whole, Eigen::VectorXd& own) const;
  void scatter(const View& view, const Eigen::VectorXd& own, Eigen::VectorXd& whole) const;
  /// Writes what links take hold of.
  void touch(const Eigen::VectorXd& q, bool rates, Eigen::VectorXd& h) const;
  Eigen::VectorXd touch(const Eigen::VectorXd& q, bool rates) const {
    Eigen::VectorXd h;
    touch(q, rates, h);
    return h;
  }
  /// Of a link: its part of that.
  LinkVector part_of(const Eigen::VectorXd& touched, std::size_t link) const;
  /// Forces of springs on all that links take hold of, and the power lost.
  double spring_forces(const Eigen::VectorXd& h, const Eigen::VectorXd& rate, Eigen::VectorXd& force) const;
  /// Gradients of all conditions.
  Eigen::MatrixXd gradients(const Eigen::VectorXd& h) const;
  /// Hands forces on all that links take hold of to the members.
  void hand_out(const Eigen::VectorXd& forces) const;
  /// All forces of links.
  double link_forces(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                     Eigen::VectorXd& forces) const;
  /// Moves `what`, coordinates or rates, by impulses along the links, so that what these hold changes by -off.
  void push(Eigen::VectorXd& what, const Eigen::MatrixXd& rows, const Eigen::MatrixXd& mobility,
            const Eigen::VectorXd& off, double t);
  /// Writes the values of all conditions.
  void write_conditions(const Eigen::VectorXd& h, double* values) const;
  /// Accelerations of what links take hold of per unit of force on it, by the members' masses; `free` without any.
  void mobility(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, Eigen::VectorXd& free,
                Eigen::MatrixXd& mobility);

  AssemblySystem<D>& system_;
  mutable std::size_t revision_ = static_cast<std::size_t>(-1);
  mutable std::vector<View> views_;
  mutable Eigen::Index own_ = 0, all_ = 0, conditions_ = 0;
  mutable double unit_ = 1;  ///< makes an acceleration of a multiplier [kg]
  double scale_ = 1;         ///< by.a unit_
  // of linearize()
  Eigen::SparseMatrix<double> gradients_, curvature_;  ///< G and L: a link has few entries of them
  std::vector<Eigen::Index> bent_;                     ///< rows of L that are not zero
  double force_size_ = 1;                              ///< of eta
  bool dependent_ = false;                             ///< some conditions follow from others
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
  Eigen::FullPivLU<Eigen::MatrixXd> careful_factors_;
  mutable Eigen::VectorXd h_, rate_, forces_, touched_, right_, pull_, eta_;  // working memory
  Eigen::VectorXd middle_q_, middle_v_, middle_a_, middle_r_;                 // of power_lost_between()
};

extern template class AssemblyEquations<2>;
extern template class AssemblyEquations<3>;

}  // namespace vlbeam
