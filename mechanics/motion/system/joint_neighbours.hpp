#pragma once

#include <cmath>
#include <limits>

#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

/// A joint on the beam between the nodes next to it, as guards see it.
template <int D>
struct JointNeighbours {
  using Mark = typename CurrentBeam<D>::MarkMotion;

  int node;
  bool to_end, to_start;           ///< the next node is an end of the beam
  bool joint_ahead, joint_behind;  ///< or another joint
  Mark here, low, high;            ///< material coordinates, with their rates
  double behind = here.x - low.x;  ///< [m]
  double ahead = high.x - here.x;  ///< [m]

  JointNeighbours(const CurrentBeam<D>& beam, std::size_t which, const Eigen::VectorXd& y, double t)
      : node(beam.places()[which].node),
        to_end(node + 1 == beam.mesh().last()),
        to_start(node == 1),
        joint_ahead(beam.at_joint(node + 1)),
        joint_behind(beam.at_joint(node - 1)),
        here(beam.mark_motion(which, y, t)),
        low(joint_behind ? beam.mark_motion(which - 1, y, t) : Mark{beam.mark_of(node - 1, y.data()), 0}),
        high(joint_ahead ? beam.mark_motion(which + 1, y, t) : Mark{beam.mark_of(node + 1, y.data()), 0}) {}
};

/// An end through which the beam is fed, and the node next to it.
template <int D>
struct FeedNeighbour {
  using Mark = typename CurrentBeam<D>::MarkMotion;

  bool at_start;
  int next;
  bool joint_next;
  Mark here, there;
  double length = at_start ? there.x - here.x : here.x - there.x;  ///< of the element between them [m]

  FeedNeighbour(const CurrentBeam<D>& beam, std::size_t which, const Eigen::VectorXd& y, double t)
      : at_start(beam.places()[which].node == 0),
        next(at_start ? 1 : beam.mesh().last() - 1),
        joint_next(beam.at_joint(next)),
        here(beam.mark_motion(which, y, t)),
        there(joint_next ? beam.mark_motion(at_start ? which + 1 : which - 1, y, t)
                         : Mark{beam.mark_of(next, y.data()), 0}) {}
};

/// What rounding leaves of differences of a beam's material coordinates [m].
inline double rounding_of(const Mesh& mesh) {
  return 4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(mesh.x.front()), std::abs(mesh.x.back()));
}

}  // namespace vlbeam
