#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "mechanics/motion/parts/part.hpp"
#include "mechanics/motion/system/room.hpp"
#include "mechanics/vehicles/axle.hpp"

namespace vlbeam {

/// What axles do to a beam, and their springs to the masses on them. Heights of sprung masses are unknowns behind those
/// of nodes and joints, counted from where the masses rest on a level road. Work of the wheels is booked as that of
/// loads.
template <int D>
class ActingAxles final : public Part<D> {
 public:
  explicit ActingAxles(Axles<D> axles);

  const Axles<D>& axles() const { return axles_; }
  /// How many masses have springs.
  Eigen::Index sprung() const { return sprung_; }
  /// Where their heights stand in the coordinates.
  void stand_at(Eigen::Index first) const { first_ = first; }
  /// Where that of axle `which` stands, which has a spring.
  Eigen::Index height(std::size_t which) const { return first_ + own_[which]; }

  EnergyBalance add_force(const Motion<D>& motion, double* force) const override;
  void add_tangent(const Motion<D>& motion, const TangentWeights& by, BeamMatrix<D>& tangent) const override;
  /// How high the road is under a wheel, and how fast that changes: of the beam, or beside it.
  std::pair<double, double> road(std::size_t which, const ChainView<D>& beam, double t) const;
  /// With which a wheel pushes the road, without the wheel's inertia [N].
  double push(std::size_t which, const Motion<D>& motion) const;

  /// What couples the height of a sprung mass to the coordinates of an element, as add_tangent() found it last.
  struct Coupling {
    std::size_t axle;
    int element;
    double own;  ///< of the height to itself
    using Vector = Eigen::Matrix<double, point_coordinates<D>, 1>;
    Vector row = Vector::Zero(), column = Vector::Zero();
  };
  const std::vector<Coupling>& couplings() const { return couplings_; }

 private:
  Axles<D> axles_;
  std::vector<Eigen::Index> own_;  ///< which of the heights is that of an axle
  Eigen::Index sprung_ = 0;
  mutable Eigen::Index first_ = 0;
  mutable std::vector<Coupling> couplings_;
};

/// Vehicles on a beam. Its model must have the same ActingAxles among its parts.
template <int D>
class Vehicles final : public Room<D> {
 public:
  explicit Vehicles(std::shared_ptr<const ActingAxles<D>> acting) : acting_(std::move(acting)) {}

  std::unique_ptr<Unknowns<D>> unknowns(const CurrentBeam<D>& beam, const std::vector<double>& x) const override;
  void add_carried(const ChainView<D>& beam, double t, std::vector<BeamLink<D>>& carried) const override;

 private:
  std::shared_ptr<const ActingAxles<D>> acting_;
};

extern template class ActingAxles<2>;
extern template class ActingAxles<3>;
extern template class Vehicles<2>;
extern template class Vehicles<3>;

}  // namespace vlbeam
