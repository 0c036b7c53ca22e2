// Joints, and the supports at the ends, that strike each other or rest against each other.
#include <algorithm>

#include "core/error.hpp"
#include "core/geometry/dense.hpp"
#include "core/system/beam_system.hpp"
#include "core/system/event_limits.hpp"
#include "core/system/prescribed_motion.hpp"

namespace vlbeam {
namespace {

using namespace event_limits;

constexpr double rounding = 1e-9;  // of the largest momentum of an impact

}  // namespace

template <int D>
std::vector<typename BeamSystem<D>::Contact> BeamSystem<D>::contacts() const {
  std::vector<Contact> found;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (feeds(i)) continue;
    const int node = places_[i].node;
    const auto add = [&](int behind, int support, const Impact& impact) {
      const auto& touch = touches_[i][support < 0 ? 0 : 1];
      found.push_back(
          {{behind, behind + 1, touch.distance > 0 ? touch.distance : touching()}, i, support, impact, touch.rests});
    };
    const Impact& at_support = joint(i).at_support;
    const bool strikes = at_support.law != AtSupport::stop && model_.length_control.end_merge == 0;
    if (strikes && node == 1 && !model_.start_releases) add(0, -1, at_support);
    if (model_.at_meeting.law != AtSupport::stop && at_joint(node + 1) && !feeds(i + 1))
      add(node, 0, model_.at_meeting);
    if (strikes && node + 1 == mesh_.last() && !model_.end_releases) add(node, 1, at_support);
  }
  return found;
}

template <int D>
typename BeamSystem<D>::Gap BeamSystem<D>::gap(const Contact& contact, const Eigen::VectorXd& y) const {
  const Vector apart = contact.difference(y.data()), direction = apart.normalized();
  return {apart.norm(), direction.dot(contact.difference(y.data() + coordinates())), direction};
}

template <int D>
void BeamSystem<D>::find_resting() {
  resting_ = contacts();
  std::erase_if(resting_, [](const Contact& contact) { return !contact.rests; });
  links_.clear();
  for (const Tie& tie : ties_) {
    const int behind = place_of(tie.behind).node, ahead = place_of(tie.ahead).node;
    for (int c = 0; c < D; ++c) links_.push_back({behind, ahead, tie.apart[c], Vector(Vector::Unit(c))});
  }
  links_.insert(links_.end(), resting_.begin(), resting_.end());
  link_forces_.setZero(static_cast<Eigen::Index>(links_.size()));
}

template <int D>
void BeamSystem<D>::tie_blocks(const double* q) {
  for (const std::vector<int>& block : model_.blocks) {
    for (std::size_t k = 1; k < block.size(); ++k) {
      const auto place = [&](int joint) { return position<D>(q, place_of(joint).node); };
      ties_.push_back({block[0], block[k], place(block[k]) - place(block[0])});
    }
  }
  find_resting();
}

template <int D>
void BeamSystem<D>::open_contact(const Contact& contact, const Eigen::VectorXd& y) {
  const double clear = gap(contact, y).distance - clearance * model_.length_control.standard_length;
  touches_[contact.which][contact.support < 0 ? 0 : 1] = {clear, false};
  find_resting();
}

template <int D>
void BeamSystem<D>::close_contact(const Contact& contact, const Eigen::VectorXd& y) {
  touches_[contact.which][contact.support < 0 ? 0 : 1] = {gap(contact, y).distance, true};
  find_resting();
}

template <int D>
std::optional<Eigen::VectorXd> BeamSystem<D>::press(const std::vector<Link>& links, const JointElements& elements,
                                                    const double* q, const Eigen::VectorXd& wanted, double* a) const {
  const auto count = static_cast<Eigen::Index>(links.size());
  Eigen::MatrixXd answers = Eigen::MatrixXd::Zero(coordinates(), count), by(count, count);  // M^-1 L, L^T M^-1 L
  Eigen::VectorXd lacking = wanted;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Link& link = links[static_cast<std::size_t>(i)];
    const Vector line = link.line(q);
    position<D>(answers.col(i).data(), link.behind) = -line;
    position<D>(answers.col(i).data(), link.ahead) = line;
    if (!solve_mass_apart(elements, q, answers.col(i).data())) return std::nullopt;
    lacking[i] -= line.dot(link.difference(a));
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const Link& link = links[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < count; ++k) by(i, k) = link.line(q).dot(link.difference(answers.col(k).data()));
  }
  const Eigen::VectorXd forces = solve_pivoting(by, lacking);
  Eigen::Map<Eigen::VectorXd>(a, coordinates()) += answers * forces;
  return forces;
}

