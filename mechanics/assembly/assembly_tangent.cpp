// The tangent of an assembly: the members' own factors, and a dense system of what links add.
#include <algorithm>

#include "mechanics/assembly/assembly_equations.hpp"
#include "mechanics/assembly/spring_now.hpp"

namespace vlbeam {

template <int D>
bool AssemblyEquations<D>::linearize(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                                     double t, const TangentWeights& by) {
  refresh();
  link_forces(q, v, a, forces_);
  hand_out(forces_);
  const Eigen::VectorXd &h = h_, &rate = rate_;
  scale_ = by.a * unit_;
  std::vector<Eigen::Triplet<double>> slopes, bends;
  const auto add = [](std::vector<Eigen::Triplet<double>>& entries, Eigen::Index first_row, Eigen::Index first_column,
                      const auto& block) {
    for (Eigen::Index i = 0; i < block.rows(); ++i) {
      for (Eigen::Index j = 0; j < block.cols(); ++j) {
        if (block(i, j) != 0) entries.emplace_back(first_row + i, first_column + j, block(i, j));
      }
    }
  };
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < system_.links().size(); ++k) {
    const Link<D>& link = system_.links()[k];
    const auto at = static_cast<Eigen::Index>(D * system_.first_end(k));
    const LinkVector held = part_of(h, k);
    for (const LinkCondition& condition : link.conditions) {
      const double force = by.q * unit_ * a[all_ - conditions_ + row];
      add(slopes, row++, at, condition.slope(held).transpose());
      if (condition.curvature.size() > 0) add(bends, at, at, LinkMatrix(force * condition.curvature));
    }
    if (!link.spring) continue;
    const SpringNow<D> now(*link.spring, held, part_of(rate, k));
    if (!now.bears || now.length == 0) continue;
    using Matrix = Eigen::Matrix<double, D, D>;
    const Matrix along = now.along * now.along.transpose(), across = (Matrix::Identity() - along) / now.length;
    const Vec<double, D> moving =
        rate.template segment<D>(at + D) - rate.template segment<D>(at);  // turns what it damps along
    const Matrix own = (by.q * link.spring->stiffness + by.v * link.spring->damping) * along +
                       by.q * (now.tension * across + link.spring->damping * now.along * (across * moving).transpose());
    for (const Eigen::Index i : {0, D}) {
      for (const Eigen::Index j : {0, D}) add(bends, at + i, at + j, Matrix((i == j ? 1 : -1) * own));
    }
  }
  gradients_.resize(conditions_, h.size());
  gradients_.setFromTriplets(slopes.begin(), slopes.end());
  curvature_.resize(h.size(), h.size());
  curvature_.setFromTriplets(bends.begin(), bends.end());
  bent_.clear();
  for (Eigen::Index j = 0; j < curvature_.cols(); ++j) {
    if (curvature_.col(j).nonZeros() > 0) bent_.push_back(j);
  }
  Eigen::MatrixXd yielding = Eigen::MatrixXd::Zero(h.size(), h.size());  // F
  for (View& view : views_) {
    gather(view, q, view.q);
    gather(view, v, view.v);
    gather(view, a, view.a);
    if (!view.equations->linearize(view.q, view.v, view.a, t, by)) return false;
    const auto count = static_cast<Eigen::Index>(D * view.handles.size());
    view.columns.resize(view.own + view.multipliers, count);
    Eigen::Index column = 0;
    for (const std::size_t of : view.handles) {
      for (int c = 0; c < D; ++c, ++column) {
        view.r.setZero(view.own + view.multipliers);
        system_.handles()[of].add_force(Vec<double, D>::Unit(c), view.r.data());
        view.equations->solve(view.r);
        view.columns.col(column) = view.r;
        for (const std::size_t i : view.handles) {
          yielding.template block<D, 1>(static_cast<Eigen::Index>(D * i),
                                        static_cast<Eigen::Index>(D * of + static_cast<std::size_t>(c))) =
              system_.handles()[i].rate(view.r.data());
        }
      }
    }
  }
  const auto bent = static_cast<Eigen::Index>(bent_.size()), size = bent + conditions_;
  if (size == 0) return true;
  const Eigen::MatrixXd by_force = yielding * gradients_.transpose();  // F G^T
  const Eigen::MatrixXd schur = gradients_ * by_force;
  force_size_ = conditions_ > 0 ? 1 / std::max(schur.diagonal().cwiseAbs().maxCoeff(), 1e-300) : 1;
  Eigen::MatrixXd whole(size, size);
  Eigen::MatrixXd by_bent(h.size(), bent);  // F L, of the t that L acts on
  for (Eigen::Index j = 0; j < bent; ++j) {
    by_bent.col(j).setZero();
    for (Eigen::SparseMatrix<double>::InnerIterator entry(curvature_, bent_[static_cast<std::size_t>(j)]); entry;
         ++entry) {
      by_bent.col(j) += entry.value() * yielding.col(entry.row());
    }
  }
  for (Eigen::Index i = 0; i < bent; ++i) {
    const Eigen::Index at = bent_[static_cast<std::size_t>(i)];
    whole.row(i).head(bent) = by_bent.row(at);
    whole(i, i) += 1;
    whole.row(i).tail(conditions_) = force_size_ * by_force.row(at);
  }
  whole.bottomLeftCorner(conditions_, bent) = -(gradients_ * by_bent);
  whole.bottomRightCorner(conditions_, conditions_) = -force_size_ * schur;
  dependent_ = !system_.redundant.empty();
  if (dependent_) {
    careful_factors_.compute(whole);
    careful_factors_.setThreshold(redundant_share);
  } else {
    factors_.compute(whole);
  }
  return true;
}

