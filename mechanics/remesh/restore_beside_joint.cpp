#include "mechanics/remesh/restore_beside_joint.hpp"

#include <cmath>

#include "core/geometry/dense.hpp"

namespace vlbeam {
namespace {

/// Coordinates of a part of a beam with one joint: of its nodes, then the slope behind the joint and the mark.
template <int D>
class PartCoordinates {
 public:
  PartCoordinates(const CurrentBeam<D>& beam, const BeamMass<D>& mass, const BeamPart& part, const Eigen::VectorXd& y,
                  double t)
      : beam_(beam),
        mass_(mass),
        part_(part),
        elements_(beam.masses_at(y, t)),
        q_(y.data()),
        joint_(beam.places().front()),
        first_(part.before),
        nodes_(beam.mesh().last() - part.behind - part.before + 1),
        full_(beam.coordinates()),
        times_mass_(beam.coordinates()) {}

  Eigen::Index size() const { return node_size<D> * nodes_ + (joint_.behind >= 0 ? D : 0) + 1; }

  Eigen::VectorXd read(const double* all) const {
    Eigen::VectorXd some(size());
    exchange(all, some, [](double from, double& to) { to = from; });
    return some;
  }
  void write(const Eigen::VectorXd& some, double* all) const {
    exchange(all, some, [](double& to, double from) { to = from; });
  }

  /// M v; of the end nodes without the elements beyond.
  Eigen::VectorXd momentum(const Eigen::VectorXd& v) const {
    write(v, full_.data());
    mass_.multiply(elements_, q_, full_.data(), times_mass_.data(), part_);
    return read(times_mass_.data());
  }

  /// Rates of the rigid motions: translations, then rotations about the joint.
  Eigen::MatrixXd rigid() const {
    Eigen::MatrixXd rates = Eigen::MatrixXd::Zero(size(), VelocityProjection<D>::rigid_modes);
    const Vec<double, D> centre = position<D>(q_, joint_.node);
    const auto turn = [&](Eigen::Index row, const Vec<double, D>& vector) {
      for (int mode = D; mode < rates.cols(); ++mode) {
        const auto [a, b] = VelocityProjection<D>::axes_of(mode);
        rates(row + a, mode) = -vector[b];
        rates(row + b, mode) = vector[a];
      }
    };
    for (int k = 0; k < nodes_; ++k) {
      const Eigen::Index row = Eigen::Index{node_size<D>} * k;
      rates.template block<D, D>(row, 0).setIdentity();
      turn(row, position<D>(q_, first_ + k) - centre);
      turn(row + D, slope<D>(q_, first_ + k));
    }
    if (joint_.behind >= 0) turn(node_size<D> * nodes_, Eigen::Map<const Vec<double, D>>(q_ + joint_.behind));
    return rates;
  }
  /// What is a momentum about the origin becomes one about the joint.
  Eigen::VectorXd about_joint(Eigen::VectorXd momenta) const {
    const Vec<double, D> centre = position<D>(q_, joint_.node);
    for (int mode = D; mode < momenta.size(); ++mode) {
      const auto [a, b] = VelocityProjection<D>::axes_of(mode);
      momenta[mode] -= centre[a] * momenta[b] - centre[b] * momenta[a];
    }
    return momenta;
  }

  /// Between its end nodes, along the beam [m].
  double length() const {
    const auto& x = beam_.mesh().x;
    return x[static_cast<std::size_t>(first_ + nodes_ - 1)] - x[static_cast<std::size_t>(first_)];
  }

  /// 1 at the joint, and what is tied to it, falling to 0 at the end nodes.
  Eigen::VectorXd weights() const {
    Eigen::VectorXd all = Eigen::VectorXd::Ones(size());
    const int middle = joint_.node - first_;
    for (int k = 0; k < nodes_; ++k) {
      const double from = k < middle ? static_cast<double>(middle - k) / middle
                                     : static_cast<double>(k - middle) / (nodes_ - 1 - middle);
      all.segment<node_size<D>>(Eigen::Index{node_size<D>} * k).setConstant(1 - from * from);
    }
    return all;
  }

 private:
  template <class All, class Some, class Take>
  void exchange(All* all, Some& some, const Take& take) const {
    const Eigen::Index count = Eigen::Index{node_size<D>} * nodes_;
    All* const node = all + Eigen::Index{node_size<D>} * first_;
    for (Eigen::Index i = 0; i < count; ++i) take(node[i], some[i]);
    Eigen::Index next = count;
    if (joint_.behind >= 0) {
      for (int i = 0; i < D; ++i) take(all[joint_.behind + i], some[next++]);
    }
    take(all[joint_.mark], some[next]);
  }

