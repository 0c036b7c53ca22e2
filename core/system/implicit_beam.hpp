#pragma once

#include <vector>

#include "core/beam/block_tridiagonal.hpp"
#include "core/dynamics/second_order.hpp"
#include "core/system/beam_system.hpp"

namespace vlbeam {

/// A beam system as an implicit method sees it: residual M a - Q and its exact tangent, in the coordinates of
/// BeamSystem's state. The tangent is block tridiagonal in the nodes with the joint's material coordinate as a border;
/// fixed elements contribute the derivative of their stresses, the two elements at the joint that of their whole
/// residual (inertia, velocity terms and configurational force included), both by automatic differentiation.
template <int D>
class ImplicitBeam final : public SecondOrderSystem {
 public:
  /// `system` must outlive this object; its events may change it at any time.
  explicit ImplicitBeam(BeamSystem<D>& system) : system_(system) {}

  Eigen::Index coordinates() const override { return system_.coordinates(); }
  void acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, Eigen::VectorXd& a) override;
  double residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                  Eigen::VectorXd& r) override;
  bool linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t, double by_v,
                 double by_a) override;
  void solve(Eigen::VectorXd& r) const override;
  void jacobian(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) override;

 private:
  static constexpr int B = node_size<D>;
  using Block = Eigen::Matrix<double, B, B>;
  struct FixedElement {
    int index;
    FixedBasis<double> basis;
    std::array<std::array<double, 4>, 4> mass;  ///< rhoA times the integral of s_i s_j
  };

  void refresh();
  /// The tangent before supports and factorization.
  void assemble(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t, double by_v,
                double by_a);
  /// Sets what supports fix to zero, in their frames.
  void project(double* nodes) const;
  void constrain_tangent();
  void add_dissipation_row(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy);
  template <class Function>
  void at_end_nodes(const Function& function) const;

  BeamSystem<D>& system_;
  std::size_t revision_ = static_cast<std::size_t>(-1);
  std::vector<FixedElement> fixed_;
  BorderedBlockTridiagonal<B> tangent_;
  double by_a_ = 0;
  Eigen::VectorXd y_, dydt_;
  Eigen::VectorXd a_, column_, weightless_;  // of the Jacobian
  Eigen::MatrixXd stiffness_, damping_;
};

extern template class ImplicitBeam<2>;
extern template class ImplicitBeam<3>;

}  // namespace vlbeam
