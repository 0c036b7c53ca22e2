#pragma once

#include "mechanics/flow/steady_flow.hpp"

namespace vlbeam::moving_string {

/// Of the motion about a straight beam in space between two pins that of one transverse plane: along and across nothing
/// couples, and it is every third coordinate, the pins' positions left out.
inline LinearMotion transverse(const LinearFlows& flows) {
  const LinearMotion& all = flows.axis;
  const Eigen::Index n = all.M.rows() / 3;
  const auto plane = Eigen::seqN(Eigen::Index{1}, n, Eigen::Index{3});
  return {all.M(plane, plane), all.C(plane, plane), all.K(plane, plane)};
}

}  // namespace vlbeam::moving_string
