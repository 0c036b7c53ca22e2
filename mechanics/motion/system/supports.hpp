#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/beam/beam_matrix.hpp"
#include "mechanics/motion/system/beam_model.hpp"

namespace vlbeam {

/// What holds the axis at a node in space, as it stands at an instant: a support at an end, a ring or a sleeve at a
/// joint, or a guide through which the beam flows.
template <int D>
struct HeldNode {
  int node;
  int end = -1;                                                              ///< of the beam, 0 or 1, where it is there
  int joint = -1;                                                            ///< which of those on the beam
  Eigen::Index behind = -1;                                                  ///< where the slope behind a kink stands
  Eigen::Index angle = -1;                                                   ///< where the node's angle stands
  const Support<D>* built = nullptr;                                         ///< as it stood at t = 0
  const SupportMotion<D>* motion = nullptr;                                  ///< where it moves
  Eigen::Matrix<double, node_size<D>, 1> anchor = decltype(anchor)::Zero();  ///< position and slope there, at t = 0
  Support<D> support = *built;
  DrivenPoint<D> driven = {};

  bool holds_angle() const { return angle >= 0 && !support.free_angle; }
  bool turns() const { return motion != nullptr && motion->turns(); }
  /// Where it holds what it holds of the position and of the slope.
  Vec<double, D> position_now() const { return anchor.template head<D>() + driven.value; }
  Vec<double, D> slope_now() const { return driven.turned(anchor.template tail<D>()); }
};

/// What has no equation of motion since something holds it in space: the one place that knows which components of
/// nodes are free.
template <int D>
class Supports {
 public:
  /// After each change of the mesh; `index` tells which of the model's joints those on the beam are, `angles` where
  /// those of the nodes stand, negative where they have none.
  void adopt(const BeamModel<D>& model, int last, std::span<const JointPlace> joints, const std::vector<int>& index,
             Eigen::Index angles);
  /// What they hold is where it is in q, a beam at t = 0.
  void anchor(const double* q);

  /// All, as they stand at time t.
  const std::vector<HeldNode<D>>& at(double t) const;
  /// As they stood when they were looked at last.
  const std::vector<HeldNode<D>>& nodes() const { return nodes_; }

  /// Puts what they drive where it is at time t.
  void impose(double t, double* q, double* rate) const;
  /// Sets what they hold to zero, of an array like q, as they stood last.
  void project(double* a) const;
  /// Takes it out of rows and columns, and leaves its stiffness in its place.
  void project(BeamMatrix<D>& tangent) const;
  /// Writes how far what they drive is from where it is at time t.
  void add_offset(double t, const double* q, double* offset) const;
  /// Power of what moves, of the forces `lacking` in the equations, as they stood last [W].
  double power(const double* lacking, const double* rate) const;
  /// Columns, orthonormal: the directions in which they let so many coordinates move.
  Eigen::MatrixXd directions(Eigen::Index coordinates) const;

 private:
  /// Position and slope that nodes had at t = 0: at the ends, at the model's joints, at guides.
  struct Anchors {
    std::array<Eigen::Matrix<double, node_size<D>, 1>, 2> ends;
    std::vector<Eigen::Matrix<double, node_size<D>, 1>> joints, guides;
  };

  void set_anchors() const;

  Anchors anchors_;
  std::vector<int> index_;
  bool anchored_ = false, moves_ = false;
  mutable std::vector<HeldNode<D>> nodes_;
  mutable double looked_at_ = 0;  ///< [s], the instant that `nodes_` belong to
};

extern template class Supports<2>;
extern template class Supports<3>;

}  // namespace vlbeam
