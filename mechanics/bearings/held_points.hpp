#pragma once

#include <utility>
#include <vector>

#include "mechanics/motion/system/room.hpp"

namespace vlbeam {

/// A material point that stays where it is along some directions of length 1, across each other: a pin along all, a
/// roller across the beam.
template <int D>
struct HeldPoint {
  double x;  ///< its material coordinate [m]
  Vec<double, D> place;
  std::vector<Vec<double, D>> directions;
};

/// Points of the beam that bearings hold. They need no node: a joint passes over them, and while it is in the same
/// element as one of them this element bends as a cubic does, without the jump in the shear force there.
template <int D>
class HeldPoints final : public Room<D> {
 public:
  explicit HeldPoints(std::vector<HeldPoint<D>> points) : points_(std::move(points)) {}

  void add_links(const CurrentBeam<D>& /*beam*/, std::vector<BeamLink<D>>& links) const override {
    for (const HeldPoint<D>& point : points_) {
      for (const Vec<double, D>& along : point.directions) {
        links.push_back(BeamLink<D>::holding(point.x, point.place, along));
      }
    }
  }

 private:
  std::vector<HeldPoint<D>> points_;
};

}  // namespace vlbeam
