#pragma once

#include <vector>

#include "mechanics/flow/moving_mesh.hpp"

namespace vlbeam {

/// What flows through the ends of a beam whose nodes all travel along it as prescribed, and what it brings.
template <int D>
class Flow final : public MeshEquations<D> {
 public:
  using Vector = Vec<double, D>;
  using typename MeshEquations<D>::Elements;

  /// `beam` must outlive this object.
  explicit Flow(CurrentBeam<D>& beam) : beam_(beam) {}

  double add_residual(const double* q, const double* rate, const double* a, double t, double* r) override;
  void add_inertia(const double* a, double* r) const override { mesh().add_inertia(elements_, a, r); }
  void add_tangent(const Motion<D>& now, const TangentWeights& by, BeamMatrix<D>& tangent) const override;
  EnergyBalance power(const Elements* elements, const double* q, const double* rate, const double* a,
                      double t) override;

 private:
  MovingMesh<D>& mesh() const { return moving_mesh_of(beam_); }

  CurrentBeam<D>& beam_;
  Elements elements_;
  Eigen::VectorXd residual_, forces_;  ///< of power()
  std::vector<double> on_marks_;       ///< the same
};

extern template class Flow<2>;
extern template class Flow<3>;

}  // namespace vlbeam
