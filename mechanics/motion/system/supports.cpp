#include "mechanics/motion/system/supports.hpp"

#include <limits>

namespace vlbeam {
namespace {

template <int D>
using Components = typename Support<D>::Components;

/// Of `part`, what a support lets free.
template <int D>
Vec<double, D> freed(const Support<D>& support, const Vec<double, D>& part, const Components<D>& free) {
  return support.out_of_frame((support.into_frame(part).array() * free).matrix());
}

/// `part` with `value` in the components that a support holds.
template <int D>
Vec<double, D> held_at(const Support<D>& support, const Vec<double, D>& part, const Vec<double, D>& value,
                       const Components<D>& free) {
  return support.out_of_frame(
      (support.into_frame(part).array() * free + support.into_frame(value).array() * (1 - free)).matrix());
}

template <int D>
Eigen::Map<Vec<double, D>> behind_kink(const HeldNode<D>& held, double* a) {
  return Eigen::Map<Vec<double, D>>(a + held.behind);
}

}  // namespace

template <int D>
void Supports<D>::adopt(const BeamModel<D>& model, int last, std::span<const JointPlace> joints,
                        const std::vector<int>& index, Eigen::Index angles) {
  nodes_.clear();
  looked_at_ = std::numeric_limits<double>::quiet_NaN();
  index_ = index;
  moves_ = model.supports_move();
  nodes_.push_back({.node = 0, .end = 0, .built = &model.start, .motion = &model.start_motion});
  nodes_.push_back({.node = last, .end = 1, .built = &model.end, .motion = &model.end_motion});
  for (const auto& [node, support] : model.held_nodes) nodes_.push_back({.node = node, .built = &support});
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const ModelJoint<D>& joint = model.joints[static_cast<std::size_t>(index[i])];
    if (!joint.support) continue;
    nodes_.push_back({.node = joints[i].node,
                      .joint = static_cast<int>(i),
                      .behind = joints[i].behind,
                      .built = &*joint.support,
                      .motion = &joint.motion});
  }
  for (HeldNode<D>& held : nodes_) {
    if (held.motion != nullptr && !*held.motion) held.motion = nullptr;
    if (angles >= 0) held.angle = angles + held.node;
  }
  if (anchored_) set_anchors();
}

template <int D>
void Supports<D>::anchor(const double* q) {
  anchored_ = true;
  const auto of = [&](int node) {
    return Eigen::Matrix<double, node_size<D>, 1>(
        Eigen::Map<const Eigen::Matrix<double, node_size<D>, 1>>(q + Eigen::Index{node_size<D>} * node));
  };
  for (const HeldNode<D>& held : nodes_) {
    if (held.end >= 0) {
      anchors_.ends[static_cast<std::size_t>(held.end)] = of(held.node);
    } else if (held.joint >= 0) {
      const auto i = static_cast<std::size_t>(index_[static_cast<std::size_t>(held.joint)]);
      if (anchors_.joints.size() <= i) anchors_.joints.resize(i + 1);
      anchors_.joints[i] = of(held.node);
    } else {
      anchors_.guides.push_back(of(held.node));
    }
  }
  set_anchors();
}

template <int D>
void Supports<D>::set_anchors() const {
  auto guide = anchors_.guides.begin();
  for (HeldNode<D>& held : nodes_) {
    held.anchor = held.end >= 0 ? anchors_.ends[static_cast<std::size_t>(held.end)]
                  : held.joint >= 0
                      ? anchors_.joints[static_cast<std::size_t>(index_[static_cast<std::size_t>(held.joint)])]
                      : *guide++;
  }
}

template <int D>
const std::vector<HeldNode<D>>& Supports<D>::at(double t) const {
  if (!moves_ || t == looked_at_) return nodes_;
  looked_at_ = t;
  for (HeldNode<D>& held : nodes_) {
    if (held.motion == nullptr) continue;
    held.driven = held.motion->at(*held.built, t);
    if (held.turns()) held.support = held.built->turned(held.driven.angle.value);
  }
  return nodes_;
}

