// A state as a chain, and a chain as a state.
#include <span>

#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

template <int D>
void CurrentBeam<D>::write_state(const ChainState<D>& chain, const Eigen::VectorXd& old, Eigen::VectorXd& y) const {
  y.setZero(dofs_.state());
  y.head(dofs_.mark()) = Eigen::Map<const Eigen::VectorXd>(chain.q.data(), dofs_.mark());
  y.segment(coordinates(), dofs_.mark()) = Eigen::Map<const Eigen::VectorXd>(chain.rate.data(), dofs_.mark());
  write_joints(chain, y);
  for (std::size_t i = 0; i < free_masses_.size(); ++i) {
    y.segment<D>(free_mass_at(i)) = chain.free_masses[i].r;
    y.segment<D>(coordinates() + free_mass_at(i)) = chain.free_masses[i].v;
  }
  if (loose_) {
    y[dofs_.mark()] = chain.loose->x;
    y[coordinates() + dofs_.mark()] = chain.loose->rate;
  }
  const Eigen::Index balance = dofs_.balance.count(), before = (old.size() - balance) / 2;
  if (old.size() > 0) y.tail(balance) = old.tail(balance);
  if (!unknowns_) return;
  const double* const were = old.size() > 0 ? old.data() + before - unknowns_->count() : nullptr;
  unknowns_->write(chain, were, were == nullptr ? nullptr : were + before, y.data(), y.data() + coordinates());
}

template <int D>
void CurrentBeam<D>::write_nodes(const ChainState<D>& chain, Eigen::VectorXd& y) const {
  const Eigen::Index first = Eigen::Index{node_size<D>} * chain.part.before, nodal = std::ssize(chain.q);
  const Eigen::Index count = coordinates(), before = (y.size() - dofs_.balance.count()) / 2;
  if (count != before) {  // what stands behind these nodes stands elsewhere now
    const Eigen::Index behind = count - first - nodal;
    Eigen::VectorXd moved(dofs_.state());
    for (const Eigen::Index half : {0, 1}) {
      moved.segment(half * count, first) = y.segment(half * before, first);
      moved.segment((half + 1) * count - behind, behind) = y.segment((half + 1) * before - behind, behind);
    }
    moved.tail(dofs_.balance.count()) = y.tail(dofs_.balance.count());
    y.swap(moved);
  }
  y.segment(first, nodal) = Eigen::Map<const Eigen::VectorXd>(chain.q.data(), nodal);
  y.segment(count + first, nodal) = Eigen::Map<const Eigen::VectorXd>(chain.rate.data(), nodal);
  write_joints(chain, y);
}

template <int D>
void CurrentBeam<D>::write_joints(const ChainState<D>& chain, Eigen::VectorXd& y) const {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const JointPlace& place = places_[i];
    const auto& joint = chain.joints[i];
    y[place.mark] = chain.mesh.x[static_cast<std::size_t>(joint.node)];
    y[coordinates() + place.mark] = joint.rate;
    if (place.behind < 0) continue;
    y.segment<D>(place.behind) = joint.kink->slope;
    y.segment<D>(coordinates() + place.behind) = joint.kink->rate;
  }
}

template <int D>
void CurrentBeam<D>::write_chain(const Eigen::VectorXd& y, double t, const BeamPart& part,
                                 ChainState<D>& result) const {
  const int first = part.before, last = mesh_.last() - part.behind;
  const auto take = [&](const auto& entries, std::ptrdiff_t size, int from, int to, auto& taken) {
    taken.assign(entries.begin() + size * from, entries.begin() + size * to);
  };
  result.part = part;
  take(mesh_.x, 1, first, last + 1, result.mesh.x);
  take(mesh_.weights, 1, first, last, result.mesh.weights);
  result.mark_rates.clear();
  if (prescribed_) {
    move_nodes(t);
    for (std::size_t k = 0; k < mesh_.x.size(); ++k) {
      result.mesh.x[k] = prescribed_->marks()[k].value;
      result.mark_rates.push_back(prescribed_->marks()[k].rate);
    }
  }
  take(std::span(y.data(), y.data() + dofs_.mark()), node_size<D>, first, last + 1, result.q);
  take(std::span(y.data() + coordinates(), y.data() + coordinates() + dofs_.mark()), node_size<D>, first, last + 1,
       result.rate);
  result.rest.clear();
  if (!rest_.empty()) take(rest_, node_size<D>, first, last + 1, result.rest);
  result.rest_curve = model_.rest.get();
  result.joints.clear();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const JointPlace& place = places_[i];
    const int node = place.node - first;
    result.mesh.x[static_cast<std::size_t>(node)] = y[place.mark];
    auto& joint = result.joints.emplace_back();
    joint = {
        .node = node, .rate = y[coordinates() + place.mark], .index = joints_[i].index, .touches = joints_[i].touches};
    if (place.behind >= 0) joint.kink = {y.segment<D>(place.behind), y.segment<D>(coordinates() + place.behind)};
    if (!result.curved_at_rest()) continue;
    const auto at_joint = model_.rest->derivatives(y[place.mark]);
    position<D>(result.rest.data(), node) = at_joint[0];
    slope<D>(result.rest.data(), node) = at_joint[1];
  }
  for (int k = 0; prescribed_ && result.curved_at_rest() && k <= mesh_.last(); ++k) {
    const auto at_node = model_.rest->derivatives(result.mesh.x[static_cast<std::size_t>(k)]);
    position<D>(result.rest.data(), k) = at_node[0];
    slope<D>(result.rest.data(), k) = at_node[1];
  }
  result.free_masses.clear();
  for (std::size_t i = 0; i < free_masses_.size(); ++i) {
    const Eigen::Index at = free_mass_at(i);
    result.free_masses.push_back({free_masses_[i], y.segment<D>(at), y.segment<D>(coordinates() + at)});
  }
  result.loose.reset();
  if (unknowns_) unknowns_->read(y.data(), y.data() + coordinates(), result);
  if (loose_) loose_->write(result, y[dofs_.mark()], y[coordinates() + dofs_.mark()]);
}

