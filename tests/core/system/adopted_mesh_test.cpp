// A beam that takes over another mesh keeps what holds for elements that both have, and nothing else.
#include <gtest/gtest.h>

#include <functional>

#include "mechanics/motion/system/current_beam.hpp"
#include "scene/build.hpp"
#include "tests/core/support/chain_models.hpp"
#include "tests/core/support/scenes.hpp"

namespace vlbeam::test {
namespace {

constexpr int D = 2, in_all = 24, slides_at = 11;

/// Forces of the elements on either side, and what they leave of them at their open nodes.
Eigen::VectorXd answers(const CurrentBeam<D>& beam) {
  Random random(2);
  Eigen::VectorXd q(beam.coordinates());
  for (double& entry : q) entry = random.uniform(-1, 1);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(q.size());
  for (const Span<D>* span : {&beam.left(), &beam.right()}) {
    span->add_forces(q.data(), q.data(), {0, -9.81}, force.data());
    span->add_inertia(q.data(), force.data());
    span->reduce(force.data());
  }
  return force;
}

void expect_all_that_changes_to_be_seen(const BeamModel<D>& model, const ChainState<D>& chain) {
  using Change = std::function<void(ChainState<D>&, int element)>;
  std::vector<Change> changes{
      [](ChainState<D>& of, int k) { of.mesh.weights[static_cast<std::size_t>(k)].w[1] += 0.1; },
      [](ChainState<D>& of, int k) { of.mesh.x[static_cast<std::size_t>(k)] += 1e-3; },
      [](ChainState<D>& of, int k) { of.mesh.x[static_cast<std::size_t>(k) + 1] -= 1e-3; }};
  if (chain.curved_at_rest()) {
    changes.push_back([](ChainState<D>& of, int k) { slope<D>(of.rest.data(), k)[0] += 1e-3; });
    changes.push_back([](ChainState<D>& of, int k) { slope<D>(of.rest.data(), k + 1)[1] += 1e-3; });
  }
  const Eigen::VectorXd as_it_was = answers(CurrentBeam<D>(model, chain));
  for (std::size_t i = 0; i < changes.size(); ++i) {
    for (const int k : {2, slides_at - 3, slides_at + 3, in_all - 2}) {
      ChainState<D> changed = chain;
      changes[i](changed, k);
      CurrentBeam<D> beam(model, chain);
      beam.adopt(changed);
      const Eigen::VectorXd seen = answers(beam);
      const auto off = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) { return (a - b).norm() / b.norm(); };
      // by rounding: elements whose lengths differ by it share the tables of one of them
      EXPECT_LE(off(seen, answers(CurrentBeam<D>(model, changed))), 1e-13) << "change " << i << " of element " << k;
      EXPECT_GE(off(seen, as_it_was), 1e-10) << "change " << i << " of element " << k;
      beam.adopt(chain);
      EXPECT_LE(off(answers(beam), as_it_was), 1e-13) << "change " << i << " of element " << k;
    }
  }
}

TEST(AdoptedMesh, IsSeenWhereItChanges) {
  Random random(1);
  const ChainShape shape{.elements = in_all, .joint = slides_at};
  const auto model = model_of<D>(shape, random);
  expect_all_that_changes_to_be_seen(model, random_chain<D>(shape, random));
}

TEST(AdoptedMesh, IsSeenWhereTheRestShapeChanges) {
  Scene scene = falling_beam(ElementKind::ale_rancf, in_all);
  scene.beam.curve.type = CurveType::arc;
  scene.beam.rest_shape = RestShape::as_built;
  expect_all_that_changes_to_be_seen(build_model<D>(scene), build_chain<D>(scene));
}

}  // namespace
}  // namespace vlbeam::test