template <int D>
void Supports<D>::impose(double t, double* q, double* rate) const {
  if (!moves_) return;
  for (const HeldNode<D>& held : at(t)) {
    if (held.motion == nullptr) continue;
    const Support<D>& by = held.support;
    auto set = [&](auto part, const Vec<double, D>& value, const Components<D>& free) {
      part = held_at<D>(by, part, value, free);
    };
    set(position<D>(q, held.node), held.position_now(), by.free_position);
    set(position<D>(rate, held.node), held.driven.rate, by.free_position);
    if (!held.turns()) continue;
    if (held.holds_angle()) {
      q[held.angle] = held.driven.angle.value;
      rate[held.angle] = held.driven.angle.rate;
    }
    set(slope<D>(q, held.node), held.slope_now(), by.free_slope);
    set(slope<D>(rate, held.node), held.driven.slope_rate(slope<D>(q, held.node)), by.free_slope);
  }
}

template <int D>
void Supports<D>::project(double* a) const {
  for (const HeldNode<D>& held : nodes_) {
    const Support<D>& by = held.support;
    position<D>(a, held.node) = freed<D>(by, position<D>(a, held.node), by.free_position);
    slope<D>(a, held.node) = freed<D>(by, slope<D>(a, held.node), by.free_slope);
    if (held.behind >= 0) behind_kink(held, a) = freed<D>(by, behind_kink(held, a), by.free_slope);
    if (held.holds_angle()) a[held.angle] = 0;
  }
}

template <int D>
void Supports<D>::project(BeamMatrix<D>& tangent) const {
  for (const HeldNode<D>& held : nodes_) tangent.hold(held.node, held.behind, held.support);
}

template <int D>
void Supports<D>::add_offset(double t, const double* q, double* offset) const {
  for (const HeldNode<D>& held : at(t)) {
    if (held.motion == nullptr) continue;
    const Support<D>& by = held.support;
    const Vec<double, D> off = position<D>(q, held.node) - held.anchor.template head<D>() - held.driven.value;
    position<D>(offset, held.node) = freed<D>(by, off, 1 - by.free_position);
    if (!held.turns()) continue;
    if (held.holds_angle()) offset[held.angle] = q[held.angle] - held.driven.angle.value;
    slope<D>(offset, held.node) = DrivenPoint<D>::held(by, slope<D>(q, held.node) - held.slope_now());
  }
}

template <int D>
double Supports<D>::power(const double* lacking, const double* rate) const {
  double sum = 0;
  for (const HeldNode<D>& held : nodes_) {
    if (held.motion == nullptr) continue;
    const auto add = [&](const Vec<double, D>& on, const Vec<double, D>& at, const Components<D>& free) {
      const Vec<double, D> force = held.support.into_frame(on), velocity = held.support.into_frame(at);
      sum += (force.array() * velocity.array() * (1 - free)).sum();
    };
    add(position<D>(lacking, held.node), position<D>(rate, held.node), held.support.free_position);
    if (held.turns() && held.holds_angle()) sum += lacking[held.angle] * rate[held.angle];
    if (held.turns()) add(slope<D>(lacking, held.node), slope<D>(rate, held.node), held.support.free_slope);
  }
  return sum;
}

template <int D>
Eigen::MatrixXd Supports<D>::directions(Eigen::Index coordinates) const {
  Eigen::MatrixXd directions = Eigen::MatrixXd::Identity(coordinates, coordinates);
  Eigen::ArrayXd free = Eigen::ArrayXd::Ones(coordinates);
  const auto hold = [&](Eigen::Index at, const Support<D>& support, const Components<D>& components) {
    directions.template block<D, D>(at, at) = support.frame;
    free.template segment<D>(at) = components;
  };
  for (const HeldNode<D>& held : nodes_) {
    const Eigen::Index node = Eigen::Index{node_size<D>} * held.node;
    hold(node, held.support, held.support.free_position);
    hold(node + D, held.support, held.support.free_slope);
    if (held.behind >= 0) hold(held.behind, held.support, held.support.free_slope);
    if (held.holds_angle()) free[held.angle] = 0;
  }
  Eigen::Index kept = 0;
  for (Eigen::Index k = 0; k < coordinates; ++k) {
    if (free[k] > 0) directions.col(kept++) = directions.col(k);
  }
  return directions.leftCols(kept);
}

template class Supports<2>;
template class Supports<3>;

}  // namespace vlbeam
