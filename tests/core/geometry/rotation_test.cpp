#include "core/geometry/rotation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace vlbeam::test {
namespace {

TEST(BestRotation, TakesPointsOntoOthers) {
  Eigen::MatrixXd from(2, 3);
  from << 0, 1, 3, 0, 0.5, -1;
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  const Eigen::MatrixXd to = (turn * from).colwise() + Eigen::Vector2d(3, -1);
  EXPECT_LE((best_rotation<2>(from, to) - turn).norm(), 1e-14);
}

/// The decomposition of what is not finite may never end.
TEST(BestRotation, RefusesWhatIsNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Eigen::MatrixXd from = Eigen::MatrixXd::Random(3, 4), to = from;
    to(1, 2) = bad;
    EXPECT_THROW(best_rotation<3>(from, to), std::domain_error);
  }
}

}  // namespace
}  // namespace vlbeam::test