template <int D>
void AssemblyEquations<D>::solve(Eigen::VectorXd& r) const {
  Eigen::VectorXd& touched = touched_;
  touched.setZero(static_cast<Eigen::Index>(D * system_.handles().size()));
  for (const View& view : views_) {
    gather(view, r, view.r);
    view.equations->solve(view.r);
    for (const std::size_t i : view.handles) {
      touched.template segment<D>(static_cast<Eigen::Index>(D * i)) = system_.handles()[i].rate(view.r.data());
    }
  }
  const auto bent = static_cast<Eigen::Index>(bent_.size()), size = bent + conditions_;
  Eigen::VectorXd& pull = pull_;
  pull.setZero(touched.size());
  if (size > 0) {
    Eigen::VectorXd& right = right_;
    right.resize(size);
    for (Eigen::Index i = 0; i < bent; ++i) right[i] = touched[bent_[static_cast<std::size_t>(i)]];
    right.tail(conditions_) = r.tail(conditions_);
    for (Eigen::Index j = 0; j < gradients_.cols(); ++j) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(gradients_, j); entry; ++entry) {
        right[bent + entry.row()] -= entry.value() * touched[j];
      }
    }
    if (dependent_) {
      right = careful_factors_.solve(right).eval();
    } else {
      right = factors_.permutationP() * right;
      factors_.matrixLU().template triangularView<Eigen::UnitLower>().solveInPlace(right);
      factors_.matrixLU().template triangularView<Eigen::Upper>().solveInPlace(right);
    }
    const Eigen::VectorXd& answer = right;
    for (Eigen::Index i = 0; i < bent; ++i) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(curvature_, bent_[static_cast<std::size_t>(i)]); entry;
           ++entry) {
        pull[entry.row()] += answer[i] * entry.value();
      }
    }
    eta_ = force_size_ * answer.tail(conditions_);
    for (Eigen::Index j = 0; j < gradients_.cols(); ++j) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(gradients_, j); entry; ++entry) {
        pull[j] += entry.value() * eta_[entry.row()];
      }
    }
    r.tail(conditions_) = eta_ / scale_;
  }
  for (const View& view : views_) {
    Eigen::Index column = 0;
    for (const std::size_t i : view.handles) {
      view.r.noalias() -=
          view.columns.template middleCols<D>(column) * pull.template segment<D>(static_cast<Eigen::Index>(D * i));
      column += D;
    }
    scatter(view, view.r, r);
  }
}

template bool AssemblyEquations<2>::linearize(const Eigen::VectorXd&, const Eigen::VectorXd&, const Eigen::VectorXd&,
                                              double, const TangentWeights&);
template void AssemblyEquations<2>::solve(Eigen::VectorXd&) const;
template bool AssemblyEquations<3>::linearize(const Eigen::VectorXd&, const Eigen::VectorXd&, const Eigen::VectorXd&,
                                              double, const TangentWeights&);
template void AssemblyEquations<3>::solve(Eigen::VectorXd&) const;

}  // namespace vlbeam
