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
CurrentBeam<D>::CurrentBeam(const BeamModel<D>& model, const ChainState<D>& chain)
    : model_(model), rules_(model.rules()) {
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
  held_.anchor(y.data());
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
  held_.adopt(model_, mesh_.last(), places_, index, unknowns_ && unknowns_->of_nodes() ? layout_.angle() : -1);
  if (unknowns_) unknowns_->adopt();
  adopt_elements(unchanged);
  loose_ = loose_mass_of_rooms(*this, chain);
}

template <int D>
void CurrentBeam<D>::adopt_joints(const ChainState<D>& chain) {
  layout_ = {.nodes = static_cast<int>(mesh_.x.size()),
             .marks = chain.loose ? 1 : static_cast<int>(chain.joints.size()),
             .free_masses = static_cast<int>(free_masses_.size()),
             .turning = unknowns_ ? unknowns_->count() : 0,
             .tallies = model_.tallies()};
  std::vector<JointPlace> places;
  std::vector<Joint> joints;
  for (const auto& joint : chain.joints) {
    const int node = chain.part.before + joint.node;
    const double x = mesh_.x[static_cast<std::size_t>(node)];
    const auto passes = [x](const PointMass& mass) { return mass.x < x; };
    const int passed = find(joint.index) >= 0  // later on it is passages that count
                           ? place_of(joint.index).passed
                           : static_cast<int>(std::ranges::count_if(model_.masses.points, passes));
    places.push_back({.node = node, .mark = layout_.mark(static_cast<int>(places.size())), .passed = passed});
    joints.push_back({joint.index, joint.touches});
  }
  places_ = std::move(places);
  joints_ = std::move(joints);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (kinked(i)) places_[i].behind = layout_.kink(layout_.kinks++);
  }
}

template <int D>
const SumTables& CurrentBeam<D>::tables(int points) const {
  const auto known = tables_.find(points);
  if (known != tables_.end()) return known->second;
  const BeamRules rules = points == own_points ? rules_ : BeamRules(beam_rule(points, model_.axial_strain));
  return tables_.emplace(points, rules).first->second;
}

