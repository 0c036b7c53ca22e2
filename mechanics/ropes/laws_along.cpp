#include "mechanics/ropes/laws_along.hpp"

#include <algorithm>

namespace vlbeam {
namespace {

/// A force per length that is the same for all points.
template <int D>
struct Push {
  Vec<double, D> size;

  static bool acts(const Vec<double, D>& /*place*/) { return true; }
  template <class Real>
  Vec<Real, D> force(const LinePoint<Real, D>& /*at*/) const {
    return size.template cast<Real>();
  }
};

template <int D>
class LawsAlong final : public Part<D> {
 public:
  LawsAlong(std::vector<LawAlong<D>> laws, int points) : laws_(std::move(laws)), points_(points) {}

  EnergyBalance add_force(const Motion<D>& motion, double* force) const override {
    EnergyBalance power;
    const ChainView<D>& beam = motion.beam;
    for (int k = 0; k < beam.mesh.elements(); ++k) {
      const LawAlong<D>& law = law_of(beam, k);
      if (law.drag.present()) {
        add_line_force_of<D>(beam, k, points_, law.drag, force,
                             [&](int, const PointMotion<double, D>& at, const Vec<double, D>& f, double weight) {
                               const double given = f.dot(law.drag.stream);
                               power.loads += weight * given;
                               power.dissipated += weight * (given - f.dot(at.v));
                             });
      }
      if (!law.push) continue;
      add_line_force_of<D>(beam, k, points_, Push<D>{law.push(motion.t)}, force,
                           [&](int, const PointMotion<double, D>& at, const Vec<double, D>& f, double weight) {
                             power.loads += weight * f.dot(at.v);
                           });
    }
    return power;
  }
  void add_tangent(const Motion<D>& motion, const TangentWeights& by, BeamMatrix<D>& tangent) const override {
    const ChainView<D>& beam = motion.beam;
    for (int k = 0; k < beam.mesh.elements(); ++k) {
      const LawAlong<D>& law = law_of(beam, k);
      if (law.drag.present()) tangent.add_point(beam, k, line_tangent<D>(beam, k, points_, law.drag, by));
      if (law.push && moves_along(beam, k)) {
        tangent.add_point(beam, k, line_tangent<D>(beam, k, points_, Push<D>{law.push(motion.t)}, by));
      }
    }
  }

 private:
  const LawAlong<D>& law_of(const ChainView<D>& beam, int k) const {
    const double x = (beam.mark_of(k) + beam.mark_of(k + 1)) / 2;
    return *std::ranges::upper_bound(laws_.begin(), laws_.end() - 1, x, {}, &LawAlong<D>::end);
  }

  std::vector<LawAlong<D>> laws_;
  int points_;
};

}  // namespace

template <int D>
std::shared_ptr<const Part<D>> laws_along(std::vector<LawAlong<D>> laws, int quadrature_points) {
  return std::make_shared<LawsAlong<D>>(std::move(laws), quadrature_points);
}
template std::shared_ptr<const Part<2>> laws_along(std::vector<LawAlong<2>>, int);
template std::shared_ptr<const Part<3>> laws_along(std::vector<LawAlong<3>>, int);

}  // namespace vlbeam
