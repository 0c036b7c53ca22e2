#pragma once

namespace vlbeam {

/// What can happen to a beam with a moving node.
enum class EventType {
  segment_merge,  ///< the element behind it is cut, two ahead of it are merged
  separation,     ///< it leaves the beam
  reweighting,    ///< transported weights of an element at it are renewed before one of them is lost
};

}  // namespace vlbeam
