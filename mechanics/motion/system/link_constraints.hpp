#pragma once

#include "mechanics/motion/system/beam_links.hpp"
#include "mechanics/motion/system/constraint_set.hpp"

namespace vlbeam {

/// Links as constraints: `unit` m is the force with which their nodes pull at each other.
template <int D>
class LinkConstraints final : public ConstraintSet<D> {
 public:
  /// `links` must outlive this object.
  explicit LinkConstraints(const BeamLinks<D>& links) : links_(links) {}

  void adopt() override { all_ = links_.all(); }
  Eigen::Index count() const override { return static_cast<Eigen::Index>(all_.size()); }
  void add_fields(Eigen::Index first, std::vector<FieldRun>& runs) const override {
    for (Eigen::Index i = 0; i < count(); ++i) runs.push_back({Field::multiplier, first + i});
  }

  void add_forces(const double* q, const double* multipliers, double unit, double* r) const override {
    for (const NodeLink<D>& link : all_) {
      const Vec<double, D> pull = link.pull(q, unit * *multipliers++);
      position<D>(r, link.behind) -= pull;
      position<D>(r, link.ahead) += pull;
    }
  }
  void write_values(const double* q, double* values) const override {
    for (const NodeLink<D>& link : all_) *values++ = link.value(link.difference(q));
  }
  void write_rates(const double* q, const double* v, double* rates) const override {
    for (const NodeLink<D>& link : all_) *rates++ = link.line(q).dot(link.difference(v));
  }
  void add_tangent(const double* q, const double* multipliers, double unit, double scale,
                   BeamMatrix<D>& tangent) const override {
    for (const NodeLink<D>& link : all_) {
      auto& border = tangent.add_border(link.behind);
      const Vec<double, D> line = link.pull(q, scale);
      border.column[0].template head<D>() = border.row[0].template head<D>() = -line;
      border.far = link.ahead;
      border.far_column.template head<D>() = border.far_row.template head<D>() = line;
      const double turns = unit * *multipliers++ / link.distance;
      // its direction stays, or the band does not reach: Newton's iteration then converges a little slower
      if (link.along || link.ahead != link.behind + 1) continue;
      const auto k = static_cast<std::size_t>(link.behind);
      const auto diagonal = [](auto& block) { return block.template topLeftCorner<D, D>().diagonal().array(); };
      diagonal(tangent.diagonal[k]) += turns;
      diagonal(tangent.diagonal[k + 1]) += turns;
      diagonal(tangent.upper[k]) -= turns;
      diagonal(tangent.lower[k + 1]) -= turns;
    }
  }

 private:
  const BeamLinks<D>& links_;
  std::vector<NodeLink<D>> all_;
};

}  // namespace vlbeam
