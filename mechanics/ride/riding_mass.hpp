#pragma once

#include "mechanics/motion/system/current_beam.hpp"
#include "mechanics/ride/rider.hpp"

namespace vlbeam {

/// A mass inside the first or the last element of a beam.
template <int D>
class RidingMass final : public LooseMass<D> {
 public:
  using Vector = Vec<double, D>;
  using typename LooseMass<D>::Answer;
  using typename LooseMass<D>::Place;

  /// `beam`, whose spans share their open node, must outlive this object.
  RidingMass(const CurrentBeam<D>& beam, const typename ChainState<D>::Loose& rider);

  int element() const { return element_; }
  bool at_end() const { return element_ > 0; }
  bool held() const { return held_; }
  double end() const { return end_; }  ///< material coordinate of the beam's end there [m]
  const RiderElement& curve() const { return curve_; }
  const SlidingJoint& law() const { return beam_.model().joints.front().law; }
  RiderMotion<double, D> motion(const double* q, const double* rate) const;

  void update() override { mass_.update(beam_.left(), beam_.right()); }
  void write(ChainState<D>& chain, double x, double rate) const override { chain.loose = {element_, x, rate, held_}; }
  Place place(const double* q, const double* rate) const override {
    const auto at = motion(q, rate);
    return {at.r, at.v, at.r_x};
  }
  Vector acceleration(const double* q, const double* rate, const double* a) const override;
  double add_residual(const Motion<D>& now, double* r) const override;
  void add_tangent(const Motion<D>& now, const TangentWeights& by, BeamMatrix<D>& tangent) const override;
  std::optional<Answer> accelerate(const double* q, const double* rate, const Vector& gravity,
                                   double* a) const override;
  bool solve(const double* q, double* p) const override;
  void add_momentum(const double* q, const double* rate, const Vector& v, double* out) const override;

 private:
  /// Where its coordinate stands.
  Eigen::Index x() const { return beam_.dofs().mark(); }
  NodalCubic<double, D> nodes(const double* q) const { return element_nodes<D>(q, element_); }

  const CurrentBeam<D>& beam_;
  int element_;
  bool held_;
  double end_;
  RiderElement curve_;
  RiderMass<D> mass_;
};

extern template class RidingMass<2>;
extern template class RidingMass<3>;

/// The mass that rides on a beam, or null.
template <int D>
const RidingMass<D>* rider_of(const CurrentBeam<D>& beam) {
  return dynamic_cast<const RidingMass<D>*>(beam.loose());
}

}  // namespace vlbeam
