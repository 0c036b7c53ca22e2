#include "mechanics/motion/system/beam_links.hpp"

#include <algorithm>

#include "mechanics/motion/system/event_limits.hpp"

namespace vlbeam {
namespace {

std::size_t side_of(int support) { return support < 0 ? 0 : 1; }

}  // namespace

template <int D>
std::vector<NodeContact<D>> BeamLinks<D>::contacts() const {
  const BeamModel<D>& model = beam_.model();
  const double touching = model.contact_distance * model.length_control.standard_length;
  std::vector<Contact> found;
  for (std::size_t i = 0; i < beam_.places().size(); ++i) {
    if (beam_.feeds(i)) continue;
    const int node = beam_.places()[i].node;
    const auto add = [&](int behind, int support, const Impact& impact) {
      const auto& touch = beam_.touch(i, side_of(support));
      const double distance = touch.distance > 0 ? touch.distance : touching;
      found.push_back({{behind, behind + 1, distance}, i, support, impact, touch.rests});
    };
    const Impact& at_support = beam_.joint(i).at_support;
    const bool strikes = at_support.law != AtSupport::stop && model.length_control.end_merge == 0;
    if (strikes && node == 1 && !model.start_releases) add(0, -1, at_support);
    if (model.at_meeting.law != AtSupport::stop && beam_.at_joint(node + 1) && !beam_.feeds(i + 1)) {
      add(node, 0, model.at_meeting);
    }
    if (strikes && node + 1 == beam_.mesh().last() && !model.end_releases) add(node, 1, at_support);
  }
  return found;
}

template <int D>
typename BeamLinks<D>::Gap BeamLinks<D>::gap(const Contact& contact, const Eigen::VectorXd& y) const {
  const Vector apart = contact.difference(y.data()), direction = apart.normalized();
  return {apart.norm(), direction.dot(contact.difference(y.data() + beam_.coordinates())), direction};
}

template <int D>
void BeamLinks<D>::adopt() {
  resting_ = contacts();
  std::erase_if(resting_, [](const Contact& contact) { return !contact.rests; });
  all_.clear();
  for (const Tie& tie : ties_) {
    const int behind = beam_.place_of(tie.behind).node, ahead = beam_.place_of(tie.ahead).node;
    for (int c = 0; c < D; ++c) all_.push_back({behind, ahead, tie.apart[c], Vector(Vector::Unit(c))});
  }
  all_.insert(all_.end(), resting_.begin(), resting_.end());
}

template <int D>
void BeamLinks<D>::tie_blocks(const double* q) {
  for (const std::vector<int>& block : beam_.model().blocks) {
    for (std::size_t k = 1; k < block.size(); ++k) {
      const auto place = [&](int joint) { return position<D>(q, beam_.place_of(joint).node); };
      ties_.push_back({block[0], block[k], place(block[k]) - place(block[0])});
    }
  }
  adopt();
}

template <int D>
bool BeamLinks<D>::in_block(int index) const {
  return std::ranges::any_of(ties_, [index](const Tie& tie) { return tie.behind == index || tie.ahead == index; });
}

template <int D>
void BeamLinks<D>::open(const Contact& contact, const Eigen::VectorXd& y) {
  const double clear =
      gap(contact, y).distance - event_limits::clearance * beam_.model().length_control.standard_length;
  beam_.set_touch(contact.which, side_of(contact.support), {clear, false});
  adopt();
}

template <int D>
void BeamLinks<D>::close(const Contact& contact, const Eigen::VectorXd& y) {
  beam_.set_touch(contact.which, side_of(contact.support), {gap(contact, y).distance, true});
  adopt();
}

template <int D>
Eigen::VectorXd BeamLinks<D>::bending_in(const double* rate) const {
  Eigen::VectorXd wanted(static_cast<Eigen::Index>(all_.size()));
  for (std::size_t i = 0; i < all_.size(); ++i) wanted[static_cast<Eigen::Index>(i)] = -all_[i].turning(rate);
  return wanted;
}

template class BeamLinks<2>;
template class BeamLinks<3>;

}  // namespace vlbeam
