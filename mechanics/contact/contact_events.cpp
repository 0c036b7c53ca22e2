#include "mechanics/contact/contact_events.hpp"

#include "mechanics/contact/contact_room.hpp"
#include "mechanics/motion/system/event_limits.hpp"

namespace vlbeam {

template <int D>
void ContactEvents<D>::add_guards(const Eigen::VectorXd& y, double t, Guards& guards) const {
  const double unit = beam_.model().length_control.standard_length;
  const auto contacts = contacts_.all();
  Eigen::VectorXd forces;
  if (!contacts_.resting().empty()) forces = accelerations_.forces_of_links(y, t);
  auto rests = static_cast<Eigen::Index>(links_.tied().size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const int part = static_cast<int>(i);
    if (contacts[i].rests) {
      guards.push_back({lifts_off, part, -forces[rests++] / beam_.model().section.stiffness.EA});
      continue;
    }
    const auto gap = contacts_.gap(contacts[i], y);
    // beyond each other they are less than no distance apart
    const bool crossed = beam_.mark_of(contacts[i].ahead, y.data()) < beam_.mark_of(contacts[i].behind, y.data());
    const double side = crossed ? -1 : 1, rate = side * gap.rate;
    const double value = (contacts[i].distance - side * gap.distance) / unit;
    guards.push_back({.kind = strikes,
                      .part = part,
                      .value = rate > 0 ? value - event_limits::clearance : value,  // what parts is clear of each other
                      .rate = -rate / unit,
                      .room = contacts[i].distance / (2 * unit)});
  }
}

template <int D>
std::vector<PendingEvent> ContactEvents<D>::due(const Guard& first, const Eigen::VectorXd& y, double /*t*/) const {
  const auto which = static_cast<std::size_t>(first.part);
  const NodeContact<D> contact = contacts_.all()[which];
  const JointPlace& place = beam_.places()[contact.which];
  return {{.type = first.kind == strikes ? EventType::contact : EventType::lift_off,
           .which = which,
           .joint = beam_.joint_index(contact.which),
           .node = place.node,
           .x = y[place.mark],
           .observes_all = first.kind == strikes}};
}

template <int D>
std::vector<MergedWeights> ContactEvents<D>::apply(const std::vector<PendingEvent>& dues, ChainState<D>& chain,
                                                   Eigen::VectorXd& y, double t) {
  if (dues.front().type == EventType::contact) {
    impacts_.strike(y, t);
  } else {
    contacts_.open(contacts_.all()[dues.front().which], y);
  }
  chain = beam_.chain(y, t);
  return {{}};
}

template <int D>
void ContactRoom<D>::add_sources(const BeamInside<D>& inside, EventSources<D>& sources) const {
  sources.push_back(std::make_unique<ContactEvents<D>>(inside));
}

template class ContactEvents<2>;
template class ContactEvents<3>;
template class ContactRoom<2>;
template class ContactRoom<3>;

}  // namespace vlbeam
