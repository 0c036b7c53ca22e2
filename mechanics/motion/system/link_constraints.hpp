#pragma once

#include "mechanics/motion/parts/acting_loads.hpp"
#include "mechanics/motion/system/beam_links.hpp"
#include "mechanics/motion/system/constraint_set.hpp"

namespace vlbeam {

/// Links as constraints: `unit` m is the size of their force, dC/dq times which acts.
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
    const ChainView<D> beam = links_.beam().view(q, q);
    for (const BeamLink<D>& link : all_) link.add_force(beam, unit * *multipliers++, r);
  }
  void write_values(const double* q, double* values) const override {
    const ChainView<D> beam = links_.beam().view(q, q);
    for (const BeamLink<D>& link : all_) *values++ = link.value(beam);
  }
  void write_rates(const double* q, const double* v, double* rates) const override {
    const ChainView<D> beam = links_.beam().view(q, v);
    for (const BeamLink<D>& link : all_) *rates++ = link.rate(beam);
  }
  void add_tangent(const double* q, const double* multipliers, double unit, double scale,
                   BeamMatrix<D>& tangent) const override {
    add_curvature(q, multipliers, unit, tangent);
    add_rows(q, scale, tangent);
  }
  /// Rows and columns alone.
  void add_rows(const double* q, double scale, BeamMatrix<D>& tangent) const {
    const ChainView<D> beam = links_.beam().view(q, q);
    for (const BeamLink<D>& link : all_) {
      if (link.place) {
        add_row_of_point(beam, link, scale, tangent);
        continue;
      }
      auto& border = tangent.add_border(link.behind);
      const Vec<double, D> line = scale * link.line(q);
      border.column[0].template head<D>() = border.row[0].template head<D>() = -line;
      border.far = link.ahead;
      border.far_column.template head<D>() = border.far_row.template head<D>() = line;
    }
  }
  /// What the multipliers' forces change with q.
  void add_curvature(const double* q, const double* multipliers, double unit, BeamMatrix<D>& tangent) const {
    const ChainView<D> beam = links_.beam().view(q, q);
    for (const BeamLink<D>& link : all_) {
      const double force = unit * *multipliers++;
      if (link.place) {
        const int k = beam.element_at(*link.place);
        if (!beam.at_joint(k)) continue;
        tangent.add_point(beam, k, constant_force_tangent<D>(beam, k, *link.place, -force * *link.along));
        continue;
      }
      // its direction stays, or the band does not reach: Newton's iteration then converges a little slower
      if (link.along || link.ahead != link.behind + 1) continue;
      const double turns = force / link.distance;
      const auto k = static_cast<std::size_t>(link.behind);
      const auto diagonal = [](auto& block) { return block.template topLeftCorner<D, D>().diagonal().array(); };
      diagonal(tangent.diagonal[k]) += turns;
      diagonal(tangent.diagonal[k + 1]) += turns;
      diagonal(tangent.upper[k]) -= turns;
      diagonal(tangent.lower[k + 1]) -= turns;
    }
  }
  /// Adds size (dC/dq)^T dC/dq of what holds material points: they are then stiff of themselves, along what their
  /// multipliers hold.
  void stiffen(const double* q, double size, BeamMatrix<D>& tangent) const {
    const ChainView<D> beam = links_.beam().view(q, q);
    for (const BeamLink<D>& link : all_) {
      if (!link.place) continue;
      const int k = beam.element_at(*link.place);
      const Eigen::Matrix<double, point_coordinates<D>, 1> gradient = gradient_of(beam, k, link);
      tangent.add_point(beam, k, PointMatrix<D>(size * gradient * gradient.transpose()));
    }
  }

 private:
  /// By the nodal vectors of element k, and the material coordinates of its ends where those are joints.
  static Eigen::Matrix<double, point_coordinates<D>, 1> gradient_of(const ChainView<D>& beam, int k,
                                                                    const BeamLink<D>& link) {
    const PointMotion<double, D> at = point_at<double, D>(beam.kinematics(k), *link.place);
    Eigen::Matrix<double, point_coordinates<D>, 1> gradient;
    for (int i = 0; i < 4; ++i) gradient.template segment<D>(D * i) = at.s[static_cast<std::size_t>(i)] * *link.along;
    gradient[4 * D] = beam.joint_at(k) != nullptr ? link.along->dot(at.y_a) : 0;
    gradient[4 * D + 1] = beam.joint_at(k + 1) != nullptr ? link.along->dot(at.y_b) : 0;
    return gradient;
  }
  static void add_row_of_point(const ChainView<D>& beam, const BeamLink<D>& link, double scale,
                               BeamMatrix<D>& tangent) {
    const int k = beam.element_at(*link.place);
    tangent.add_border(k);
    const Eigen::Index own = tangent.nodal() + tangent.borders() - 1;
    const Eigen::Matrix<double, point_coordinates<D>, 1> gradient = scale * gradient_of(beam, k, link);
    const auto put = [&](Eigen::Index coordinate, double size) {
      tangent.entry(own, coordinate) = tangent.entry(coordinate, own) = size;
    };
    for (int i = 0; i < 4 * D; ++i) put(beam.vector(k, i / D) + i % D, gradient[i]);
    for (int e = 0; e < 2; ++e) {
      if (const JointPlace* joint = beam.joint_at(k + e)) put(joint->mark, gradient[4 * D + e]);
    }
  }

  const BeamLinks<D>& links_;
  std::vector<BeamLink<D>> all_;
};

}  // namespace vlbeam
