#include "tools/judged.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "tests/folders.hpp"

namespace vlbeam::test {
namespace {

const std::filesystem::path studies = source_folder() / "studies";

TEST(Judged, IsZeroWhereTheJudgeIsAndGrowsWithTheDistance) {
  const Judged judged = judged_at(studies, "falling_beam");
  EXPECT_EQ(judged.t, 0.45);  // its last one
  ASSERT_TRUE(judged.joint && judged.mass && judged.end);
  EXPECT_GT(judged.uncertainty, 0);
  EXPECT_LT(judged.uncertainty, 1e-4);
  Sample sample;
  sample.joint_position = judged.joint;
  sample.mass_position = judged.mass;
  sample.end = *judged.end;
  EXPECT_EQ(judged.error(sample), 0);
  sample.end[1] += 3e-3;
  EXPECT_NEAR(judged.error(sample), 3e-3, 1e-15);
  (*sample.mass_position)[0] -= 4e-3;
  EXPECT_NEAR(judged.error(sample), 4e-3, 1e-15);
  *sample.joint_position += 5e-3;
  EXPECT_NEAR(judged.error(sample), 5e-3, 1e-15);
  sample.joint_position.reset();
  EXPECT_TRUE(std::isnan(judged.error(sample)));
}

TEST(Judged, DoesNotAskForAnEndThatIsHeld) { EXPECT_FALSE(judged_at(studies, "semicircle", 0.4).end); }

TEST(Judged, KnowsItsCasesAndTimesOnly) {
  EXPECT_THROW(judged_at(studies, "no_such_case", 0.4), InvalidInput);
  EXPECT_THROW(judged_at(studies, "semicircle", 0.41), InvalidInput);
}

}  // namespace
}  // namespace vlbeam::test
