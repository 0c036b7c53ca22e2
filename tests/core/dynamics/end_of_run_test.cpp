// The end of a run: it is reached, and decides nothing about the steps before it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/dynamics/integrate.hpp"
#include "tests/core/support/function_ode.hpp"

namespace vlbeam::test {
namespace {

/// q'' = -q, and no equation at all after a time.
class MortalOscillator final : public SecondOrderSystem {
 public:
  explicit MortalOscillator(double dies_at) : dies_at_(dies_at) {}

  Eigen::Index coordinates() const override { return 1; }
  std::vector<FieldRun> fields() const override { return {{Field::position, 0}}; }
  void acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd&, double, Eigen::VectorXd& a) override { a = -q; }
  double residual(const Eigen::VectorXd& q, const Eigen::VectorXd&, const Eigen::VectorXd& a, double t,
                  Eigen::VectorXd& r) override {
    r = t > dies_at_ ? Eigen::VectorXd::Constant(1, std::numeric_limits<double>::quiet_NaN()) : Eigen::VectorXd(a + q);
    return 0;
  }
  bool linearize(const Eigen::VectorXd&, const Eigen::VectorXd&, const Eigen::VectorXd&, double,
                 const TangentWeights& by) override {
    pivot_ = by.a + by.q;
    return true;
  }
  void solve(Eigen::VectorXd& r) const override { r /= pivot_; }
  void jacobian(const Eigen::VectorXd&, double, Eigen::MatrixXd&, Eigen::VectorXd&) override {}
  double conserving_residual(const Eigen::VectorXd&, const Eigen::VectorXd&, const Eigen::VectorXd&,
                             const Eigen::VectorXd&, double, double, Eigen::VectorXd&) override {
    return 0;
  }

 private:
  double dies_at_, pivot_ = 1;
};

class Mortal : public FunctionOde {
 public:
  explicit Mortal(double dies_at) : FunctionOde(oscillator()), dies_at_(dies_at) {}
  std::vector<FieldRun> fields() const override { return {{Field::position, 0}}; }
  std::unique_ptr<SecondOrderSystem> new_second_order() override {
    return std::make_unique<MortalOscillator>(dies_at_);
  }

 private:
  double dies_at_;
};

constexpr double never = std::numeric_limits<double>::infinity();

struct End {
  std::size_t steps = 0;
  double q = 0, sampled = 0;  ///< at the end, and at the first sample
};

End run_to(double t_end, double sample_at, double dies_at) {
  Mortal ode(dies_at);
  IntegrationOptions options;
  options.type = IntegratorType::generalized_alpha;
  options.generalized_alpha.adaptive = true;
  options.generalized_alpha.step = 0.3;
  options.generalized_alpha.first_step = 1e-3;
  options.generalized_alpha.tolerances = {1e-5, 1e-5};
  SolverCounters counters;
  Eigen::VectorXd y = Eigen::Vector2d(1, 0);
  double t = 0;
  EXPECT_TRUE(integrate(ode, y, t, t_end, {sample_at}, options, counters));
  EXPECT_EQ(t, t_end);
  return {counters.steps, y[0], ode.samples.front().y[0]};
}

TEST(EndOfRun, IsReachedWhereNothingIsBehindIt) {
  for (const double end : {0.5, 1.0, 2.7}) {
    const End free = run_to(end, end, never), mortal = run_to(end, end, end);
    EXPECT_NEAR(mortal.q, std::cos(end), 1e-3);
    EXPECT_NEAR(mortal.q, free.q, 1e-5);
    EXPECT_LE(mortal.steps, free.steps + 12);
  }
}

TEST(EndOfRun, DecidesNothingAboutTheStepBefore) {
  for (int i = 1; i <= 200; ++i) {
    const double end = 0.02 * i;
    EXPECT_EQ(run_to(end, end, never).q, run_to(2 * end, end, never).sampled) << end;
  }
}

}  // namespace
}  // namespace vlbeam::test
