#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "core/geometry/vec.hpp"
#include "mechanics/motion/joint/joint_slopes.hpp"

namespace vlbeam {

/// Conditions C(z) = 0 on the slopes z = (r_x-, r_x+) of a joint that has two. Each is a quadratic form with a constant
/// matrix, C = z.H z/2, so that C' = z.H z' and C'' = z.H z'' + z'.H z'.
template <int D>
class SlopeConditions {
 public:
  static constexpr int most = D - 1;
  using Slopes = Eigen::Matrix<double, 2 * D, 1>;
  using Form = Eigen::Matrix<double, 2 * D, 2 * D>;

  SlopeConditions() = default;
  /// In space two components of r_x- x r_x+ = 0 imply the third. So the component along axis `omitted` is left out;
  /// r_x- must not vanish along that axis.
  SlopeConditions(JointSlopes slopes, int omitted) {
    forms_.fill(Form::Zero());
    if (slopes == JointSlopes::equal_stretch) {
      Form& form = add();
      form.diagonal().template head<D>().setOnes();
      form.diagonal().template tail<D>().setConstant(-1);
    }
    if (slopes != JointSlopes::tangent) return;
    for (int normal = D == 2 ? 2 : 0; normal < 3; ++normal) {
      if (D == 3 && normal == omitted) continue;
      const int a = (normal + 1) % 3, b = (normal + 2) % 3;
      Form& form = add();
      form(a, D + b) = form(D + b, a) = 1;
      form(b, D + a) = form(D + a, b) = -1;
    }
  }

  int count() const { return count_; }
  const Form& form(int i) const { return forms_[static_cast<std::size_t>(i)]; }
  Slopes gradient(int i, const Slopes& z) const { return form(i) * z; }
  double value(int i, const Slopes& z) const { return 0.5 * z.dot(form(i) * z); }
  double rate(int i, const Slopes& z, const Slopes& z_rate) const { return z.dot(form(i) * z_rate); }

 private:
  Form& add() { return forms_[static_cast<std::size_t>(count_++)]; }

  int count_ = 0;
  std::array<Form, most> forms_;
};

/// Axis along which `slope` is longest.
template <int D>
int longest_axis(const Vec<double, D>& slope) {
  int axis = 0;
  slope.cwiseAbs().maxCoeff(&axis);
  return axis;
}

}  // namespace vlbeam
