#pragma once

#include "mechanics/motion/joint/kinks.hpp"
#include "mechanics/motion/system/constraint_set.hpp"
#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

/// The conditions on slopes at joints where the beam may be kinked, as constraints.
template <int D>
class KinkConstraints final : public ConstraintSet<D> {
 public:
  /// `beam` must outlive this object; supports may be `eliminated`, and some conditions with them: Kinks::adopt().
  KinkConstraints(const CurrentBeam<D>& beam, bool eliminated) : beam_(beam), eliminated_(eliminated) {}

  void adopt() override { kinks_.adopt(beam_, eliminated_); }
  Eigen::Index count() const override { return kinks_.count(); }
  void add_fields(Eigen::Index first, std::vector<FieldRun>& runs) const override {
    if (kinks_.count() > 0) runs.push_back({Field::slope_multiplier, first, kinks_.count()});
  }
  void choose(const double* q) override {
    kinks_.choose(q, [](Eigen::Index /*first*/, int /*count*/) {});
  }

  void add_forces(const double* q, const double* multipliers, double unit, double* r) const override {
    kinks_.add_forces(q, multipliers, unit, r);
  }
  void write_values(const double* q, double* values) const override { kinks_.write_values(q, nullptr, values); }
  void write_rates(const double* q, const double* v, double* rates) const override { kinks_.write_rates(q, v, rates); }
  void add_tangent(const double* q, const double* multipliers, double unit, double scale,
                   BeamMatrix<D>& tangent) const override {
    kinks_.add_curvature(multipliers, unit, tangent);
    kinks_.add_rows(q, scale, tangent);
  }
  void add_second_derivative(Eigen::Index i, double factor, Eigen::MatrixXd& dense) const override {
    kinks_.add_second_derivative(i, factor, dense);
  }
  void follow(const ConstraintSet<D>& other) override { kinks_ = static_cast<const KinkConstraints&>(other).kinks_; }
  void exchange(Archive& memory) override {
    for (auto& kink : kinks_.all()) {
      memory(kink.omitted_axis);
      kinks_.omit(kink, kink.omitted_axis);
    }
  }

  /// The multipliers whose forces are next to `force`, an array like q.
  void balance(const double* q, const double* force, double unit, double* multipliers) const {
    Eigen::Map<Eigen::VectorXd>(multipliers, count()) = -kinks_.nearest(q, force, unit);
  }

 private:
  const CurrentBeam<D>& beam_;
  bool eliminated_;
  Kinks<D> kinks_;
};

}  // namespace vlbeam
