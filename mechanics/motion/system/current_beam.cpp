#include "mechanics/motion/system/current_beam.hpp"

#include <algorithm>
#include <span>

#include "core/error.hpp"
#include "mechanics/motion/parts/acting_loads.hpp"
#include "mechanics/motion/parts/acting_point_masses.hpp"
#include "mechanics/motion/system/room.hpp"

namespace vlbeam {
namespace {

/// Puts the entries of a part, so many a node or an element, in the place of those that the whole has there.
template <class Entry>
void replace_part(const std::vector<Entry>& part, const BeamPart& where, std::ptrdiff_t size,
                  std::vector<Entry>& whole) {
  const auto first = whole.begin() + size * where.before, end = whole.end() - size * where.behind;
  const auto common = std::min(end - first, std::ssize(part));
  const auto next = std::copy_n(part.begin(), common, first);
  if (next == end) {
    whole.insert(next, part.begin() + common, part.end());
  } else {
    whole.erase(next, end);
  }
}

/// How many elements at either end of a beam, with the nodes `rest` of its rest shape if that is curved, stay as they
/// are: those outside of the part that a chain holds, and equal ones in it.
template <int D>
UnchangedElements unchanged_elements(const Mesh& mesh, const std::vector<double>& rest, const ChainState<D>& chain) {
  const Mesh& now = chain.mesh;
  const auto same = [&](int before, int after) {
    const auto i = static_cast<std::size_t>(before), k = static_cast<std::size_t>(after);
    const auto nodes_of = [](const std::vector<double>& nodal, int element) {
      return std::span(nodal).subspan(node_size<D> * static_cast<std::size_t>(element), 2 * node_size<D>);
    };
    return mesh.x[i] == now.x[k] && mesh.x[i + 1] == now.x[k + 1] && mesh.weights[i].w == now.weights[k].w &&
           (!chain.curved_at_rest() || std::ranges::equal(nodes_of(rest, before), nodes_of(chain.rest, after)));
  };
  const int first = chain.part.before, end = mesh.elements() - chain.part.behind, count = now.elements();
  const int common = std::min(end - first, count);
  int at_start = 0, at_end = 0;
  while (at_start < common && same(first + at_start, at_start)) ++at_start;
  while (at_end < common && same(end - 1 - at_end, count - 1 - at_end)) ++at_end;
  return {chain.part.before + at_start, chain.part.behind + at_end};
}

}  // namespace

template <int D>
CurrentBeam<D>::CurrentBeam(const BeamModel<D>& model, const ChainState<D>& chain) : BeamElements<D>(model) {
  for (const auto& room : model_.rooms) {
    if (!prescribed_) prescribed_ = room->prescribed_mesh(*this, chain.mesh.weights);
  }
  for (const auto& room : model_.rooms) {
    if (!unknowns_) unknowns_ = room->unknowns(*this, chain.mesh.x);
  }
  std::ranges::sort(model_.masses.points, {}, &PointMass::x);
  if (model_.loads.present()) acting_.push_back(std::make_shared<ActingLoads<D>>(model_.loads));
  if (model_.masses.present()) acting_.push_back(std::make_shared<ActingPointMasses<D>>(model_.masses));
  acting_.insert(acting_.end(), model_.parts.begin(), model_.parts.end());
  adopt(chain);
}

template <int D>
Eigen::VectorXd CurrentBeam<D>::start(const ChainState<D>& chain) {
  Eigen::VectorXd y;
  write_state(chain, {}, y);
  if (unknowns_) unknowns_->start(y.data(), y.data() + coordinates());
  supports_.anchor(y.data());
  return y;
}

template <int D>
void CurrentBeam<D>::adopt(const ChainState<D>& chain) {
  ++revision_;
  const UnchangedElements unchanged = mesh_.x.empty() ? UnchangedElements{} : unchanged_elements(mesh_, rest_, chain);
  replace_part(chain.mesh.x, chain.part, 1, mesh_.x);
  replace_part(chain.mesh.weights, chain.part, 1, mesh_.weights);
  if (chain.curved_at_rest()) replace_part(chain.rest, chain.part, node_size<D>, rest_);
  if (unknowns_) {
    if (own_part_) std::erase(acting_, own_part_);
    unknowns_->take(chain);
    own_part_ = unknowns_->part();
    if (own_part_) acting_.push_back(own_part_);
  }
  free_masses_.clear();
  for (const auto& mass : chain.free_masses) free_masses_.push_back(mass.index);
  adopt_joints(chain);
  std::vector<int> index;
  for (const Joint& joint : joints_) index.push_back(joint.index);
  supports_.adopt(model_, mesh_.last(), places_, index, unknowns_ && unknowns_->of_nodes() ? dofs_.angle() : -1);
  if (unknowns_) unknowns_->adopt();
  this->adopt_elements(unchanged);
  loose_ = loose_mass_of_rooms(*this, chain);
}

template <int D>
void CurrentBeam<D>::adopt_joints(const ChainState<D>& chain) {
  dofs_ = {.nodes = static_cast<int>(mesh_.x.size()),
           .marks = chain.loose ? 1 : static_cast<int>(chain.joints.size()),
           .free_masses = static_cast<int>(free_masses_.size()),
           .turning = unknowns_ ? unknowns_->count() : 0,
           .balance = model_.balance()};
  std::vector<JointPlace> places;
  std::vector<Joint> joints;
  for (const auto& joint : chain.joints) {
    const int node = chain.part.before + joint.node;
    const double x = mesh_.x[static_cast<std::size_t>(node)];
    const auto passes = [x](const PointMass& mass) { return mass.x < x; };
    const int passed = find(joint.index) >= 0  // later on it is passages that count
                           ? this->place_of(joint.index).passed
                           : static_cast<int>(std::ranges::count_if(model_.masses.points, passes));
    places.push_back({.node = node, .mark = dofs_.mark(static_cast<int>(places.size())), .passed = passed});
    joints.push_back({joint.index, joint.touches});
  }
  places_ = std::move(places);
  joints_ = std::move(joints);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (kinked(i)) places_[i].behind = dofs_.kink(dofs_.kinks++);
  }
}

template <int D>
typename CurrentBeam<D>::MarkMotion CurrentBeam<D>::mark_motion(std::size_t which, const Eigen::VectorXd& y,
                                                                double t) const {
  const auto guide = guided(which, t);
  if (guide) return {guide->value, guide->rate};
  const Eigen::Index mark = places_[which].mark;
  if (!ties(which)) return {y[mark], y[coordinates() + mark]};
  const auto tied = unknowns_->tied(which, y.data(), y.data() + coordinates());
  return {tied.x, tied.rate};
}

template <int D>
void CurrentBeam<D>::impose(Eigen::VectorXd& y, double t) const {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (!ties(i)) continue;
    const auto tied = unknowns_->tied(i, y.data(), y.data() + coordinates());
    y[places_[i].mark] = tied.x;
    y[coordinates() + places_[i].mark] = tied.rate;
  }
  if (!model_.driven()) return;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const auto guide = guided(i, t);
    if (!guide) continue;
    y[places_[i].mark] = guide->value;
    y[coordinates() + places_[i].mark] = guide->rate;
  }
  supports_.impose(t, y.data(), y.data() + coordinates());
}

template <int D>
void CurrentBeam<D>::orient(double t) const {
  if (!model_.turns()) return;
  const auto& held = supports_.at(t);
  spans_.left->stand_by(held[0].support);
  spans_.right->stand_by(held[1].support);
  if (loose_) loose_->update();
}

template class CurrentBeam<2>;
template class CurrentBeam<3>;

}  // namespace vlbeam
