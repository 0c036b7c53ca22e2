#include "core/parts/drag.hpp"

namespace vlbeam {

template <int D>
Tally Drag<D>::add_forces(const ChainView<D>& beam, double* out, double* on_marks) const {
  Tally power;
  add_line_force<D>(beam, quadrature_points, *this, out,
                    [&](int k, const PointMotion<double, D>& at, const Vec<double, D>& f, double weight) {
                      const double given = f.dot(stream);
                      power.loads += weight * given;
                      power.dissipated += weight * (given - f.dot(at.v));
                      if (on_marks == nullptr) return;
                      on_marks[k] += weight * f.dot(at.y_a);
                      on_marks[k + 1] += weight * f.dot(at.y_b);
                    });
  return power;
}

template struct Drag<2>;
template struct Drag<3>;

}  // namespace vlbeam
