#pragma once

#include "mechanics/contact/impacts.hpp"
#include "mechanics/motion/system/event_source.hpp"

namespace vlbeam {

/// Joints strike each other, or supports at the ends, and lift off again where they rest.
template <int D>
class ContactEvents final : public EventSource<D> {
 public:
  explicit ContactEvents(const BeamInside<D>& inside)
      : beam_(inside.beam),
        links_(inside.links),
        accelerations_(inside.accelerations),
        contacts_(inside.beam, inside.links),
        impacts_(inside, contacts_) {}

  void adopt() override { contacts_.adopt(); }
  void add_guards(const Eigen::VectorXd& y, double t, Guards& guards) const override;
  std::vector<PendingEvent> due(const Guard& first, const Eigen::VectorXd& y, double t) const override;
  std::vector<MergedWeights> apply(const std::vector<PendingEvent>& dues, ChainState<D>& chain, Eigen::VectorXd& y,
                                   double t) override;

 private:
  enum Kind { strikes, lifts_off };

  CurrentBeam<D>& beam_;
  BeamLinks<D>& links_;
  Accelerations<D>& accelerations_;
  Contacts<D> contacts_;
  Impacts<D> impacts_;
};

extern template class ContactEvents<2>;
extern template class ContactEvents<3>;

}  // namespace vlbeam
