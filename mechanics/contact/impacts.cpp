#include "mechanics/contact/impacts.hpp"

#include <string>

#include "core/error.hpp"
#include "mechanics/contact/contact_room.hpp"
#include "mechanics/motion/system/event_limits.hpp"

namespace vlbeam {
namespace {

using namespace event_limits;

constexpr double rounding = 1e-9;  // of the largest momentum of an impact

}  // namespace

template <int D>
void Impacts<D>::collide(const std::vector<Contact>& contacts, Eigen::VectorXd& y, double t) {
  const auto elements = beam_.masses_at(y, t);
  auto rate = y.segment(beam_.coordinates(), beam_.coordinates());
  std::vector<Contact> bearing = contacts;                // what rests pushes, but does not pull
  const std::vector<BeamLink<D>> blocks = links_.tied();  // they push and pull
  const auto tied = static_cast<Eigen::Index>(blocks.size());
  while (!bearing.empty()) {
    std::vector<BeamLink<D>> links = blocks;
    links.insert(links.end(), bearing.begin(), bearing.end());
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(links.size())), after = rate;
    for (std::size_t i = 0; i < bearing.size(); ++i) {
      const double restitution = bearing[i].rests ? 0 : bearing[i].impact.restitution;
      wanted[tied + static_cast<Eigen::Index>(i)] = -restitution * contacts_.gap(bearing[i], y).rate;
    }
    const auto momenta = mass_.press(links, elements, y.data(), wanted, after.data());
    if (!momenta) throw ComputationFailed("joints strike each other that have no inertia", t);
    const double pull = -rounding * momenta->cwiseAbs().maxCoeff();
    const auto pulls = [&](std::size_t i) {
      return bearing[i].rests && (*momenta)[tied + static_cast<Eigen::Index>(i)] < pull;
    };
    std::size_t pulled = 0;
    while (pulled < bearing.size() && !pulls(pulled)) ++pulled;
    if (pulled < bearing.size()) {
      contacts_.open(bearing[pulled], y);
      bearing.erase(bearing.begin() + static_cast<std::ptrdiff_t>(pulled));
      continue;
    }
    const double work = mass_.work_of_prescribed(links, *momenta, elements, y.data(), rate.data(), after - rate);
    beam_.dofs().balance.add({.supports = work}, y);
    rate = after;
    return;
  }
}

template <int D>
void Impacts<D>::strike(Eigen::VectorXd& y, double t) {
  const double unit = beam_.model().length_control.standard_length;
  std::vector<Contact> bearing;  // what rests bears what strikes
  for (Contact contact : contacts_.all()) {
    const Gap gap = contacts_.gap(contact, y);
    const bool strikes = gap.distance <= contact.distance + same_instant * unit && gap.rate < 0;
    if (!strikes && !contact.rests) continue;
    if (!contact.rests) contact.distance = gap.distance;
    if (contact.impact.law == AtSupport::rest) contact.impact.restitution = 0;
    bearing.push_back(contact);
  }
  const Eigen::VectorXd before = y;
  const auto stays = [](const Contact& contact) { return !contact.rests && contact.impact.restitution == 0; };
  const auto collides = [&] {
    collide(bearing, y, t);
    for (const Contact& contact : bearing) {
      if (stays(contact)) contacts_.close(contact, y);
    }
  };
  collides();

  Eigen::VectorXd rates(y.size());
  accelerations_.rates(y, rates, t);
  bool lower = false;
  for (Contact& contact : bearing) {
    if (contact.rests || stays(contact)) continue;
    const Gap gap = contacts_.gap(contact, y);
    const double across = contact.difference(y.data() + beam_.coordinates()).squaredNorm() - gap.rate * gap.rate;
    const double falls =
        -gap.direction.dot(contact.difference(rates.data() + beam_.coordinates())) - across / gap.distance;
    if (!(falls > 0 && gap.rate * gap.rate < 2 * falls * least_bounce * unit)) continue;
    if (!room_of<ContactRoom<D>>(beam_.model())->joints_rest) comes_to_rest(contact, t);
    contact.impact.restitution = 0;
    lower = true;
  }
  if (!lower) return;
  y = before;
  collides();
}

template <int D>
void Impacts<D>::comes_to_rest(const Contact& contact, double t) const {
  const std::string first =
      "the sliding joint " + std::to_string(beam_.joint_index(contact.which)) + " comes to rest against ";
  throw ComputationFailed(
      first + (contact.support == 0
                   ? "the joint " + std::to_string(beam_.joint_index(contact.which + 1))
                   : std::string("the support at the beam's ") + (contact.support < 0 ? "start" : "end")),
      t);
}

template class Impacts<2>;
template class Impacts<3>;

}  // namespace vlbeam
