#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "mechanics/motion/system/beam_system.hpp"
#include "mechanics/spin/spin_room.hpp"
#include "tests/core/support/chain_models.hpp"
#include "tests/core/support/element_family.hpp"
#include "tests/core/support/flows.hpp"

#if defined(__SANITIZE_ADDRESS__)
#define VLBEAM_COUNTS_ALLOCATIONS 0  // the sanitizer has its own malloc
#else
#define VLBEAM_COUNTS_ALLOCATIONS 1
#endif

namespace {
std::size_t allocations = 0;
}

#if VLBEAM_COUNTS_ALLOCATIONS
// glibc's own functions, behind ones that count: Eigen allocates with malloc, the standard library with operator new.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++allocations;
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
}
#endif

namespace vlbeam::test {
namespace {

template <int D>
void expect_no_allocation(const ElementKindUnderTest& kind, int joint, double damping,
                          JointSlopes slopes = JointSlopes::continuous, int rider = -1,
                          const std::vector<ChainShape::Joint>& more = {}) {
  Random random(12);
  const ChainShape shape{.elements = 9,
                         .joint = joint,
                         .rational = kind.rational,
                         .transport = kind.transport,
                         .slopes = slopes,
                         .rider = rider,
                         .more = more};
  auto model = model_of<D>(shape, random);
  for (auto& sliding : model.joints) {
    if (slopes != JointSlopes::continuous || rider >= 0) sliding.law.friction = AxialFriction{0.2};
  }
  model.section.stiffness.law = kind.law;
  model.axial_strain = kind.axial;
  model.section.damping = damping;
  model.start = Support<D>::direction_clamp(random.vector<D>());
  model.loads = loads_on<D>(shape.elements * shape.element_length, random);
  BeamSystem<D> system(model, random_chain<D>(shape, random));
  const Eigen::VectorXd y = system.initial_state();
  Eigen::VectorXd dydt(system.size());
  const std::size_t before = allocations;
  system.rhs(y, dydt, 0);
  system.rhs(y, dydt, 0.1);
  EXPECT_EQ(allocations - before, 0U);
  EXPECT_TRUE(dydt.allFinite());
}

TEST(RightHandSide, AllocatesNothing) {
  if (!VLBEAM_COUNTS_ALLOCATIONS) GTEST_SKIP() << "not under a sanitizer";
  const std::size_t before = allocations;
  void* volatile memory = std::malloc(16);
  std::free(memory);
  memory = ::operator new(16);
  ::operator delete(memory);
  ASSERT_EQ(allocations - before, 2U) << "the counter counts";
  for (const auto& kind : element_family) {
    SCOPED_TRACE(kind.name());
    for (const int joint : {no_joint, 1, 4, 8}) {
      for (const double damping : {0.0, 0.01}) {
        expect_no_allocation<2>(kind, joint, damping);
        expect_no_allocation<3>(kind, joint, damping);
      }
    }
    for (const auto slopes : {JointSlopes::tangent, JointSlopes::equal_stretch, JointSlopes::free}) {
      expect_no_allocation<2>(kind, 4, 0, slopes);
      expect_no_allocation<3>(kind, 4, 0, slopes);
    }
    for (const auto slopes : {JointSlopes::continuous, JointSlopes::tangent}) {
      expect_no_allocation<2>(kind, 2, 0, slopes, -1, {{3}, {7, slopes}});
      expect_no_allocation<3>(kind, 2, 0, slopes, -1, {{3}, {7, slopes}});
    }
    for (const int rider : {0, 8}) {
      expect_no_allocation<2>(kind, no_joint, 0, JointSlopes::continuous, rider);
      expect_no_allocation<3>(kind, no_joint, 0, JointSlopes::continuous, rider);
    }
  }
}

template <int D>
void expect_steady_steps(int joint, double damping, Constraints constraints, NewtonKind newton,
                         JointSlopes slopes = JointSlopes::continuous) {
  Random random(12);
  const ChainShape shape{.elements = 9, .joint = joint, .rational = true, .slopes = slopes};
  auto model = model_of<D>(shape, random);
  if (slopes != JointSlopes::continuous) model.joints.front().law.friction = AxialFriction{0.2, 0.1};
  model.section.damping = damping;
  model.start = Support<D>::direction_clamp(random.vector<D>());
  model.constraints = constraints;
  BeamSystem<D> system(model, random_chain<D>(shape, random));
  Eigen::VectorXd y = system.initial_state();
  NewtonCounters counters;
  GeneralizedAlphaOptions options;
  options.newton = newton;
  const auto stepper = make_generalized_alpha(*system.second_order(), options, &counters);
  double t = 0, dt = 1e-3;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(stepper->try_step(system, y, t, dt));
  const std::size_t before = allocations, tangents = counters.tangents;
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(stepper->try_step(system, y, t, dt));
  EXPECT_EQ(allocations - before, 0U);
  EXPECT_GE(counters.tangents, tangents + (newton == NewtonKind::full ? 20U : 0U));
}

TEST(GeneralizedAlphaStep, AllocatesNothingOnceItIsGoing) {
  if (!VLBEAM_COUNTS_ALLOCATIONS) GTEST_SKIP() << "not under a sanitizer";
  for (const int joint : {no_joint, 1, 4}) {
    for (const auto constraints : {Constraints::eliminated, Constraints::multipliers}) {
      for (const auto newton : {NewtonKind::modified, NewtonKind::full}) {
        SCOPED_TRACE(joint);
        expect_steady_steps<2>(joint, 0, constraints, newton);
        expect_steady_steps<2>(joint, 0.01, constraints, newton);
        expect_steady_steps<3>(joint, 0, constraints, newton);
      }
    }
  }
  for (const auto slopes : {JointSlopes::tangent, JointSlopes::equal_stretch, JointSlopes::free}) {
    expect_steady_steps<2>(4, 0, Constraints::multipliers, NewtonKind::modified, slopes);
    expect_steady_steps<3>(4, 0, Constraints::multipliers, NewtonKind::full, slopes);
  }
}

TEST(RightHandSide, OfAFlowingBeamAllocatesNothing) {
  if (!VLBEAM_COUNTS_ALLOCATIONS) GTEST_SKIP() << "not under a sanitizer";
  Random random(4);
  BeamModel<3> model = moving_span<3>(6, true, 10);
  spin_in(model).section = {.rhoIp = 1, .GIp = 1, .damping = 0.1};
  model.loads.points = {
      {.node = 3, .force = [](double t) { return Eigen::Vector3d(t, 1, 0); }, .follower = [](double) { return 1.0; }}};
  spin_in(model).torques.points = {{.node = 3, .torque = [](double) { return 1.0; }}};
  model.loads.line_force = [](double t) { return Eigen::Vector3d(0, t, 1); };
  spin_in(model).torques.line = [](double) { return 1.0; };
  BeamSystem<3> beam(model, straight_chain(model));
  const Eigen::VectorXd y = random_state(beam, random);
  Eigen::VectorXd dydt(beam.size());
  beam.rhs(y, dydt, 0);
  const std::size_t before = allocations;
  beam.rhs(y, dydt, 0.01);
  EXPECT_EQ(allocations - before, 0U);
  EXPECT_TRUE(dydt.allFinite());
}

}  // namespace
}  // namespace vlbeam::test
