#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

/// The beam before its last event, for what is known there and wanted on the beam after it: accelerations that go on.
template <int D>
class EventMap {
 public:
  /// A beam, or the part of it that an event has changed, with where its state has what.
  struct Beam {
    ChainState<D> chain;
    std::vector<JointPlace> places;
    DofMap<D> layout;
  };
  /// After an event of the mesh: the beam as it was before it.
  void remember(Beam before) { before_ = std::move(before); }
  /// Forgets it, too, and gives its chain away, whose memory the next event can use.
  ChainState<D> release() {
    ChainState<D> chain = before_ ? std::move(before_->chain) : ChainState<D>{};
    forget();
    return chain;
  }
  /// After an event behind which nothing goes on as before.
  void forget() { before_.reset(); }

  /// Puts the accelerations `a`, an array of coordinates of the beam before the event that may be longer, in the place
  /// of those in `to`, of the beam after it: of nodes that are new, the field's there. Angles of new nodes stay as they
  /// are in `to`. Returns false where they do not go on.
  bool carry(const CurrentBeam<D>& beam, const Eigen::VectorXd& a, Eigen::VectorXd& to) const;

 private:
  /// Puts the accelerations of node `node` of the beam, one of those that the event may have changed, in its place.
  void carry_node(const CurrentBeam<D>& beam, int node, const Eigen::VectorXd& a, Eigen::VectorXd& to) const;
  /// Acceleration of the material point x.
  Vec<double, D> at(double x, WeightTransport transport, const Eigen::VectorXd& a) const;

  std::optional<Beam> before_;
};

extern template class EventMap<2>;
extern template class EventMap<3>;

}  // namespace vlbeam