  const CurrentBeam<D>& beam_;
  const BeamMass<D>& mass_;
  BeamPart part_;
  typename CurrentBeam<D>::JointElements elements_;
  const double* q_;
  JointPlace joint_;
  int first_, nodes_;
  mutable Eigen::VectorXd full_, times_mass_;  ///< like q', of which the part is used
};

}  // namespace

template <int D>
void restore_beside_joint(const CurrentBeam<D>& beam, const BeamMass<D>& mass, const BeamPart& part,
                          const Eigen::VectorXd& lacking, const typename VelocityProjection<D>::EnergyGained& gained,
                          Eigen::VectorXd& y, double t) {
  const PartCoordinates<D> coordinates(beam, mass, part, y, t);
  double* const rates = y.data() + beam.coordinates();
  const Eigen::VectorXd weights = coordinates.weights();
  const Eigen::MatrixXd rigid = coordinates.rigid();
  Eigen::MatrixXd momentum_of(rigid.rows(), rigid.cols());  // of the weighted rigid motions
  for (Eigen::Index mode = 0; mode < rigid.cols(); ++mode) {
    momentum_of.col(mode) = coordinates.momentum(weights.cwiseProduct(rigid.col(mode)));
  }
  // turning has another unit: pivots, and with them the rounding, must not depend on it
  Eigen::VectorXd unit = Eigen::VectorXd::Ones(rigid.cols());
  unit.tail(rigid.cols() - D).setConstant(std::ldexp(1.0, -std::ilogb(coordinates.length())));
  const Eigen::MatrixXd metric = unit.asDiagonal() * (rigid.transpose() * momentum_of) * unit.asDiagonal();
  const auto rates_of = [&](const Eigen::VectorXd& momenta) -> Eigen::VectorXd {
    return rigid * unit.cwiseProduct(solve_pivoting(metric, unit.cwiseProduct(momenta)));
  };

  Eigen::VectorXd v = coordinates.read(rates);
  v += weights.cwiseProduct(rates_of(coordinates.about_joint(lacking)));
  coordinates.write(v, rates);

  const Eigen::VectorXd weighted = weights.cwiseProduct(v);
  const Eigen::VectorXd fluctuation =
      weights.cwiseProduct(v - rates_of(rigid.transpose() * coordinates.momentum(weighted)));
  const Eigen::VectorXd of_fluctuation = coordinates.momentum(fluctuation);
  const double half_slope = 0.5 * v.dot(of_fluctuation), curvature = 0.5 * fluctuation.dot(of_fluctuation);
  if (!(curvature > 0)) return;
  // T(v + s w) = T(v) + 2 half_slope s + curvature s^2 must fall by what was gained, or as far as it can
  const double missing = -gained();
  const double root = half_slope * half_slope + curvature * missing;
  const double scaling =
      root > 0 ? missing / (half_slope + std::copysign(std::sqrt(root), half_slope)) : -half_slope / curvature;
  constexpr double largest_scaling = 1;
  v += std::min(std::max(scaling, -largest_scaling), largest_scaling) * fluctuation;
  coordinates.write(v, rates);
}

template <int D>
double kinetic_energy(const CurrentBeam<D>& beam, const BeamMass<D>& mass, const BeamPart& part,
                      const Eigen::VectorXd& y, double t) {
  const PartCoordinates<D> coordinates(beam, mass, part, y, t);
  const Eigen::VectorXd v = coordinates.read(y.data() + beam.coordinates());
  return 0.5 * v.dot(coordinates.momentum(v));
}

template void restore_beside_joint(const CurrentBeam<2>&, const BeamMass<2>&, const BeamPart&, const Eigen::VectorXd&,
                                   const VelocityProjection<2>::EnergyGained&, Eigen::VectorXd&, double);
template void restore_beside_joint(const CurrentBeam<3>&, const BeamMass<3>&, const BeamPart&, const Eigen::VectorXd&,
                                   const VelocityProjection<3>::EnergyGained&, Eigen::VectorXd&, double);
template double kinetic_energy(const CurrentBeam<2>&, const BeamMass<2>&, const BeamPart&, const Eigen::VectorXd&,
                               double);
template double kinetic_energy(const CurrentBeam<3>&, const BeamMass<3>&, const BeamPart&, const Eigen::VectorXd&,
                               double);

}  // namespace vlbeam
