#include "core/system/implicit_flow.hpp"

#include <limits>

#include "core/error.hpp"

namespace vlbeam {
namespace {

template <int D>
Eigen::Matrix<double, 4 * D, 4 * D> axis_tangent(StrainLaw strain_law, const MovingCoordinates<double, D>& q,
                                                 const MovingCoordinates<double, D>& rate,
                                                 const MovingCoordinates<double, D>& a, const TangentWeights& by,
                                                 const WeightFunction& weights, const ShapeTabulation& table,
                                                 const MovingLaw<D>& law) {
  auto measured = [&]<StrainLaw Law>() {
    return law.section.bends() ? driven_tangent<Law, true, D>(q, rate, a, by, weights, table, law)
                               : driven_tangent<Law, false, D>(q, rate, a, by, weights, table, law);
  };
  return strain_law == StrainLaw::green ? measured.template operator()<StrainLaw::green>()
                                        : measured.template operator()<StrainLaw::engineering>();
}

/// The spin of one element is linear in its angles: the residual of unit angles, less that of none, is the tangent.
Eigen::Matrix2d spin_tangent(const SpinCoordinates<double>& q, const SpinCoordinates<double>& rate,
                             const SpinCoordinates<double>& a, const TangentWeights& by, Formulation formulation,
                             const SpinSection& section) {
  auto residual = [&](double angle_a, double angle_b) {
    const SpinCoordinates<double> at{by.q * angle_a, by.q * angle_b, q.x_a, q.x_b};
    const SpinCoordinates<double> moving{by.v * angle_a, by.v * angle_b, rate.x_a, rate.x_b};
    const SpinCoordinates<double> speeding{by.a * angle_a, by.a * angle_b, a.x_a, a.x_b};
    const auto r = spin_equations(at, moving, formulation, section).residual(speeding);
    return Eigen::Vector2d(r[0], r[1]);
  };
  Eigen::Matrix2d tangent;
  tangent.col(0) = residual(1, 0);
  tangent.col(1) = residual(0, 1);
  return tangent;
}

}  // namespace

template <int D>
void ImplicitFlow<D>::acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, Eigen::VectorXd& a) {
  y_.setZero(beam_.size());
  dydt_.resize(beam_.size());
  contract(q, v, y_);
  beam_.rhs(y_, dydt_, t);
  a = dydt_.segment(coordinates(), coordinates());
}

template <int D>
double ImplicitFlow<D>::residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                                 Eigen::VectorXd& r) {
  if (!beam_.evaluate(q.data(), v.data(), t)) {
    r.setConstant(std::numeric_limits<double>::quiet_NaN());
    return 0;
  }
  r.setZero();
  beam_.add_residual(a.data(), r.data());
  force_.setZero(coordinates());
  beam_.add_loads(q.data(), t, force_.data());
  beam_.add_inflow(q.data(), v.data(), force_.data());
  r -= force_;
  for (const auto& [node, support] : beam_.model_.supports) {
    auto part = r.segment<B>(Eigen::Index{B} * node);
    part = (kept(node) * part).eval();
  }
  for (const DrivenAngle& angle : beam_.model_.angles) {
    const Eigen::Index k = beam_.first_angle() + angle.node;
    r[k] = a[k] - angle.theta(t).acceleration;
  }
  return beam_.dissipation();
}

template <int D>
typename ImplicitFlow<D>::Block ImplicitFlow<D>::kept(int node) const {
  const auto& free = beam_.free_[static_cast<std::size_t>(node)];
  Block keep = Block::Zero();
  keep.template topLeftCorner<D, D>() = beam_.frame_ * free[0].matrix().asDiagonal() * beam_.frame_.transpose();
  keep.template bottomRightCorner<D, D>() = beam_.frame_ * free[1].matrix().asDiagonal() * beam_.frame_.transpose();
  return keep;
}

