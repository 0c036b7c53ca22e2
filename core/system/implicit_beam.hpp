#pragma once

#include <vector>

#include "core/beam/block_tridiagonal.hpp"
#include "core/dynamics/second_order.hpp"
#include "core/system/beam_system.hpp"
#include "core/system/conserving_step.hpp"

namespace vlbeam {

/// A beam system as an implicit method sees it: residual M a - Q and its exact tangent, in the coordinates of
/// BeamSystem's state. The tangent is block tridiagonal in the nodes with the joint's material coordinate as a border;
/// fixed elements contribute the derivative of their stresses, the two elements at the joint that of their whole
/// residual (inertia, velocity terms and configurational force included), both by automatic differentiation.
template <int D>
class ImplicitBeam final : public SecondOrderSystem {
 public:
  /// `system` must outlive this object; its events may change it at any time.
  explicit ImplicitBeam(BeamSystem<D>& system) : system_(system), conserving_step_(system) {}

  Eigen::Index coordinates() const override { return system_.coordinates(); }
  void acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, Eigen::VectorXd& a) override;
  double residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                  Eigen::VectorXd& r) override;
  bool linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t, double by_v,
                 double by_a) override;
  void solve(Eigen::VectorXd& r) const override;
  double conserving_residual(const Eigen::VectorXd& q0, const Eigen::VectorXd& v0, const Eigen::VectorXd& q1,
                             const Eigen::VectorXd& v1, double t, double h, Eigen::VectorXd& r) override {
    return conserving_step_.residual(q0, v0, q1, v1, t, h, r);
  }

 private:
  static constexpr int B = node_size<D>;
  using Block = Eigen::Matrix<double, B, B>;
  struct FixedElement {
    int index;
    FixedBasis<double> basis;
    std::array<std::array<double, 4>, 4> mass;  ///< rhoA times the integral of s_i s_j
  };

  void refresh();
  /// Sets what supports fix to zero, in their frames.
  void project(double* nodes) const;
  void constrain_tangent();
  template <class Function>
  void at_end_nodes(const Function& function) const;

  BeamSystem<D>& system_;
  ConservingStep<D> conserving_step_;
  std::size_t revision_ = static_cast<std::size_t>(-1);
  std::vector<FixedElement> fixed_;
  BorderedBlockTridiagonal<B> tangent_;
  double by_a_ = 0;
  Eigen::VectorXd y_, dydt_;
};

extern template class ImplicitBeam<2>;
extern template class ImplicitBeam<3>;

}  // namespace vlbeam
