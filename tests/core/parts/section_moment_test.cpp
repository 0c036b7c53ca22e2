// Moments on the sections of beams in space: they do the virtual work that a moment does on a triad.
#include "mechanics/frames/section_moment.hpp"

#include <gtest/gtest.h>

#include <array>

namespace vlbeam::test {
namespace {

using Vector = Vec<double, 3>;

const TriadReference reference{Vector(1, 2, 3).normalized(), Vector(1, 2, 3).cross(Vector(0, 1, 0)).normalized()};
const Vector slope_there(1.1, 1.4, 3.3);
constexpr double angle_there = 0.7;

/// Tangent, y and z of a section.
std::array<Vector, 3> triad(const Vector& s, double phi) {
  const Vector t = s.normalized(), y = reference.direction<double>(s, phi);
  return {t, y, t.cross(y)};
}

/// How a section turns as its slope changes by ds and its angle by dphi, by differences.
Vector turned(const Vector& ds, double dphi) {
  constexpr double step = 1e-6;
  const auto before = triad(slope_there - step * ds, angle_there - step * dphi),
             behind = triad(slope_there + step * ds, angle_there + step * dphi), now = triad(slope_there, angle_there);
  Vector sum = Vector::Zero();
  for (std::size_t i = 0; i < 3; ++i) sum += now[i].cross(behind[i] - before[i]) / (4 * step);
  return sum;
}

class Moments : public testing::TestWithParam<bool> {
 protected:
  SectionMoment moment_{0, Vector(0.3, -0.5, 0.9), GetParam(), {}};
  static constexpr double size_ = 1.7;
};

TEST_P(Moments, DoTheWorkOfAMomentOnATriad) {
  const auto force = moment_force<double>(moment_, size_, reference, slope_there, angle_there);
  const auto now = triad(slope_there, angle_there);
  Vector m = size_ * moment_.direction;
  if (GetParam()) m = Vector(now[0] * m[0] + now[1] * m[1] + now[2] * m[2]);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(force.on_slope[c], m.dot(turned(Vector::Unit(c), 0)), 1e-9);
  EXPECT_NEAR(force.on_angle, m.dot(turned(Vector::Zero(), 1)), 1e-9);
}

TEST_P(Moments, HaveTheTangentOfDifferences) {
  constexpr double step = 1e-6;
  const Eigen::Matrix4d tangent = moment_tangent(moment_, size_, reference, slope_there, angle_there);
  for (int c = 0; c < 4; ++c) {
    const Vector ds = c < 3 ? Vector(step * Vector::Unit(c)) : Vector(Vector::Zero());
    const double dphi = c < 3 ? 0 : step;
    const auto before = moment_force<double>(moment_, size_, reference, slope_there - ds, angle_there - dphi),
               behind = moment_force<double>(moment_, size_, reference, slope_there + ds, angle_there + dphi);
    const Vector by = (behind.on_slope - before.on_slope) / (2 * step);
    for (int r = 0; r < 3; ++r) EXPECT_NEAR(tangent(r, c), by[r], 1e-9);
    EXPECT_NEAR(tangent(3, c), (behind.on_angle - before.on_angle) / (2 * step), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(InSpace, Moments, testing::Bool(),
                         [](const auto& of) { return of.param ? std::string("ThatFollow") : std::string("ThatStay"); });

}  // namespace
}  // namespace vlbeam::test
