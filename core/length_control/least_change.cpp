#include "core/length_control/least_change.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/AutoDiff>

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
  using Real = Eigen::AutoDiffScalar<Eigen::Matrix<double, N, 1>>;
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
      const int from = element_at(before.mesh, a + size / 2), to = element_at(chain.mesh, a + size / 2);
      for (const auto& [u, weight] : gauss_legendre(points_a_piece)) {
        const double at = a + u * size;
        points_.push_back({at, weight * size, to, motion_at(before, from, at, law.transport)});
      }
    }
  }

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
  };

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
  bool held(int node) const { return chain_.kink && node == chain_.joint; }

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
    Real energy(0, Unknowns::Zero());
    std::array<Real, N> unknown;
    for (int i = 0; i < N; ++i) unknown[static_cast<std::size_t>(i)] = Real(p[i], N, i);
    const auto& k = law_.section.stiffness;
    for (const Point& point : points_) {
      const auto now = shape_at(point, unknown);
      const double w = point.weight;
      const ElasticStress<Real, D> is(now.r_x, now.r_xx, k);
      const ElasticStress<double, D> was(point.old.r_x, point.old.r_xx, k);
      energy += (is.axial + is.bending) * w - Real(w * (was.axial + was.bending), Unknowns::Zero());
      old_energy_ += w * (was.axial + was.bending);
      add((stretch<Real>(now.r_x, k.law) - Real(stretch<double>(point.old.r_x, k.law), Unknowns::Zero())) *
          std::sqrt(w * k.EA));
      if (law_.section.bends()) {
        const Curvature<Real, D> kappa(now.r_x, now.r_xx, k.law, regularization_);
        const Curvature<double, D> old(point.old.r_x, point.old.r_xx, k.law, regularization_);
        add((kappa.value - Real(old.value, Unknowns::Zero())) * std::sqrt(w * k.EI));
      }
      if (law_.rest != nullptr) {
        const auto rest = law_.rest->at(point.x, law_.rest->piece_at(point.x));
        const double regularization = law_.rest->curvature_regularization();
        const RestStrain<Real> constant{Real(rest.axial, Unknowns::Zero()), Real(rest.curvature, Unknowns::Zero()),
                                        Real(rest.axial_x, Unknowns::Zero()), Real(rest.curvature_x, Unknowns::Zero())};
        const RestStress<Real, D> here(now.r_x, now.r_xx, constant, k, regularization);
        const RestStress<double, D> there(point.old.r_x, point.old.r_xx, rest, k, regularization);
        energy += (here.axial + here.bending) * w - Real(w * (there.axial + there.bending), Unknowns::Zero());
      }
      for (int c = 0; c < D; ++c) {
        add((now.r[c] - Real(point.old.r[c], Unknowns::Zero())) * std::sqrt(w * scale_ / std::pow(length_, 4)));
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
  };

  Shape shape_at(const Point& point, const std::array<Real, N>& unknown) const {
    const auto q = chain_.coordinates(point.element);
    const double l = q.x_b - q.x_a, u = (point.x - q.x_a) / l;
    auto constant = [](const Vec<double, D>& value) {
      Vec<Real, D> result;
      for (int c = 0; c < D; ++c) result[c] = Real(value[c], Unknowns::Zero());
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
      using std::exp;
      const Weights<Real> w{exp(unknown[2 * D]), exp(unknown[2 * D + 1]), exp(unknown[2 * D + 2]),
                            exp(unknown[2 * D + 3])};
      f = rational_shape(w, Real(u, Unknowns::Zero()));
    } else {
      if (point.element == merged_ - 1) move(s_b, 0);
      if (point.element == merged_ + 1) move(s_a, D);
      const auto table = rational_shape(current_weights(chain_, point.element, law_.transport), u);
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t n = 0; n < 4; ++n) f[i][n] = Real(table[i][n], Unknowns::Zero());
      }
    }
    const Vec<Real, D> r_a = constant(q.e.r_a), r_b = constant(q.e.r_b);
    auto derivative = [&](std::size_t n, double scale) -> Vec<Real, D> {
      Vec<Real, D> sum;
      for (int c = 0; c < D; ++c) {
        sum[c] = (r_a[c] * f[0][n] + r_b[c] * f[2][n] + (s_a[c] * f[1][n] + s_b[c] * f[3][n]) * l) * scale;
      }
      return sum;
    };
    return {derivative(0, 1), derivative(1, 1 / l), derivative(2, 1 / (l * l))};
  }

  const ChainState<D>& chain_;
  int merged_;
  const MovingLaw<D>& law_;
  double length_ = 0, scale_ = 0;
  double regularization_ = 0;  // [1/m], keeps kappa differentiable in space where it is zero
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
  const typename Search<D>::Unknowns p = Search<D>(chain, before, merged, rational, law)();
  slope<D>(chain.q.data(), merged) += p.template head<D>();
  slope<D>(chain.q.data(), merged + 1) += p.template segment<D>(D);
  for (std::size_t k = 0; k < 3; ++k) weights.k[k] = std::exp(p[2 * D + static_cast<int>(k)] - p[2 * D + 3]);
  chain.mesh.weights[i].w = weights.weights();
  return weights;
}

template MergedWeights least_change(ChainState<2>&, const ChainState<2>&, int, bool, const MovingLaw<2>&);
template MergedWeights least_change(ChainState<3>&, const ChainState<3>&, int, bool, const MovingLaw<3>&);

}  // namespace vlbeam
