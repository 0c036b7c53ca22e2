#pragma once

namespace vlbeam {

/// What can happen to a beam with sliding joints, each of which sits on a moving node.
enum class EventType {
  segment_merge,  ///< the element behind it is cut, two ahead of it are merged
  segmentation,   ///< the element behind it is cut
  merging,        ///< two elements ahead of it are merged
  separation,     ///< it leaves the beam
  reweighting,    ///< transported weights of an element at it are renewed before one of them is lost
  end_merge,      ///< near the beam's end its node goes: the mass rides inside the last element
  end_cut,        ///< away from the end it gets a node again
  contact,        ///< a mass hits the support at the beam's end, or another joint
  lift_off,       ///< what has rested there leaves it
  passage,        ///< it passes over a point mass: nothing jumps but accelerations
};

}  // namespace vlbeam
