#pragma once

#include <limits>
#include <memory>

#include "tests/core/support/function_ode.hpp"

namespace vlbeam::test {

inline constexpr double never = std::numeric_limits<double>::infinity();

/// q'' = -q, and no equation at all after a time.
class MortalOscillator final : public SecondOrderSystem {
 public:
  MortalOscillator(double dies_at, int& residuals) : dies_at_(dies_at), residuals_(residuals) {}

  Eigen::Index coordinates() const override { return 1; }
  std::vector<FieldRun> fields() const override { return {{Field::position, 0}}; }
  void acceleration(const Eigen::VectorXd& q, const Eigen::VectorXd&, double, Eigen::VectorXd& a) override { a = -q; }
  double residual(const Eigen::VectorXd& q, const Eigen::VectorXd&, const Eigen::VectorXd& a, double t,
                  Eigen::VectorXd& r) override {
    ++residuals_;
    r = t > dies_at_ ? Eigen::VectorXd::Constant(1, std::numeric_limits<double>::quiet_NaN()) : Eigen::VectorXd(a + q);
    return 0;
  }
  bool linearize(const Eigen::VectorXd&, const Eigen::VectorXd&, const Eigen::VectorXd&, double,
                 const TangentWeights& by) override {
    pivot_ = by.a + by.q;
    return true;
  }
  void solve(Eigen::VectorXd& r) const override { r /= pivot_; }

 private:
  double dies_at_, pivot_ = 1;
  int& residuals_;
};

/// The oscillator for implicit methods, too.
class SecondOrderOscillator : public FunctionOde {
 public:
  explicit SecondOrderOscillator(double dies_at = never) : FunctionOde(oscillator()), dies_at_(dies_at) {}
  std::vector<FieldRun> fields() const override { return {{Field::position, 0}}; }
  std::unique_ptr<SecondOrderSystem> new_second_order() override {
    return std::make_unique<MortalOscillator>(dies_at_, residuals);
  }

  int residuals = 0;  ///< evaluations

 private:
  double dies_at_;
};

}  // namespace vlbeam::test
