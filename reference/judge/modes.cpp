#include "modes.hpp"

#include <boost/math/special_functions/jacobi.hpp>
#include <boost/math/special_functions/legendre.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <stdexcept>
#include <vector>

namespace judge {
namespace {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
using Jet = std::array<Real, 3>;  // value, first and second derivative

Jet bubble(int j, const Real& x) {
  const Real four = 4;
  const unsigned n = static_cast<unsigned>(j);
  const Real p = boost::math::jacobi(n, four, four, x);
  const Real dp = j < 1 ? Real(0) : boost::math::jacobi_prime(n, four, four, x);
  const Real ddp = j < 2 ? Real(0) : boost::math::jacobi_double_prime(n, four, four, x);
  const Real u = 1 - x * x, f = u * u, df = -4 * x * u, ddf = 12 * x * x - 4;
  return {f * p, df * p + f * dp, ddf * p + 2 * df * dp + f * ddp};
}

Jet hermite(int i, const Real& x) {
  switch (i) {
    case 0:
      return {(1 - x) * (1 - x) * (2 + x) / 4, 3 * (x * x - 1) / 4, 3 * x / 2};
    case 1:
      return {(1 - x) * (1 - x) * (1 + x) / 4, (1 - x) * (-1 - 3 * x) / 4, (3 * x - 1) / 2};
    case 2:
      return {(1 + x) * (1 + x) * (2 - x) / 4, 3 * (1 - x * x) / 4, -3 * x / 2};
    default:
      return {(1 + x) * (1 + x) * (x - 1) / 4, (1 + x) * (3 * x - 1) / 4, (3 * x + 1) / 2};
  }
}

struct Rule {
  std::vector<Real> x, w;
};

/// Gauss and Legendre: exact for degree 2 n - 1.
Rule gauss(int n) {
  Rule rule;
  const auto add = [&](const Real& x) {
    const Real d = boost::math::legendre_p_prime(n, x);
    rule.x.push_back(x);
    rule.w.push_back(2 / ((1 - x * x) * d * d));
  };
  for (const Real& zero : boost::math::legendre_p_zeros<Real>(n)) {
    add(zero);
    if (zero != 0) add(-zero);
  }
  return rule;
}

/// Columns of all modes at a place: bubbles made orthonormal, ends made orthogonal to them.
class Basis {
 public:
  explicit Basis(int degree) : degree_(degree) {
    if (degree < 4) throw std::invalid_argument("a stretch needs degree 4 at least");
    const Rule rule = gauss(degree + 1);
    const std::size_t count = degree - 3;
    norm_.resize(count, 0);
    part_.assign(4, std::vector<Real>(count, 0));
    for (std::size_t j = 0; j < count; ++j) {
      for (std::size_t g = 0; g < rule.x.size(); ++g) {
        const Real b = bubble(static_cast<int>(j), rule.x[g])[0];
        norm_[j] += rule.w[g] * b * b;
        for (int i = 0; i < 4; ++i) part_[i][j] += rule.w[g] * b * hermite(i, rule.x[g])[0];
      }
      norm_[j] = 1 / sqrt(norm_[j]);
      for (int i = 0; i < 4; ++i) part_[i][j] *= norm_[j];
    }
  }

  std::vector<Jet> operator()(const Real& x) const {
    std::vector<Jet> all(degree_ + 1);
    for (int i = 0; i < 4; ++i) all[i] = hermite(i, x);
    for (std::size_t j = 0; j < norm_.size(); ++j) {
      Jet b = bubble(static_cast<int>(j), x);
      for (int k = 0; k < 3; ++k) {
        b[k] *= norm_[j];
        for (int i = 0; i < 4; ++i) all[i][k] -= part_[i][j] * b[k];
      }
      all[4 + j] = b;
    }
    return all;
  }

 private:
  int degree_;
  std::vector<Real> norm_;
  std::vector<std::vector<Real>> part_;
};

}  // namespace

Modes make_modes(int degree, int points) {
  const Basis basis(degree);
  const Rule rule = gauss(points);
  Modes m;
  m.degree = degree;
  m.xi.resize(points);
  m.weight.resize(points);
  m.value.resize(points, degree + 1);
  m.slope = m.bend = m.value;
  std::array<std::array<Real, 4>, 4> gram{};
  for (int g = 0; g < points; ++g) {
    m.xi[g] = static_cast<double>(rule.x[g]);
    m.weight[g] = static_cast<double>(rule.w[g]);
    const std::vector<Jet> all = basis(rule.x[g]);
    for (int k = 0; k <= degree; ++k) {
      m.value(g, k) = static_cast<double>(all[k][0]);
      m.slope(g, k) = static_cast<double>(all[k][1]);
      m.bend(g, k) = static_cast<double>(all[k][2]);
    }
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 4; ++k) gram[i][k] += rule.w[g] * all[i][0] * all[k][0];
    }
  }
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 4; ++k) m.ends_gram(i, k) = static_cast<double>(gram[i][k]);
  }
  return m;
}

Eigen::RowVectorXd mode_values(int degree, double xi) {
  const std::vector<Jet> all = Basis(degree)(xi);
  Eigen::RowVectorXd row(degree + 1);
  for (int k = 0; k <= degree; ++k) row[k] = static_cast<double>(all[k][0]);
  return row;
}

}  // namespace judge
