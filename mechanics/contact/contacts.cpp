#include "mechanics/contact/contacts.hpp"

#include "mechanics/contact/contact_room.hpp"
#include "mechanics/motion/system/event_limits.hpp"

namespace vlbeam {
namespace {

std::size_t side_of(int support) { return support < 0 ? 0 : 1; }

}  // namespace

template <int D>
std::vector<NodeContact<D>> Contacts<D>::all() const {
  const BeamModel<D>& model = beam_.model();
  const double touching = model.contact_distance * model.length_control.standard_length;
  std::vector<Contact> found;
  for (std::size_t i = 0; i < beam_.places().size(); ++i) {
    if (beam_.feeds(i)) continue;
    const int node = beam_.places()[i].node;
    const auto add = [&](int behind, int support, const Impact& impact) {
      const auto& touch = beam_.touch(i, side_of(support));
      const double distance = touch.distance > 0 ? touch.distance : touching;
      found.push_back({{behind, behind + 1, distance, {}, {}}, i, support, impact, touch.rests});
    };
    const Impact at_support = impact_at_support(model, beam_.joint_index(i));
    const bool strikes = at_support.law != AtSupport::stop && model.length_control.end_merge == 0;
    if (strikes && node == 1 && !model.start_releases) add(0, -1, at_support);
    if (!model.joints_stop_each_other() && beam_.at_joint(node + 1) && !beam_.feeds(i + 1)) {
      add(node, 0, room_of<ContactRoom<D>>(model)->at_meeting);
    }
    if (strikes && node + 1 == beam_.mesh().last() && !model.end_releases) add(node, 1, at_support);
  }
  return found;
}

template <int D>
typename Contacts<D>::Gap Contacts<D>::gap(const Contact& contact, const Eigen::VectorXd& y) const {
  const Vector apart = contact.difference(y.data()), direction = apart.normalized();
  return {apart.norm(), direction.dot(contact.difference(y.data() + beam_.coordinates())), direction};
}

template <int D>
void Contacts<D>::adopt() {
  resting_ = all();
  std::erase_if(resting_, [](const Contact& contact) { return !contact.rests; });
  links_.set_resting({resting_.begin(), resting_.end()});
}

template <int D>
void Contacts<D>::open(const Contact& contact, const Eigen::VectorXd& y) {
  const double clear =
      gap(contact, y).distance - event_limits::clearance * beam_.model().length_control.standard_length;
  beam_.set_touch(contact.which, side_of(contact.support), {clear, false});
  adopt();
}

template <int D>
void Contacts<D>::close(const Contact& contact, const Eigen::VectorXd& y) {
  beam_.set_touch(contact.which, side_of(contact.support), {gap(contact, y).distance, true});
  adopt();
}

template class Contacts<2>;
template class Contacts<3>;

}  // namespace vlbeam