template <int D>
double BeamSystem<D>::work_of_prescribed(const std::vector<Link>& links, const Eigen::VectorXd& forces,
                                         const JointElements& elements, const double* q, const double* rate,
                                         const Eigen::VectorXd& change) const {
  Eigen::VectorXd all(coordinates());
  multiply_mass(elements, q, change.data(), all.data());
  double work = all.dot(Eigen::Map<const Eigen::VectorXd>(rate, coordinates()));
  for (std::size_t i = 0; i < links.size(); ++i) {
    work -= forces[static_cast<Eigen::Index>(i)] * links[i].line(q).dot(links[i].difference(rate));
  }
  return work;
}

template <int D>
Eigen::VectorXd BeamSystem<D>::bending_in(const double* rate) const {
  Eigen::VectorXd wanted(static_cast<Eigen::Index>(links_.size()));
  for (std::size_t i = 0; i < links_.size(); ++i) wanted[static_cast<Eigen::Index>(i)] = -links_[i].turning(rate);
  return wanted;
}

template <int D>
void BeamSystem<D>::comes_to_rest(const Contact& contact, double t) const {
  const std::string first = "the sliding joint " + std::to_string(index_[contact.which]) + " comes to rest against ";
  throw ComputationFailed(first + (contact.support == 0 ? "the joint " + std::to_string(index_[contact.which + 1])
                                                        : std::string("the support at the beam's ") +
                                                              (contact.support < 0 ? "start" : "end")),
                          t);
}

template <int D>
void BeamSystem<D>::collide(const std::vector<Contact>& contacts, Eigen::VectorXd& y, double t) {
  const JointElements elements = elements_at(y, t);
  auto rate = y.segment(coordinates(), coordinates());
  std::vector<Contact> bearing = contacts;  // what rests pushes, but does not pull
  const auto tied = static_cast<std::ptrdiff_t>(links_.size() - resting_.size());  // blocks push and pull
  while (!bearing.empty()) {
    std::vector<Link> links(links_.begin(), links_.begin() + tied);
    links.insert(links.end(), bearing.begin(), bearing.end());
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(links.size())), after = rate;
    for (std::size_t i = 0; i < bearing.size(); ++i) {
      const double restitution = bearing[i].rests ? 0 : bearing[i].impact.restitution;
      wanted[tied + static_cast<Eigen::Index>(i)] = -restitution * gap(bearing[i], y).rate;
    }
    const auto momenta = press(links, elements, y.data(), wanted, after.data());
    if (!momenta) throw ComputationFailed("joints strike each other that have no inertia", t);
    const double pull = -rounding * momenta->cwiseAbs().maxCoeff();
    const auto pulls = [&](std::size_t i) {
      return bearing[i].rests && (*momenta)[tied + static_cast<Eigen::Index>(i)] < pull;
    };
    std::size_t pulled = 0;
    while (pulled < bearing.size() && !pulls(pulled)) ++pulled;
    if (pulled < bearing.size()) {
      open_contact(bearing[pulled], y);
      bearing.erase(bearing.begin() + static_cast<std::ptrdiff_t>(pulled));
      continue;
    }
    const double work = work_of_prescribed(links, *momenta, elements, y.data(), rate.data(), after - rate);
    layout_.tallies.add({.supports = work}, y);
    rate = after;
    return;
  }
}

template <int D>
void BeamSystem<D>::strike(Eigen::VectorXd& y, double t) {
  const double unit = model_.length_control.standard_length;
  std::vector<Contact> bearing;  // what rests bears what strikes
  for (Contact contact : contacts()) {
    const Gap gap = this->gap(contact, y);
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
      if (stays(contact)) close_contact(contact, y);
    }
  };
  collides();

  Eigen::VectorXd rates(y.size());
  rhs(y, rates, t);
  bool lower = false;
  for (Contact& contact : bearing) {
    if (contact.rests || stays(contact)) continue;
    const Gap gap = this->gap(contact, y);
    const double across = contact.difference(y.data() + coordinates()).squaredNorm() - gap.rate * gap.rate;
    const double falls = -gap.direction.dot(contact.difference(rates.data() + coordinates())) - across / gap.distance;
    if (!(falls > 0 && gap.rate * gap.rate < 2 * falls * least_bounce * unit)) continue;
    if (!model_.joints_rest) comes_to_rest(contact, t);
    contact.impact.restitution = 0;
    lower = true;
  }
  if (!lower) return;
  y = before;
  collides();
}

