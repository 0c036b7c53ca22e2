#include "mechanics/motion/system/beam_elements.hpp"

#include <algorithm>

#include "mechanics/motion/parts/acting_loads.hpp"

namespace vlbeam {

template <int D>
const SumTables& BeamElements<D>::tables(int points) const {
  const auto known = tables_.find(points);
  if (known != tables_.end()) return known->second;
  const BeamRules rules = points == own_points ? rules_ : BeamRules(beam_rule(points, model_.axial_strain));
  return tables_.emplace(points, rules).first->second;
}

template <int D>
void BeamElements<D>::adopt_elements(const UnchangedElements& unchanged) {
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

/// Elements that meet there ask one behind the other.
template <int D>
const RestEnd<D>& BeamElements<D>::rest_end(double x) const {
  if (!(last_rest_end_.x == x)) last_rest_end_ = {x, model_.rest->derivatives(x)};
  return last_rest_end_;
}

template <int D>
std::optional<RestElement<D>> BeamElements<D>::rest_of(const MovingPart& part, const double* q) const {
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
void BeamElements<D>::fill(const ChainView<D>& beam, double t, JointElements& elements,
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
void BeamElements<D>::fill_elements(const double* q, const double* rate, double t, JointElements& elements) const {
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
void BeamElements<D>::fill_masses(const double* q, double t, JointElements& elements) const {
  const ChainView<D> beam = view(q, q);  // rates do not count
  fill(beam, t, elements, [&]<MovingEnds Ends>(const MovingPart& part, const MovingLaw<D>& law) {
    const int k = part.element;
    return MovingElement<double, D, Ends>::masses(beam.coordinates(k), beam.weights(k), part.table, law);
  });
}

template <int D>
std::array<double*, 4> BeamElements<D>::vectors_of(double* q, int k) const {
  double* first = q + Eigen::Index{node_size<D>} * k;
  const JointPlace* const joint = view(q, q).joint_at(k);
  return {first, joint != nullptr && joint->behind >= 0 ? q + joint->behind : first + D, first + 2 * D, first + 3 * D};
}

template <int D>
double BeamElements<D>::line_power(const ChainView<D>& beam, double t) const {
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
double BeamElements<D>::fed_line_power(const ChainView<D>& beam, double t) const {
  if (!model_.loads.line_force) return 0;
  Vector sum = Vector::Zero();
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (guides(i)) sum += beam.entering_at(places_[i]);
  }
  return model_.loads.line_force(t).dot(sum);
}

template class BeamElements<2>;
template class BeamElements<3>;

}  // namespace vlbeam
