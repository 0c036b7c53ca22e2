#include "mechanics/time/in_tolerances.hpp"

#include <optional>
#include <utility>

namespace vlbeam {
namespace {

constexpr double uncontrolled = 0x1p200;  // in units of this nothing is large enough to matter

/// Equations of z = y/unit.
class ScaledOde final : public Ode {
 public:
  ScaledOde(Ode& ode, const FieldTolerances& tolerances) : ode_(ode), y_(ode.size()) {
    const auto fields = ode.fields();
    Eigen::Index coordinates = 0;
    for_each_coordinate(fields, [&](Field, Eigen::Index) { ++coordinates; });
    unit_.setConstant(ode.size(), uncontrolled);
    for_each_coordinate(fields, [&](Field field, Eigen::Index i) {
      const auto f = static_cast<std::size_t>(field);
      unit_[i] = tolerances.of[f];
      unit_[coordinates + i] = tolerances.of_rate[f];
    });
  }

  const Eigen::VectorXd& unit() const { return unit_; }

  Eigen::Index size() const override { return unit_.size(); }
  void rhs(const Eigen::VectorXd& z, Eigen::VectorXd& dzdt, double t) override {
    y_ = z.cwiseProduct(unit_);
    ode_.rhs(y_, dzdt, t);
    dzdt = dzdt.cwiseQuotient(unit_);
  }
  void jacobian(const Eigen::VectorXd& z, double t, Eigen::MatrixXd& dfdz, Eigen::VectorXd& dfdt) override {
    y_ = z.cwiseProduct(unit_);
    ode_.jacobian(y_, t, dfdz, dfdt);
    dfdz = (dfdz.array().colwise() / unit_.array()).rowwise() * unit_.transpose().array();
    dfdt = dfdt.cwiseQuotient(unit_);
  }

 private:
  Ode& ode_;
  Eigen::VectorXd unit_, y_;
};

class InTolerances final : public Stepper {
 public:
  InTolerances(std::unique_ptr<Stepper> inner, const FieldTolerances& tolerances)
      : inner_(std::move(inner)), tolerances_(tolerances) {}

  bool try_step(Ode& ode, Eigen::VectorXd& y, double& t, double& dt) override {
    if (!scaled_) scaled_.emplace(ode, tolerances_);
    z_ = y.cwiseQuotient(scaled_->unit());
    const bool done = inner_->try_step(*scaled_, z_, t, dt);
    if (done) y = z_.cwiseProduct(scaled_->unit());
    return done;
  }

  void exchange(Archive& memory) override { inner_->exchange(memory); }

  void reset() override {
    inner_->reset();
    scaled_.reset();  // an event may have changed what the state is
  }

 private:
  std::unique_ptr<Stepper> inner_;
  FieldTolerances tolerances_;
  std::optional<ScaledOde> scaled_;
  Eigen::VectorXd z_;
};

}  // namespace

std::unique_ptr<Stepper> in_tolerances(std::unique_ptr<Stepper> inner, const FieldTolerances& tolerances) {
  return std::make_unique<InTolerances>(std::move(inner), tolerances);
}

}  // namespace vlbeam
