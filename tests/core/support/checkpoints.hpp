#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "scene/simulate.hpp"

namespace vlbeam::test {

/// A run that goes on from its last checkpoint, behind an event, ends with the same digits.
inline void expect_to_go_on(const Scene& scene, double every) {
  std::vector<Checkpoint> kept;
  Checkpoints checkpoints;
  checkpoints.every = every;
  checkpoints.keep = [&kept](const Checkpoint& at) { kept.push_back(at); };
  const RunResult whole = simulate(scene, {}, &checkpoints);
  ASSERT_EQ(whole.status, RunStatus::completed) << whole.failure;
  ASSERT_GE(kept.size(), 2U);
  EXPECT_GE(kept.back().past.size(), 1U);
  Checkpoints from;
  from.from = kept.back();
  const RunResult rest = simulate(scene, {}, &from);
  EXPECT_EQ(rest.samples.back().end, whole.samples.back().end);
  EXPECT_EQ(rest.samples.back().angular_momentum, whole.samples.back().angular_momentum);
  EXPECT_EQ(rest.samples.back().joint_position, whole.samples.back().joint_position);
}

}  // namespace vlbeam::test
