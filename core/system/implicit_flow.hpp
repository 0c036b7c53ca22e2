#pragma once

#include "core/beam/block_tridiagonal.hpp"
#include "core/dynamics/second_order.hpp"
#include "core/system/flowing_beam.hpp"

namespace vlbeam {

/// A flowing beam as an implicit method sees it: residual M a - Q and its exact tangent, block tridiagonal in the nodes
/// for the axis and tridiagonal for the angles, which couple to the axis nowhere.
template <int D>
class ImplicitFlow final : public SecondOrderSystem {
 public:
  /// `beam` must outlive this object.
  explicit ImplicitFlow(FlowingBeam<D>& beam) : beam_(beam) {}

  Eigen::Index coordinates() const override { return beam_.coordinates(); }
  std::vector<FieldRun> fields() const override { return beam_.fields(); }
  Tallies tallies() const override { return beam_.tallies(); }
  Tally supplied_power(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                       double t) override {
    // by the elements of the last residual, which Newton's last correction is next to nothing away from
    return !beam_.model().ledger ? Tally{} : beam_.supplied(q.data(), v.data(), a.data(), t);
  }
  void acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, Eigen::VectorXd& a) override;
  double residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                  Eigen::VectorXd& r) override;
  bool linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t, double by_v,
                 double by_a) override;
  void solve(Eigen::VectorXd& r) const override;
  /// Not there: throws InvalidInput.
  void jacobian(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) override;
  /// Not there: throws InvalidInput.
  double conserving_residual(const Eigen::VectorXd& q0, const Eigen::VectorXd& v0, const Eigen::VectorXd& q1,
                             const Eigen::VectorXd& v1, double t, double h, Eigen::VectorXd& r) override;

  /// The tangent with weights `by`, of free coordinates, dense: those of the axis, of 2 D a node, and those of the
  /// angles. Fixed and driven ones are left out.
  struct Tangent {
    Eigen::MatrixXd axis, angles;
  };
  Tangent free_tangent(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                       const TangentWeights& by);

 private:
  static constexpr int B = node_size<D>;
  using Block = Eigen::Matrix<double, B, B>;
  using NodeVector = Eigen::Matrix<double, B, 1>;

  /// Both matrices before supports and driven angles.
  void assemble(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                const TangentWeights& by);
  /// Derivatives of the momentum that comes in with the matter at the ends.
  void add_inflow(const TangentWeights& by);
  void add_rotary_inflow(int k, double in, const TangentWeights& by);
  /// Projector onto what the support at a node leaves free.
  Block kept(int node) const;
  void constrain();

  FlowingBeam<D>& beam_;
  BorderedBlockTridiagonal<B> axis_;
  SpinTangent angles_;
  Eigen::VectorXd force_, y_, dydt_;
};

extern template class ImplicitFlow<2>;
extern template class ImplicitFlow<3>;

}  // namespace vlbeam
