#include "core/beam/block_tridiagonal.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "core/pieces.hpp"

namespace vlbeam {
namespace {

template <class Size>
class BlockTridiagonal : public ::testing::Test {
 protected:
  static constexpr int B = Size::value;
  using Matrix = BorderedBlockTridiagonal<B>;

  /// Random entries, the diagonal blocks with `shift` more on their diagonal; where wanted, `symmetric` and with pivots
  /// that are solved.
  Matrix random_matrix(int nodes, int borders, double shift, bool symmetric, bool solves) {
    Matrix m;
    if (solves) m.solve_pivots();
    m.reset(nodes);
    for (int k = 0; k < nodes; ++k) {
      const auto i = static_cast<std::size_t>(k);
      typename Matrix::Block own = random_block();
      if (symmetric) own = (own + own.transpose()).eval() / 2;
      m.diagonal[i] = own + shift * Matrix::Block::Identity();
      if (k + 1 == nodes) continue;
      m.upper[i] = random_block();
      m.lower[i + 1] = symmetric ? typename Matrix::Block(m.upper[i].transpose()) : random_block();
    }
    for (int j = 0; j < borders; ++j) {
      auto& border = m.add_border(std::min(2 * j, nodes - 1));
      for (int i = 0; i < std::min(Matrix::reach, nodes - border.first); ++i) {
        const auto at = static_cast<std::size_t>(i);
        for (double& x : border.column[at]) x = number();
        for (double& x : border.row[at]) x = number();
        if (symmetric) border.row[at] = border.column[at];
      }
    }
    for (int j = 0; j < borders; ++j) {
      for (int i = 0; i <= j; ++i) {
        m.corner(j, i) = number();
        m.corner(i, j) = symmetric ? m.corner(j, i) : number();
      }
    }
    return m;
  }

  Eigen::MatrixXd dense(const Matrix& m) const {
    const Eigen::Index n = Eigen::Index{B} * m.nodes() + m.borders();
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
    m.expand(result);
    return result;
  }

  double number() { return uniform_(engine_); }

 private:
  typename Matrix::Block random_block() {
    typename Matrix::Block block;
    for (Eigen::Index i = 0; i < block.size(); ++i) block.data()[i] = number();
    return block;
  }