template <int D>
void ImplicitFlow<D>::assemble(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                               const TangentWeights& by) {
  beam_.model_.motion.at(t, beam_.nodes_);
  axis_.reset(beam_.nodes());
  const MovingLaw<D> law = beam_.law(t);
  const auto& spin = beam_.model_.spin;
  if (spin) angles_.reset(beam_.nodes());
  for (int k = 0; k < beam_.elements(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const auto axis = axis_tangent<D>(beam_.model_.strain_law, beam_.axis_of(q.data(), k, &Prescribed::value),
                                      beam_.axis_of(v.data(), k, &Prescribed::rate),
                                      beam_.axis_of(a.data(), k, &Prescribed::acceleration), by, beam_.weights(k),
                                      beam_.tables_[i], law);
    axis_.diagonal[i] += axis.template topLeftCorner<B, B>();
    axis_.upper[i] += axis.template topRightCorner<B, B>();
    axis_.lower[i + 1] += axis.template bottomLeftCorner<B, B>();
    axis_.diagonal[i + 1] += axis.template bottomRightCorner<B, B>();
    if (!spin) continue;
    const auto angles =
        spin_tangent(beam_.spin_of(q.data(), k, &Prescribed::value), beam_.spin_of(v.data(), k, &Prescribed::rate),
                     beam_.spin_of(a.data(), k, &Prescribed::acceleration), by, beam_.model_.formulation, *spin);
    angles_.diagonal[i](0) += angles(0, 0);
    angles_.upper[i](0) += angles(0, 1);
    angles_.lower[i + 1](0) += angles(1, 0);
    angles_.diagonal[i + 1](0) += angles(1, 1);
  }
  add_loads(q.data(), t, by);
  if (beam_.model_.formulation == Formulation::variational) add_inflow(by);
}

template <int D>
void ImplicitFlow<D>::add_loads(const double* q, double t, const TangentWeights& by) {
  for (const NodeLoad<D>& load : beam_.model_.loads) {
    if (!load.follower) continue;
    const Vec<double, D> tangent = slope<D>(q, load.node).normalized();
    const double over = by.q * load.follower(t) / slope<D>(q, load.node).norm();
    axis_.diagonal[static_cast<std::size_t>(load.node)].template topRightCorner<D, D>() -=
        over * (Eigen::Matrix<double, D, D>::Identity() - tangent * tangent.transpose());
  }
}

template <int D>
void ImplicitFlow<D>::add_inflow(const TangentWeights& by) {
  for (const int k : {0, beam_.elements()}) {
    const auto i = static_cast<std::size_t>(k);
    const double x_rate = beam_.nodes_[i].rate, in = k == 0 ? -x_rate : x_rate;
    Block& block = axis_.diagonal[i];
    block.template topLeftCorner<D, D>().diagonal().array() -= beam_.model_.section.rhoA * in * by.v;
    block.template topRightCorner<D, D>().diagonal().array() += beam_.model_.section.rhoA * in * x_rate * by.q;
    if (!beam_.model_.spin) continue;
    const double inertia = beam_.model_.spin->rhoIp * in;
    const std::size_t other = k == 0 ? 1 : i - 1;
    // by the twist (theta_i - theta_other)/distance, the distance negative at the start
    const double twist = by.q * inertia * x_rate / (beam_.nodes_[i].value - beam_.nodes_[other].value);
    angles_.diagonal[i](0) += twist - inertia * by.v;
    (k == 0 ? angles_.upper[0] : angles_.lower[i])(0) -= twist;
  }
}

template <int D>
void ImplicitFlow<D>::constrain() {
  const std::size_t last = axis_.diagonal.size() - 1;
  for (const auto& [node, support] : beam_.model_.supports) {
    const Block keep = kept(node);
    const auto k = static_cast<std::size_t>(node);
    const double scale = axis_.diagonal[k].diagonal().cwiseAbs().maxCoeff();
    axis_.diagonal[k] = keep * axis_.diagonal[k] * keep + scale * (Block::Identity() - keep);
    if (k > 0) {
      axis_.lower[k] = keep * axis_.lower[k];
      axis_.upper[k - 1] = axis_.upper[k - 1] * keep;
    }
    if (k < last) {
      axis_.upper[k] = keep * axis_.upper[k];
      axis_.lower[k + 1] = axis_.lower[k + 1] * keep;
    }
  }
}

template <int D>
bool ImplicitFlow<D>::linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                                double by_v, double by_a) {
  assemble(q, v, a, t, {1, by_v, by_a});
  constrain();
  if (!axis_.factor()) return false;
  if (!beam_.model_.spin) return true;
  for (const DrivenAngle& angle : beam_.model_.angles) {
    const auto k = static_cast<std::size_t>(angle.node);
    angles_.diagonal[k](0) = by_a == 0 ? 1 : by_a;
    angles_.upper[k](0) = angles_.lower[k](0) = 0;
  }
  return angles_.factor();
}