template <int D>
Eigen::VectorXd BeamSystem<D>::forces_of_links(const Eigen::VectorXd& y, double t) const {
  Eigen::VectorXd exact = y;
  impose(exact, t);
  orient(t);
  const double *q = exact.data(), *rate = q + coordinates();
  Eigen::VectorXd a = Eigen::VectorXd::Zero(coordinates());
  JointElements elements;
  add_forces(q, rate, t, a.data(), elements);
  std::vector<JointMotion<D>> motions;
  for (std::size_t i = 0; i < places_.size(); ++i) motions.push_back(joint_motion(i, q, rate, t));
  std::optional<PrescribedMotion> pull;
  if (model_.driven()) pull.emplace(*this, elements, q, rate, a.data(), t);
  std::optional<Eigen::VectorXd> forces;
  if (solve_joints(elements, motions, a.data())) {
    if (pull) pull->complete(a.data());
    forces = press(links_, elements, q, bending_in(rate), a.data());
  }
  return forces.value_or(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(links_.size())));
}

template std::vector<BeamSystem<2>::Contact> BeamSystem<2>::contacts() const;
template BeamSystem<2>::Gap BeamSystem<2>::gap(const Contact&, const Eigen::VectorXd&) const;
template void BeamSystem<2>::strike(Eigen::VectorXd&, double);
template void BeamSystem<2>::find_resting();
template void BeamSystem<2>::tie_blocks(const double*);
template void BeamSystem<2>::comes_to_rest(const Contact&, double) const;
template void BeamSystem<2>::open_contact(const Contact&, const Eigen::VectorXd&);
template void BeamSystem<2>::close_contact(const Contact&, const Eigen::VectorXd&);
template void BeamSystem<2>::collide(const std::vector<Contact>&, Eigen::VectorXd&, double);
template std::optional<Eigen::VectorXd> BeamSystem<2>::press(const std::vector<Link>&, const JointElements&,
                                                             const double*, const Eigen::VectorXd&, double*) const;
template double BeamSystem<2>::work_of_prescribed(const std::vector<Link>&, const Eigen::VectorXd&,
                                                  const JointElements&, const double*, const double*,
                                                  const Eigen::VectorXd&) const;
template Eigen::VectorXd BeamSystem<2>::bending_in(const double*) const;
template std::vector<BeamSystem<3>::Contact> BeamSystem<3>::contacts() const;
template BeamSystem<3>::Gap BeamSystem<3>::gap(const Contact&, const Eigen::VectorXd&) const;
template void BeamSystem<3>::strike(Eigen::VectorXd&, double);
template void BeamSystem<3>::find_resting();
template void BeamSystem<3>::tie_blocks(const double*);
template void BeamSystem<3>::comes_to_rest(const Contact&, double) const;
template void BeamSystem<3>::open_contact(const Contact&, const Eigen::VectorXd&);
template void BeamSystem<3>::close_contact(const Contact&, const Eigen::VectorXd&);
template void BeamSystem<3>::collide(const std::vector<Contact>&, Eigen::VectorXd&, double);
template std::optional<Eigen::VectorXd> BeamSystem<3>::press(const std::vector<Link>&, const JointElements&,
                                                             const double*, const Eigen::VectorXd&, double*) const;
template double BeamSystem<3>::work_of_prescribed(const std::vector<Link>&, const Eigen::VectorXd&,
                                                  const JointElements&, const double*, const double*,
                                                  const Eigen::VectorXd&) const;
template Eigen::VectorXd BeamSystem<3>::bending_in(const double*) const;
template Eigen::VectorXd BeamSystem<2>::forces_of_links(const Eigen::VectorXd&, double) const;
template Eigen::VectorXd BeamSystem<3>::forces_of_links(const Eigen::VectorXd&, double) const;

}  // namespace vlbeam