template <int D>
void CurrentBeam<D>::take_rates(const Eigen::VectorXd& y, ChainState<D>& chain) const {
  const double* const rate = y.data() + coordinates();
  const double* const first = rate + Eigen::Index{node_size<D>} * chain.part.before;
  chain.rate.assign(first, first + std::ssize(chain.q));
  for (std::size_t i = 0; i < places_.size(); ++i) {
    chain.joints[i].rate = rate[places_[i].mark];
    if (places_[i].behind >= 0) chain.joints[i].kink->rate = y.segment<D>(coordinates() + places_[i].behind);
  }
  for (std::size_t i = 0; i < free_masses_.size(); ++i) {
    chain.free_masses[i].v = y.segment<D>(coordinates() + free_mass_at(i));
  }
  if (loose_) chain.loose->rate = rate[dofs_.mark()];
  if (unknowns_) unknowns_->read(y.data(), rate, chain);
}

template <int D>
std::optional<typename CurrentBeam<D>::MassMotion> CurrentBeam<D>::mass_motion(const Eigen::VectorXd& y,
                                                                               int index) const {
  const auto at = [&](Eigen::Index place) {
    return MassMotion{y.segment<D>(place), y.segment<D>(coordinates() + place)};
  };
  if (loose_ && index == 0) {
    const auto place = loose_->place(y.data(), y.data() + coordinates());
    return MassMotion{place.r, place.v};
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (joints_[i].index == index) return at(Eigen::Index{node_size<D>} * places_[i].node);
  }
  for (std::size_t i = 0; i < free_masses_.size(); ++i) {
    if (free_masses_[i] == index) return at(free_mass_at(i));
  }
  return std::nullopt;
}

template void CurrentBeam<2>::write_state(const ChainState<2>&, const Eigen::VectorXd&, Eigen::VectorXd&) const;
template void CurrentBeam<2>::write_joints(const ChainState<2>&, Eigen::VectorXd&) const;
template void CurrentBeam<2>::write_nodes(const ChainState<2>&, Eigen::VectorXd&) const;
template void CurrentBeam<2>::write_chain(const Eigen::VectorXd&, double, const BeamPart&, ChainState<2>&) const;
template void CurrentBeam<2>::take_rates(const Eigen::VectorXd&, ChainState<2>&) const;
template std::optional<CurrentBeam<2>::MassMotion> CurrentBeam<2>::mass_motion(const Eigen::VectorXd&, int) const;
template void CurrentBeam<3>::write_state(const ChainState<3>&, const Eigen::VectorXd&, Eigen::VectorXd&) const;
template void CurrentBeam<3>::write_joints(const ChainState<3>&, Eigen::VectorXd&) const;
template void CurrentBeam<3>::write_nodes(const ChainState<3>&, Eigen::VectorXd&) const;
template void CurrentBeam<3>::write_chain(const Eigen::VectorXd&, double, const BeamPart&, ChainState<3>&) const;
template void CurrentBeam<3>::take_rates(const Eigen::VectorXd&, ChainState<3>&) const;
template std::optional<CurrentBeam<3>::MassMotion> CurrentBeam<3>::mass_motion(const Eigen::VectorXd&, int) const;

}  // namespace vlbeam
