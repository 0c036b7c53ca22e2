#include "mechanics/motion/system/mass_condition.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "scene/build.hpp"
#include "tests/core/support/by_greens_law.hpp"

namespace vlbeam::test {
namespace {

double condition(const Scene& scene) {
  BeamSystem<2> system(build_model<2>(scene), build_chain<2>(scene));
  return mass_condition(system, system.initial_state());
}

TEST(MassCondition, OfTwoFixedElementsIsThatOfTheTextbookMatrix) {
  Scene scene = test::by_greens_law();
  scene.beam.element = ElementKind::ancf;
  scene.beam.elements = 2;
  scene.start.type = SupportType::pin;
  scene.end = {SupportType::clamp, ClampType::full};
  // consistent mass of a Hermite beam element of unit length and mass 420
  Eigen::Matrix4d element;
  element << 156, 22, 54, -13, 22, 4, 13, -3, 54, 13, 156, -22, -13, -3, -22, 4;
  Eigen::Matrix<double, 6, 6> mass = Eigen::Matrix<double, 6, 6>::Zero();
  mass.topLeftCorner<4, 4>() += element;
  mass.bottomRightCorner<4, 4>() += element;
  const Eigen::Matrix3d kept = mass.block<3, 3>(1, 1);
  const Eigen::Vector3d scale = kept.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Vector3d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scale.asDiagonal() * kept * scale.asDiagonal()).eigenvalues();
  EXPECT_NEAR(condition(scene), values[2] / values[0], 1e-10);
}

Scene sliding() {
  Scene scene = test::by_greens_law();
  scene.beam.element = ElementKind::ale_ancf;
  scene.beam.elements = 4;
  scene.start.type = SupportType::clamp;
  scene.sliding_mass = SlidingMassSpec{};
  scene.sliding_mass->position = 0.3;
  return scene;
}

/// Bent by a smooth field, so that the moving node does not merely reparametrise the curve.
double bent_condition(const Scene& scene, double length) {
  BeamSystem<2> system(build_model<2>(scene), build_chain<2>(scene));
  Eigen::VectorXd y = system.initial_state();
  for (int k = 0; k <= scene.beam.elements; ++k) {
    const double s = position<2>(y.data(), k)[0] / length;
    position<2>(y.data(), k)[1] += length * 0.3 * s * s;
    slope<2>(y.data(), k)[1] += 0.6 * s;
  }
  return mass_condition(system, y);
}

TEST(MassCondition, HasNoUnits) {
  Scene scene = sliding();
  const double in_metres = bent_condition(scene, 1);
  EXPECT_GT(in_metres, 1);
  EXPECT_LT(in_metres, 1e6);
  // the same in millimetres and tonnes
  scene.beam.curve.end = {1000, 0, 0};
  scene.beam.section.radius *= 1000;
  scene.beam.material.density *= 1e-12;
  scene.sliding_mass->mass *= 1e-3;
  scene.sliding_mass->position *= 1000;
  EXPECT_NEAR(bent_condition(scene, 1000), in_metres, 1e-9 * in_metres);
}

TEST(MassCondition, DoesNotDependOnTheFrameOfASupport) {
  Scene scene = sliding();
  const double along_x = condition(scene);
  scene.beam.curve.end = {0.6, -0.8, 0};
  EXPECT_LE(condition(scene) / along_x, 4);
  EXPECT_GE(condition(scene) / along_x, 0.25);
}

TEST(MassCondition, GrowsAsTheMassVanishes) {
  Scene scene = sliding();
  double last = 0;
  for (const double mass : {1.0, 1e-2, 1e-4}) {
    scene.sliding_mass->mass = mass;
    const double now = condition(scene);
    EXPECT_GT(now, last);
    last = now;
  }
  EXPECT_GT(last, 1e3);
}

}  // namespace
}  // namespace vlbeam::test