  std::mt19937 engine_{7};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

using Sizes =
    ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 4>, std::integral_constant<int, 6>>;
TYPED_TEST_SUITE(BlockTridiagonal, Sizes);

/// A chain that resists along aslant directions 1e10 times as much as across them: what is soft is lost in the inverse
/// of a pivot, and is not where pivots are solved.
TYPED_TEST(BlockTridiagonal, SolvesPivotsOfAStiffAxis) {
  constexpr int nodes = 12;
  typename TestFixture::Matrix m;
  m.solve_pivots();
  m.reset(nodes);
  using Block = typename TestFixture::Matrix::Block;
  using Vector = typename TestFixture::Matrix::Vector;
  for (int k = 0; k < nodes; ++k) {
    const auto i = static_cast<std::size_t>(k);
    Vector axis;
    for (double& a : axis) a = this->number();
    const Block element = Block::Identity() + 1e10 * axis.normalized() * axis.normalized().transpose();
    m.diagonal[i] += element;  // the first is tied to the ground
    if (k == 0) continue;
    m.diagonal[i - 1] += element;
    m.upper[i - 1] = m.lower[i] = -element;
  }
  const Eigen::MatrixXd full = this->dense(m);
  // what a force does that pulls the last node across the last axis, by decompositions of the whole
  const Eigen::VectorXd force = Eigen::VectorXd::Unit(full.rows(), full.rows() - 1);
  const Eigen::VectorXd exact =
      full.cast<long double>().ldlt().solve(force.cast<long double>()).template cast<double>();
  Eigen::VectorXd x = force;
  ASSERT_TRUE(m.factor());
  m.solve(x.data());
  EXPECT_LE((x - exact).norm(), 1e-4 * exact.norm());
  EXPECT_EQ(m.negative_pivots(0), 0);
}

TYPED_TEST(BlockTridiagonal, SolvesWhatItHolds) {
  constexpr double dominant = 3 * TypeParam::value;
  for (const int nodes : {1, 2, 3, 9}) {
    for (const int borders : {0, 1, 3}) {
      auto m = this->random_matrix(nodes, borders, dominant, false, false);
      const Eigen::MatrixXd a = this->dense(m);
      Eigen::VectorXd b(a.rows());
      for (double& x : b) x = this->number();
      ASSERT_TRUE(m.factor());
      Eigen::VectorXd x = b;
      m.solve(x.data());
      EXPECT_LE((a * x - b).cwiseAbs().maxCoeff(), 1e-12 * a.cwiseAbs().maxCoeff() * x.cwiseAbs().maxCoeff())
          << nodes << " nodes, " << borders << " in the border";
    }
  }
}

TYPED_TEST(BlockTridiagonal, CountsNegativeEigenvalues) {
  for (const double shift : {-2.0, 0.0, 1.0, 2.0, 3.0 * TypeParam::value}) {
    for (const int borders : {0, 2}) {
      auto m = this->random_matrix(7, borders, shift, true, true);
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> all(this->dense(m), Eigen::EigenvaluesOnly);
      ASSERT_TRUE(m.factor());
      EXPECT_EQ(m.negative_pivots(1e-13), (all.eigenvalues().array() < 0).count()) << shift << ", " << borders;
    }
  }
}

/// So many nodes that it is factored from both ends.
TYPED_TEST(BlockTridiagonal, SolvesALongOneFromBothEnds) {
  constexpr int W = TypeParam::value, nodes = static_cast<int>(long_range) / W + 5;
  for (const bool solves : {false, true}) {
    auto m = this->random_matrix(nodes, 3, 3.0 * W, false, solves);
    m.border[2].first = nodes - 4;  // behind the middle
    m.border[0].far = nodes - 2;
    for (double& x : m.border[0].far_column) x = this->number();
    for (double& x : m.border[0].far_row) x = this->number();
    const auto a = m;
    using Vector = Eigen::Matrix<double, W, 1>;
    const auto times = [&](const Eigen::VectorXd& x) {
      Eigen::VectorXd result = Eigen::VectorXd::Zero(x.size());
      const auto part = [](auto& of, int k) { return of.template segment<TypeParam::value>(TypeParam::value * k); };
      for (int k = 0; k < nodes; ++k) {
        const auto i = static_cast<std::size_t>(k);
        part(result, k) = a.diagonal[i] * part(x, k);
        if (k + 1 < nodes) part(result, k) += a.upper[i] * part(x, k + 1);
        if (k > 0) part(result, k) += a.lower[i] * part(x, k - 1);
      }
      for (int j = 0; j < 3; ++j) {
        const auto& border = a.border[static_cast<std::size_t>(j)];
        const Eigen::Index at = Eigen::Index{W} * nodes + j;
        for (int i = 0; i < 3; ++i) {
          const Vector &column = border.column[static_cast<std::size_t>(i)],
                       &row = border.row[static_cast<std::size_t>(i)];
          part(result, border.first + i) += column * x[at];
          result[at] += row.dot(part(x, border.first + i));
        }
        result[at] += a.corner.row(j).head(3) * x.tail(3);
        if (border.far < 0) continue;
        part(result, border.far) += border.far_column * x[at];
        result[at] += border.far_row.dot(part(x, border.far));
      }
      return result;
    };
    Eigen::VectorXd b(Eigen::Index{W} * nodes + 3);
    for (double& x : b) x = this->number();
    std::vector<Eigen::VectorXd> answers;
    for (const int threads : {1, 2, 7}) {
      const ThreadLimit limit(threads);
      m = a;
      ASSERT_TRUE(m.factor());
      answers.push_back(b);
      m.solve(answers.back().data());
      EXPECT_EQ(answers.back(), answers.front()) << threads << " threads";
    }
    EXPECT_LE((times(answers.front()) - b).cwiseAbs().maxCoeff(),
              1e-12 * 3 * W * answers.front().cwiseAbs().maxCoeff());
  }
}

/// Blocks that are dominant have as many negative eigenvalues as there are negative numbers on the diagonal.
TYPED_TEST(BlockTridiagonal, CountsNegativeEigenvaluesOfALongOne) {
  constexpr int W = TypeParam::value, nodes = static_cast<int>(long_range) / W + 5;
  auto m = this->random_matrix(nodes, 0, 0, true, true);
  int negative = 0;
  for (auto& block : m.diagonal) {
    for (int i = 0; i < W; ++i) {
      const bool below = this->number() < 0;
      negative += below ? 1 : 0;
      block(i, i) += (below ? -4 : 4) * W;
    }
  }
  ASSERT_TRUE(m.factor());
  EXPECT_EQ(m.negative_pivots(1e-13), negative);
}

TYPED_TEST(BlockTridiagonal, AFixedUnknownOfTheBorderKeepsToItself) {
  auto m = this->random_matrix(5, 2, 3.0 * TypeParam::value, false, false);
  m.fix(0, 4);
  const Eigen::MatrixXd a = this->dense(m);
  const Eigen::Index at = a.rows() - 2;
  EXPECT_EQ(a.row(at).cwiseAbs().sum(), 4);
  EXPECT_EQ(a.col(at).cwiseAbs().sum(), 4);
  ASSERT_TRUE(m.factor());
  Eigen::VectorXd x = Eigen::VectorXd::Unit(a.rows(), at);
  m.solve(x.data());
  EXPECT_EQ((x - Eigen::VectorXd::Unit(a.rows(), at) / 4).cwiseAbs().maxCoeff(), 0);
}

TYPED_TEST(BlockTridiagonal, RefusesASingularPivot) {
  auto m = this->random_matrix(4, 0, 1, false, false);
  m.diagonal[0].setZero();
  EXPECT_FALSE(m.factor());
}

}  // namespace
}  // namespace vlbeam