template <int D>
void CurrentBeam<D>::adopt_elements(const UnchangedElements& unchanged) {
  const BeamSections sections = model_.sections();
  const int middle = mesh_.elements() / 2;
  const int left_open = prescribed_ ? 0 : has_joint() ? std::max(0, places_.front().node - 1) : middle;
  const int right_open = prescribed_   ? mesh_.last()
                         : has_joint() ? std::min(mesh_.last(), places_.back().node + 1)
                                       : middle;
  const double* rest = rest_.empty() ? nullptr : rest_.data();
  const auto& masses = model_.masses.points;
  const auto renew = [&](std::optional<Span<D>>& span, int outer, int open, const Support<D>& support, int known) {
    span = Span<D>(mesh_, outer, open, support, sections, rules_, rest, masses, span ? &*span : nullptr, known);
  };
  renew(spans_.left, 0, left_open, model_.start, unchanged.at_start);
  renew(spans_.right, mesh_.last(), right_open, model_.end, unchanged.at_end);
  spans_.between.clear();
  for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
    const int low = places_[i].node + 1, high = places_[i + 1].node - 1;
    if (low <= high) spans_.between.emplace_back(mesh_, low, high, sections, rules_, rest, masses);
  }
  parts_.clear();
  const auto joint_at = [&](int node) {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (places_[i].node == node) return static_cast<int>(i);
    }
    return -1;
  };
  for (int k = left_open; (has_joint() || prescribed_) && k < right_open; ++k) {
    const int a = joint_at(k), b = joint_at(k + 1);
    if (a < 0 && b < 0 && !prescribed_) continue;
    const MovingEnds ends = prescribed_ || (a >= 0 && b >= 0) ? MovingEnds::both
                            : a < 0                           ? MovingEnds::b
                                                              : MovingEnds::a;
    const Weights<double>& weights = mesh_.weights[static_cast<std::size_t>(k)].w;
    parts_.push_back({k, ends, a, b, ShapeTabulation(rules_.of(weights), weights)});
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
ConstraintResidual CurrentBeam<D>::slope_residual(const Eigen::VectorXd& y) const {
  ConstraintResidual largest;
  for (std::size_t j = 0; j < places_.size(); ++j) {
    if (places_[j].behind < 0) continue;
    const auto slopes = joint_slopes(j, y.data()), rates = joint_slopes(j, y.data() + coordinates());
    const SlopeConditions<D> conditions(joint(j).law.slopes, longest_axis<D>(slopes.template head<D>()));
    for (int i = 0; i < conditions.count(); ++i) {
      largest.position = std::max(largest.position, std::abs(conditions.value(i, slopes)));
      largest.velocity = std::max(largest.velocity, std::abs(conditions.rate(i, slopes, rates)));
    }
  }
  return largest;
}

/// Elements that meet there ask one behind the other.
template <int D>
const RestEnd<D>& CurrentBeam<D>::rest_end(double x) const {
  if (!(last_rest_end_.x == x)) last_rest_end_ = {x, model_.rest->derivatives(x)};
  return last_rest_end_;
}

template <int D>
std::optional<RestElement<D>> CurrentBeam<D>::rest_of(const MovingPart& part, const double* q) const {
  if (!model_.rest) return std::nullopt;
  const auto end = [&](int node, int joint) -> RestEnd<D> {
    if (prescribed_) {
      return rest_end(prescribed_->marks()[static_cast<std::size_t>(node)].value);
    }
    if (joint >= 0) return rest_end(q[places_[static_cast<std::size_t>(joint)].mark]);
    return {mesh_.x[static_cast<std::size_t>(node)],
            {position<D>(rest_.data(), node), slope<D>(rest_.data(), node), Vector::Zero(), Vector::Zero()}};
  };
  return RestElement<D>{end(part.element, part.a), end(part.element + 1, part.b)};
}

template <int D>
template <class Equations>
void CurrentBeam<D>::fill(const ChainView<D>& beam, double t, JointElements& elements,
                          const Equations& equations_of) const {
  elements.clear();
  MovingLaw<D> law = moving_law(t);
  for (const MovingPart& part : parts_) {
    switch (part.ends) {
      case MovingEnds::a:
        elements.push_back(equations_of.template operator()<MovingEnds::a>(part, law));
        break;
      case MovingEnds::b:
        elements.push_back(equations_of.template operator()<MovingEnds::b>(part, law));
        break;
      case MovingEnds::both:
        elements.push_back(equations_of.template operator()<MovingEnds::both>(part, law));
        break;
    }
    if (model_.masses.present()) model_.masses.add_to(beam, part.element, gravity(t), elements.back());
  }
}

template <int D>
void CurrentBeam<D>::fill_elements(const double* q, const double* rate, double t, JointElements& elements) const {
  const ChainView<D> beam = view(q, rate);
  fill(beam, t, elements, [&]<MovingEnds Ends>(const MovingPart& part, MovingLaw<D>& law) {
    const int k = part.element;
    const auto rest = rest_of(part, q);
    law.rest = rest ? &*rest : nullptr;
    return moving_equations<double, D, Ends>(beam.coordinates(k), beam.rates(k), beam.weights(k), part.table, law);
  });
  if (prescribed_) prescribed_->take_inertia(beam, parts_, elements);
}

template <int D>
void CurrentBeam<D>::fill_masses(const double* q, double t, JointElements& elements) const {
  const ChainView<D> beam = view(q, q);  // rates do not count
  fill(beam, t, elements, [&]<MovingEnds Ends>(const MovingPart& part, const MovingLaw<D>& law) {
    const int k = part.element;
    return MovingElement<double, D, Ends>::masses(beam.coordinates(k), beam.weights(k), part.table, law);
  });
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
  held_.impose(t, y.data(), y.data() + coordinates());
}

template <int D>
void CurrentBeam<D>::orient(double t) const {
  if (!model_.turns()) return;
  const auto& held = held_.at(t);
  spans_.left->stand_by(held[0].support);
  spans_.right->stand_by(held[1].support);
  if (loose_) loose_->update();
}

template <int D>
std::array<double*, 4> CurrentBeam<D>::vectors_of(double* q, int k) const {
  double* first = q + Eigen::Index{node_size<D>} * k;
  const JointPlace* const joint = view(q, q).joint_at(k);
  return {first, joint != nullptr && joint->behind >= 0 ? q + joint->behind : first + D, first + 2 * D, first + 3 * D};
}

template <int D>
double CurrentBeam<D>::line_power(const ChainView<D>& beam, double t) const {
  if (!model_.loads.line_force) return 0;
  const double rhoA = model_.section.rhoA;
  Vector sum = (spans_.left->first_moment(beam.rate) + spans_.right->first_moment(beam.rate)) / rhoA;
  for (const SpanBetween<D>& span : spans_.between) sum += span.span().first_moment(beam.rate) / rhoA;
  for (const MovingPart& part : parts_) {
    const bool reshaped =
        model_.transport == WeightTransport::transported && beam.weights(part.element).w != unit_weights;
    sum += swept(beam.kinematics(part.element), part.table, reshaped, model_.formulation);
  }
  return model_.loads.line_force(t).dot(sum - beam.entering());  // what comes in is not moved by it
}

template <int D>
double CurrentBeam<D>::fed_line_power(const ChainView<D>& beam, double t) const {
  if (!model_.loads.line_force) return 0;
  Vector sum = Vector::Zero();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (guides(i)) sum += beam.entering_at(places_[i]);
  }
  return model_.loads.line_force(t).dot(sum);
}

template class CurrentBeam<2>;
template class CurrentBeam<3>;

}  // namespace vlbeam
