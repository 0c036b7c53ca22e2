#include "mechanics/flow/mesh_motion.hpp"

#include <string>
#include <utility>

#include "core/error.hpp"

namespace vlbeam {
namespace {

constexpr int instants = 2000;  // at which a motion is looked at
constexpr int bisections = 25;  // from one of them to the next

}  // namespace

MeshMotion::MeshMotion(std::vector<Guide> guides) : guides_(std::move(guides)) {
  int before = -1;
  for (const Guide& guide : guides_) {
    const bool first = &guide == &guides_.front();
    if (first ? guide.node != 0 : guide.node <= before) {
      throw ModelError("mesh motion", "node " + std::to_string(guide.node),
                       first ? "the motion of node 0 comes first" : "nodes stand in increasing order, each once");
    }
    before = guide.node;
  }
  if (guides_.size() < 2) throw ModelError("mesh motion", "one motion", "the first and the last node need theirs");
}

void MeshMotion::at(double t, std::vector<Prescribed>& nodes) const {
  nodes.resize(static_cast<std::size_t>(last()) + 1);
  Prescribed from = guides_.front().x(t);
  nodes.front() = from;
  for (std::size_t k = 1; k < guides_.size(); ++k) {
    const int first = guides_[k - 1].node, count = guides_[k].node - first;
    const Prescribed to = guides_[k].x(t);
    for (int i = 1; i < count; ++i) {
      const double u = static_cast<double>(i) / count, v = 1 - u;
      nodes[static_cast<std::size_t>(first) + static_cast<std::size_t>(i)] = {
          v * from.value + u * to.value, v * from.rate + u * to.rate, v * from.acceleration + u * to.acceleration};
    }
    nodes[static_cast<std::size_t>(guides_[k].node)] = to;
    from = to;
  }
}

double MeshMotion::length(std::size_t k, double t) const {
  return (guides_[k + 1].x(t).value - guides_[k].x(t).value) / (guides_[k + 1].node - guides_[k].node);
}

std::optional<MeshMotion::Tangle> MeshMotion::tangle(double from, double to, double shortest) const {
  std::optional<Tangle> first;
  for (int i = 0; i <= instants && !first; ++i) {
    const double step = (to - from) / instants, t = from + i * step;
    for (std::size_t k = 0; k + 1 < guides_.size(); ++k) {
      if (length(k, t) >= shortest) continue;
      double low = i == 0 ? t : t - step, high = t;
      for (int b = 0; b < bisections; ++b) {
        const double middle = (low + high) / 2;
        (length(k, middle) < shortest ? high : low) = middle;
      }
      if (!first || high < first->t) first = Tangle{high, guides_[k].node, length(k, high)};
    }
  }
  return first;
}

}  // namespace vlbeam
