#pragma once

#include <memory>

#include "mechanics/motion/system/implicit_beam.hpp"
#include "tests/core/support/chain_models.hpp"
#include "tests/core/support/differences.hpp"

namespace vlbeam::test {

/// A chain in random motion, held at its ends: what a part that acts on it is tested on.
template <int D>
struct HeldChain {
  static constexpr double now = 0.13;  ///< [s]

  /// `add(model, random)` gives the model its parts.
  template <class Add>
  HeldChain(const ChainShape& shape, unsigned seed, Constraints constraints, const Add& add) : random(seed) {
    auto model = model_of<D>(shape, random);
    model.start = Support<D>::direction_clamp(random.template vector<D>());
    model.end = Support<D>::pin();
    model.constraints = constraints;
    model.quadrature_points = 7;
    add(model, random);
    system = std::make_unique<BeamSystem<D>>(model, random_chain<D>(shape, random));
    y = system->initial_state();
  }

  Eigen::VectorXd rates() const {
    Eigen::VectorXd dydt(y.size());
    system->rhs(y, dydt, now);
    return dydt;
  }
  /// Rate of the energy by the model's own points.
  double energy_rate() const {
    const Eigen::VectorXd along = rates();
    return slope_of([&](double s) {
      const auto seen = system->observe(y + s * along, now, own_points);
      return Eigen::VectorXd::Constant(1, seen.energy.total());
    })[0];
  }
  /// Power of the supports: the random state moves what they hold.
  double support_power() const {
    const auto forces = system->forces(y, now).supports;
    const Eigen::Index n = system->coordinates(), last = Eigen::Index{node_size<D>} * system->mesh().last();
    return forces[0].dot(y.template segment<node_size<D>>(n)) +
           forces[1].dot(y.template segment<node_size<D>>(n + last));
  }
  /// Along (d, by.v d, by.a d) the solve with the tangent undoes the residual's change: by how much it does not, over
  /// d.
  double tangent_error(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
    auto& implicit = *system->second_order();
    const TangentWeights by{1, 7, 300};
    Eigen::VectorXd r(q.size());
    const Eigen::VectorXd a = Eigen::VectorXd::NullaryExpr(q.size(), [&] { return random.uniform(-3, 3); });
    Eigen::VectorXd d = Eigen::VectorXd::NullaryExpr(q.size(), [&] { return random.uniform(-1, 1); });
    if (!implicit.linearize(q, v, a, now, by)) return 1;
    implicit.residual(q, v, a + d, now, r);
    implicit.solve(r);
    d = r / r.norm();
    Eigen::VectorXd change = slope_of([&](double s) {
      implicit.residual(q + s * d, v + s * by.v * d, a + s * by.a * d, now, r);
      return r;
    });
    implicit.solve(change);
    return (change - d).norm();
  }

  Random random;
  std::unique_ptr<BeamSystem<D>> system;
  Eigen::VectorXd y;
};

}  // namespace vlbeam::test
