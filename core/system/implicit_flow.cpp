#include "core/system/implicit_flow.hpp"

#include <limits>

#include "core/error.hpp"

namespace vlbeam {
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
  beam_.model_.loads.add_forces(beam_.view(q.data(), v.data()), t, force_.data());
  beam_.add_inflow(q.data(), v.data(), force_.data());
  r -= force_;
  for (const auto& [node, support] : beam_.model_.supports) {
    auto part = r.segment<B>(Eigen::Index{B} * node);
    part = (kept(node) * part).eval();
  }
  double dissipation = beam_.dissipation();
  if (auto& spin = beam_.spin_) {
    const Eigen::Index at = beam_.angle(0);
    dissipation += spin->residual(q.data() + at, v.data() + at, a.data() + at, t, r.data() + at);
    spin->drive(a.data() + at, t, r.data() + at);
  }
  return dissipation;
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
  MovingLaw<D> law = beam_.law(t);
  if (auto& spin = beam_.spin_) {
    spin->move(beam_.nodes_);
    spin->assemble(by, angles_);
  }
  for (int k = 0; k < beam_.elements(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const auto rest = beam_.rest_of(k);
    law.rest = rest ? &*rest : nullptr;
    auto axis = driven_tangent<D>(
        beam_.axis_of(q.data(), k, &Prescribed::value), beam_.axis_of(v.data(), k, &Prescribed::rate),
        beam_.axis_of(a.data(), k, &Prescribed::acceleration), by, beam_.weights(k), beam_.tables_[i], law);
    const auto& nodes = beam_.nodes_;
    if (const auto& rotary = beam_.model_.rotary; rotary.present()) {
      axis += RotaryElement(nodes[i], nodes[i + 1], beam_.tables_[i]).tangent(rotary, by);
    }
    axis_.diagonal[i] += axis.template topLeftCorner<B, B>();
    axis_.upper[i] += axis.template topRightCorner<B, B>();
    axis_.lower[i + 1] += axis.template bottomLeftCorner<B, B>();
    axis_.diagonal[i + 1] += axis.template bottomRightCorner<B, B>();
  }
  const ChainView<D> beam = beam_.view(q.data(), v.data());
  beam_.model_.loads.add_tangent(beam, t, [&](int k, const typename Loads<D>::ElementMatrix& matrix) {
    const auto i = static_cast<std::size_t>(k);
    axis_.diagonal[i] += by.q * matrix.template block<B, B>(0, 0);
    axis_.upper[i] += by.q * matrix.template block<B, B>(0, B);
    axis_.lower[i + 1] += by.q * matrix.template block<B, B>(B, 0);
    axis_.diagonal[i + 1] += by.q * matrix.template block<B, B>(B, B);
  });
  if (beam_.model_.formulation == Formulation::variational) add_inflow(by);
}

template <int D>
void ImplicitFlow<D>::add_inflow(const TangentWeights& by) {
  for (const int k : {0, beam_.elements()}) {
    const auto i = static_cast<std::size_t>(k);
    const double x_rate = beam_.nodes_[i].rate, in = k == 0 ? -x_rate : x_rate;
    Block& block = axis_.diagonal[i];
    block.template topLeftCorner<D, D>().diagonal().array() -= beam_.model_.section.rhoA * in * by.v;
    block.template topRightCorner<D, D>().diagonal().array() += beam_.model_.section.rhoA * in * x_rate * by.q;
    if (beam_.model_.rotary.present()) add_rotary_inflow(k, in, by);
  }
}

template <int D>
void ImplicitFlow<D>::add_rotary_inflow(int k, double in, const TangentWeights& by) {
  const auto& rotary = beam_.model_.rotary;
  const auto element = static_cast<std::size_t>(k == 0 ? 0 : k - 1);
  const double u = k == 0 ? 0 : 1;
  const RotaryPoint at(beam_.nodes_[element], beam_.nodes_[element + 1], u, 1,
                       rational_shape(beam_.weights(static_cast<int>(element)).w, u));
  for (int j = 0; j < 4; ++j) {
    Block& block = j < 2 ? (k == 0 ? axis_.diagonal[0] : axis_.lower[element + 1])
                         : (k == 0 ? axis_.upper[0] : axis_.diagonal[element + 1]);
    auto part = block.template block<D, D>(D, D * (j % 2));
    for (int c = 0; c < D; ++c) {
      part.col(c) -= in * rotary.rhoJ * (by.v * at.s[j] + by.q * at.g[j]) * rotary.across(Vec<double, D>::Unit(c));
      part.col(c) += in * 0.5 * rotary.gyroscopic * by.q * at.s[j] * rotary.turned(Vec<double, D>::Unit(c));
    }
  }
}

template <int D>
void ImplicitFlow<D>::constrain() {
  const std::size_t last = axis_.diagonal.size() - 1;
  for (const auto& [node, support] : beam_.model_.supports) {
    const Block keep = kept(node);
    const auto k = static_cast<std::size_t>(node);
    NodeVector size;  // of what is fixed: slopes have another unit
    size.template head<D>().setConstant(axis_.diagonal[k].diagonal().template head<D>().cwiseAbs().maxCoeff());
    size.template tail<D>().setConstant(axis_.diagonal[k].diagonal().template tail<D>().cwiseAbs().maxCoeff());
    axis_.diagonal[k] = keep * axis_.diagonal[k] * keep + size.asDiagonal() * (Block::Identity() - keep);
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
  if (!beam_.spin_) return true;
  return beam_.spin_->factor(by_a, angles_);
}

template <int D>
void ImplicitFlow<D>::solve(Eigen::VectorXd& r) const {
  axis_.solve(r.data());
  if (beam_.spin_) angles_.solve(r.data() + beam_.angle(0));
}

template <int D>
typename ImplicitFlow<D>::Tangent ImplicitFlow<D>::free_tangent(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
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
  const Eigen::Index size = Eigen::Index{B} * beam_.nodes();
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(size, size);
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
  if (!beam_.spin_) return result;
  const bool cubic = beam_.spin_->model().field == AngleField::hermite;
  basis.setZero(2 * beam_.nodes(), 2 * beam_.nodes());
  columns = 0;
  for (int k = 0; k < beam_.nodes(); ++k) {
    if (!beam_.spin_->driven(k)) basis(2 * k, columns++) = 1;
    if (cubic) basis(2 * k + 1, columns++) = 1;
  }
  result.angles = reduced(angles_.band, 2, basis.leftCols(columns));
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
