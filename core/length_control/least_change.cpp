#include "core/length_control/least_change.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "core/element/active.hpp"
#include "core/element/quadrature.hpp"
#include "core/geometry/arc.hpp"
#include "core/geometry/elementary.hpp"
#include "core/geometry/rotation.hpp"
#include "core/length_control/chain_motion.hpp"

namespace vlbeam {
namespace {

constexpr int points_a_piece = 10;
constexpr int most_iterations = 40;
constexpr double converged = 1e-9;               // of slopes and logarithms of weights
constexpr double longest_step = 0.3;             // of the same, in one iteration
constexpr double prices[] = {1, 1e2, 1e4, 1e6};  // of a change of strain energy
constexpr double gauge = 0.03;                   // c, how much weights cost that change nothing
constexpr double least_curvature = 1e-10;        // over the element's length
constexpr double least_bending = 1e-3;           // of EA l^2, in K

/// The search for slopes and weights of one merged element.
template <int D>
class Search {
 public:
  static constexpr int N = 2 * D + 4;  // two slopes, four logarithms of weights
  static constexpr std::size_t first_weight = N - 4;
  using Real = Active<N>;
  using Unknowns = Eigen::Matrix<double, N, 1>;
  using Square = Eigen::Matrix<double, N, N>;

  Search(const ChainState<D>& chain, const ChainState<D>& before, int merged, bool rational, const MovingLaw<D>& law)
      : chain_(chain), merged_(merged), law_(law) {
    free_.setOnes();
    if (merged == 0 || held(merged)) free_.template head<D>().setZero();
    if (merged + 1 == chain.mesh.last() || held(merged + 1)) free_.template segment<D>(D).setZero();
    if (!rational) free_.template tail<4>().setZero();
    const int first = std::max(0, merged - 1), last = std::min(chain.mesh.elements(), merged + 2);
    const auto& x = chain.mesh.x;
    length_ = x[static_cast<std::size_t>(merged) + 1] - x[static_cast<std::size_t>(merged)];
    if (D == 3) regularization_ = least_curvature / length_;
    const auto& k = law.section.stiffness;
    scale_ = std::max(k.EI, least_bending * k.EA * length_ * length_);
    const auto pieces =
        common_pieces(before.mesh, chain.mesh, x[static_cast<std::size_t>(first)], x[static_cast<std::size_t>(last)]);
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
      const double a = pieces[i], size = pieces[i + 1] - a;
      const int from = before.mesh.element_at(a + size / 2), to = chain.mesh.element_at(a + size / 2);
      for (const auto& [u, weight] : gauss_legendre(points_a_piece)) {
        const double at = a + u * size;
        points_.push_back(
            {at, weight * size, to, motion_at(before, from, at, law.transport), {}, Vec<double, D>::Zero()});
        if (before.curved_at_rest()) {
          Point& point = points_.back();
          const auto rest = before.rest_nodes(from);
          point.old_rest =
              rest_strain<D>(combine_nodes(point.old.s_x, rest), combine_nodes(point.old.s_xx, rest), law.section);
          point.old_rest_r = combine_nodes(point.old.s, rest);
        }
      }
    }
    if (chain.curved_at_rest()) {
      rotate_rest();
      if (rational) {
        const auto rest = chain.rest_nodes(merged);
        base_ = even_arc_weights<D>(rest.s_a, rest.s_b);
      }
    }
  }

  /// Weights where all unknowns are zero.
  const Weights<double>& base() const { return base_; }

  /// The unknowns of the nearest shape that keeps the strain energy; of that which keeps it best where none does.
  Unknowns operator()() {
    Unknowns p = Unknowns::Zero();
    if (newton(p)) return p;
    // from far away: the condition as a growing price, then once more exactly
    p.setZero();
    for (const double price : prices) descend(p, price);
    Unknowns exact = p;
    return newton(exact) && (exact - p).cwiseAbs().maxCoeff() < longest_step ? exact : p;
  }

 private:
  struct Point {
    double x, weight;
    int element;
    PointMotion<double, D> old;
    RestStrain<double> old_rest;
    Vec<double, D> old_rest_r;
  };

  /// What the merge changes of the rest shape itself, turned as the beam is, is no change of the beam.
  void rotate_rest() {
    const auto count = static_cast<Eigen::Index>(points_.size());
    Eigen::MatrixXd rest(D, count), now(D, count);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      rest.col(static_cast<Eigen::Index>(i)) = points_[i].old_rest_r;
      now.col(static_cast<Eigen::Index>(i)) = points_[i].old.r;
    }
    rotation_ = best_rotation<D>(rest, now);
    for (Point& point : points_) point.old_rest_r = rotation_ * point.old_rest_r;
  }