template <int D>
void ImplicitFlow<D>::solve(Eigen::VectorXd& r) const {
  axis_.solve(r.data());
  if (beam_.model_.spin) angles_.solve(r.data() + beam_.first_angle());
}

template <int D>
typename ImplicitFlow<D>::Tangent ImplicitFlow<D>::tangent(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                           const Eigen::VectorXd& a, double t,
                                                           const TangentWeights& by) {
  assemble(q, v, a, t, by);
  auto reduced = [](const auto& band, int block, const Eigen::MatrixXd& basis) -> Eigen::MatrixXd {
    Eigen::MatrixXd full =
        Eigen::MatrixXd::Zero(Eigen::Index{block} * band.nodes(), Eigen::Index{block} * band.nodes());
    band.expand(full);
    return basis.transpose() * full * basis;
  };
  Tangent result;
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(beam_.first_angle(), beam_.first_angle());
  Eigen::Index columns = 0;
  for (int k = 0; k < beam_.nodes(); ++k) {
    for (std::size_t part = 0; part < 2; ++part) {
      for (int c = 0; c < D; ++c) {
        if (beam_.free_[static_cast<std::size_t>(k)][part][c] == 0) continue;
        basis.col(columns++).segment<D>(Eigen::Index{B} * k + static_cast<Eigen::Index>(part) * D) =
            beam_.frame_.col(c);
      }
    }
  }
  result.axis = reduced(axis_, B, basis.leftCols(columns));
  if (!beam_.model_.spin) return result;
  std::vector<bool> driven(static_cast<std::size_t>(beam_.nodes()), false);
  for (const DrivenAngle& angle : beam_.model_.angles) driven[static_cast<std::size_t>(angle.node)] = true;
  basis.setZero(beam_.nodes(), beam_.nodes());
  columns = 0;
  for (int k = 0; k < beam_.nodes(); ++k) {
    if (!driven[static_cast<std::size_t>(k)]) basis(k, columns++) = 1;
  }
  result.angles = reduced(angles_, 1, basis.leftCols(columns));
  return result;
}

template <int D>
void ImplicitFlow<D>::jacobian(const Eigen::VectorXd& y, double t, Eigen::MatrixXd& dfdy, Eigen::VectorXd& dfdt) {
  beam_.jacobian(y, t, dfdy, dfdt);
}

template <int D>
double ImplicitFlow<D>::conserving_residual(const Eigen::VectorXd& /*q0*/, const Eigen::VectorXd& /*v0*/,
                                            const Eigen::VectorXd& /*q1*/, const Eigen::VectorXd& /*v1*/, double /*t*/,
                                            double /*h*/, Eigen::VectorXd& /*r*/) {
  throw InvalidInput("/integrator/type", "\"energy-momentum\"",
                     "a beam whose nodes are prescribed takes any explicit method or \"generalized-alpha\"");
}

template class ImplicitFlow<2>;
template class ImplicitFlow<3>;

}  // namespace vlbeam