  /// Newton's iteration for the nearest shape under the condition that the strain energy stays; false where it does not
  /// converge.
  bool newton(Unknowns& p) {
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      evaluate(p);
      Eigen::Matrix<double, N + 1, N + 1> kkt = Eigen::Matrix<double, N + 1, N + 1>::Zero();
      kkt.template topLeftCorner<N, N>() = hessian_;
      kkt.template topRightCorner<N, 1>() = energy_gradient_;
      kkt.template bottomLeftCorner<1, N>() = energy_gradient_.transpose();
      Eigen::Matrix<double, N + 1, 1> rhs;
      rhs << -gradient_, -energy_;
      for (int i = 0; i < N; ++i) {
        if (free_[i] != 0) continue;
        kkt.row(i).setZero();
        kkt.col(i).setZero();
        kkt(i, i) = 1;
        rhs[i] = 0;
      }
      const Unknowns step = kkt.fullPivLu().solve(rhs).template head<N>();
      const double size = step.cwiseAbs().maxCoeff();
      if (!std::isfinite(size)) return false;
      p += std::min(1.0, longest_step / size) * step;
      if (size < converged) return true;
    }
    return false;
  }

  /// Levenberg and Marquardt's descent of the distance plus `price` times the square of the change of strain energy
  /// over the energy there was.
  void descend(Unknowns& p, double price) {
    const double scale = price / old_energy_;
    auto objective = [&] { return distance_ + 0.5 * scale * energy_ * energy_; };
    evaluate(p);
    double best = objective(), damping = 1e-3;
    for (int iteration = 0; iteration < most_iterations && damping < 1e8; ++iteration) {
      Square matrix = hessian_ + scale * energy_gradient_ * energy_gradient_.transpose();
      matrix.diagonal() *= 1 + damping;
      Unknowns rhs = -gradient_ - scale * energy_ * energy_gradient_;
      for (int i = 0; i < N; ++i) {
        if (free_[i] != 0) continue;
        matrix.row(i).setZero();
        matrix.col(i).setZero();
        matrix(i, i) = 1;
        rhs[i] = 0;
      }
      const Unknowns step = matrix.ldlt().solve(rhs), tried = p + step;
      evaluate(tried);
      if (std::isfinite(objective()) && objective() < best) {
        best = objective();
        p = tried;
        damping *= 0.2;
        if (step.cwiseAbs().maxCoeff() < converged) return;
      } else {
        damping *= 5;
        evaluate(p);
      }
    }
  }

  /// Where the beam may be kinked at the joint its slopes there obey conditions of their own.
  bool held(int node) const {
    const auto* joint = chain_.joint_at(node);
    return joint != nullptr && joint->kink;
  }

  /// Gauss-Newton's sums of the distance, and the change of strain energy with its gradient.
  void evaluate(const Unknowns& p) {
    hessian_.setZero();
    gradient_.setZero();
    distance_ = 0;
    old_energy_ = std::numeric_limits<double>::min();
    auto add = [&](const Real& residual) {
      distance_ += 0.5 * residual.value() * residual.value();
      hessian_ += residual.derivatives() * residual.derivatives().transpose();
      gradient_ += residual.derivatives() * residual.value();
    };
    Real energy(0.0);
    std::array<Real, N> unknown;
    for (int i = 0; i < N; ++i) unknown[static_cast<std::size_t>(i)] = Real(p[i], i);
    const auto& k = law_.section.stiffness;
    for (const Point& point : points_) {
      const auto now = shape_at(point, unknown);
      const double w = point.weight;
      if (chain_.curved_at_rest()) {
        const StrainGradients<Real, D> strain(now.rest_r_x, now.rest_r_xx, law_.section);
        const RestStress<Real, D> is(now.r_x, now.r_xx, {strain.axial, strain.curvature, {}, {}, {}}, law_.section);
        const RestStress<double, D> was(point.old.r_x, point.old.r_xx, point.old_rest, law_.section);
        energy += (is.axial + is.bending) * w - Real(w * (was.axial + was.bending));
        old_energy_ += w * (was.axial + was.bending);
        add((is.tension - Real(was.tension)) * std::sqrt(w / k.EA));
        if (law_.section.bends()) add((is.moment - Real(was.moment)) * std::sqrt(w / k.EI));
      } else {
        const ElasticStress<Real, D> is(now.r_x, now.r_xx, k);
        const ElasticStress<double, D> was(point.old.r_x, point.old.r_xx, k);
        energy += (is.axial + is.bending) * w - Real(w * (was.axial + was.bending));
        old_energy_ += w * (was.axial + was.bending);
        add((stretch<Real>(now.r_x, k.law) - Real(stretch<double>(point.old.r_x, k.law))) * std::sqrt(w * k.EA));
        if (law_.section.bends()) {
          const Curvature<Real, D> kappa(now.r_x, now.r_xx, k.law, regularization_);
          const Curvature<double, D> old(point.old.r_x, point.old.r_xx, k.law, regularization_);
          add((kappa.value - Real(old.value)) * std::sqrt(w * k.EI));
        }
      }
      for (int c = 0; c < D; ++c) {
        Real change = now.r[c] - Real(point.old.r[c] - point.old_rest_r[c]);
        if (chain_.curved_at_rest()) {
          for (int d = 0; d < D; ++d) change -= now.rest_r[d] * rotation_(c, d);
        }
        add(change * std::sqrt(w * scale_ / portable::pow(length_, 4)));
      }
    }
    for (std::size_t i = first_weight; i < first_weight + 4; ++i) {
      add(unknown[i] * (gauge * std::sqrt(scale_ / length_)));
    }
    energy_ = energy.value();
    energy_gradient_ = energy.derivatives();
  }

  template <class Scalar>
  static Scalar stretch(const Vec<Scalar, D>& rx, StrainLaw law) {
    using std::sqrt;
    const Scalar g = rx.dot(rx);
    return law == StrainLaw::green ? Scalar((g - Scalar(1)) * 0.5) : Scalar(sqrt(g) - Scalar(1));
  }

  struct Shape {
    Vec<Real, D> r, r_x, r_xx;
    Vec<Real, D> rest_r, rest_r_x, rest_r_xx;  ///< where nothing stresses the beam, if it is curved then
  };

  Shape shape_at(const Point& point, const std::array<Real, N>& unknown) const {
    const auto q = chain_.coordinates(point.element);
    const double l = q.x_b - q.x_a, u = (point.x - q.x_a) / l;
    auto constant = [](const Vec<double, D>& value) {
      Vec<Real, D> result;
      for (int c = 0; c < D; ++c) result[c] = Real(value[c]);
      return result;
    };
    Vec<Real, D> s_a = constant(q.e.s_a), s_b = constant(q.e.s_b);
    auto move = [&](Vec<Real, D>& slope, std::size_t first) {
      for (int c = 0; c < D; ++c) slope[c] += unknown[first + static_cast<std::size_t>(c)];
    };
    ShapeTable<Real> f;
    if (point.element == merged_) {
      move(s_a, 0);
      move(s_b, D);
      using portable::exp;
      Weights<Real> w;
      for (std::size_t i = 0; i < 4; ++i) w[i] = exp(unknown[first_weight + i]) * base_[i];
      f = rational_shape(w, Real(u));
    } else {
      if (point.element == merged_ - 1) move(s_b, 0);
      if (point.element == merged_ + 1) move(s_a, D);
      const auto table = rational_shape(current_weights(chain_, point.element, law_.transport), u);
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t n = 0; n < 4; ++n) f[i][n] = Real(table[i][n]);
      }
    }
    using Nodes = NodalCubic<Real, D>;
    auto derivative = [&](const Nodes& e, std::size_t n, double scale) -> Vec<Real, D> {
      Vec<Real, D> sum;
      for (int c = 0; c < D; ++c) {
        sum[c] = (e.r_a[c] * f[0][n] + e.r_b[c] * f[2][n] + (e.s_a[c] * f[1][n] + e.s_b[c] * f[3][n]) * l) * scale;
      }
      return sum;
    };
    const Nodes e{constant(q.e.r_a), s_a, constant(q.e.r_b), s_b};
    Shape shape{derivative(e, 0, 1), derivative(e, 1, 1 / l), derivative(e, 2, 1 / (l * l)), {}, {}, {}};
    if (chain_.curved_at_rest()) {
      const auto rest = chain_.rest_nodes(point.element);
      const Nodes e0{constant(rest.r_a), constant(rest.s_a), constant(rest.r_b), constant(rest.s_b)};
      shape.rest_r = derivative(e0, 0, 1);
      shape.rest_r_x = derivative(e0, 1, 1 / l);
      shape.rest_r_xx = derivative(e0, 2, 1 / (l * l));
    }
    return shape;
  }

  const ChainState<D>& chain_;
  int merged_;
  const MovingLaw<D>& law_;
  double length_ = 0, scale_ = 0;
  Weights<double> base_ = unit_weights;
  Eigen::Matrix<double, D, D> rotation_;  // of the rest shape to where the beam is
  double regularization_ = 0;             // [1/m], keeps kappa differentiable in space where it is zero
  std::vector<Point> points_;
  Unknowns free_, gradient_, energy_gradient_;
  Square hessian_;
  double energy_ = 0, distance_ = 0, old_energy_ = 0;
};

}  // namespace

template <int D>
MergedWeights least_change(ChainState<D>& chain, const ChainState<D>& before, int merged, bool rational,
                           const MovingLaw<D>& law) {
  const auto i = static_cast<std::size_t>(merged);
  MergedWeights weights;
  chain.mesh.weights[i] = {unit_weights, chain.mesh.x[i], chain.mesh.x[i + 1]};
  Search<D> search(chain, before, merged, rational, law);
  const typename Search<D>::Unknowns p = search();
  slope<D>(chain.q.data(), merged) += p.template head<D>();
  slope<D>(chain.q.data(), merged + 1) += p.template segment<D>(D);
  for (std::size_t k = 0; k < 3; ++k) {
    weights.k[k] = portable::exp(p[2 * D + static_cast<int>(k)] - p[2 * D + 3]) * search.base()[k];  // base()[3] is 1
  }
  chain.mesh.weights[i].w = weights.weights();
  return weights;
}

template MergedWeights least_change(ChainState<2>&, const ChainState<2>&, int, bool, const MovingLaw<2>&);
template MergedWeights least_change(ChainState<3>&, const ChainState<3>&, int, bool, const MovingLaw<3>&);

}  // namespace vlbeam
