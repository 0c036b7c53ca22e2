#pragma once

#include "core/beam/beam_matrix.hpp"
#include "core/system/beam_system.hpp"

namespace vlbeam {

/// The equations of motion of a beam system as a residual r = M a - Q and its exact tangent: the sum over all that acts
/// on it. What holds it, and what a thread does to its angles, is for who solves them. At rest they are those of
/// statics.
template <int D>
class Equations {
 public:
  /// `system` must outlive this object; its events may change it at any time.
  explicit Equations(BeamSystem<D>& system) : system_(system) {}

  /// Writes r of the coordinates of the state, at the start of an array that may be longer; returns the power lost [W].
  double residual(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                  Eigen::VectorXd& r) const;
  /// Makes of `tangent` that of the residual with weights `by`, but for the angles of Spin, which couple to nothing
  /// else.
  void assemble(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                const TangentWeights& by, BeamMatrix<D>& tangent);

 private:
  void add_joints(const Motion<D>& now, Eigen::VectorXd& r, double& lost) const;
  void add_rider(const Motion<D>& now, Eigen::VectorXd& r, double& lost) const;
  void add_elements(const Motion<D>& now, const TangentWeights& by, BeamMatrix<D>& tangent) const;
  void add_travelling_elements(const Motion<D>& now, const TangentWeights& by, BeamMatrix<D>& tangent) const;
  /// Calls function(part, law) with the ends of the part for the elements at joints.
  template <class Function>
  void at_moving_parts(const Motion<D>& now, const Function& function) const;
  /// Calls function(span) for the runs of fixed elements.
  template <class Function>
  void at_spans(const Function& function) const {
    function(system_.left());
    function(system_.right());
    for (const SpanBetween<D>& span : system_.between()) function(span.span());
  }

  BeamSystem<D>& system_;
  Eigen::VectorXd lacking_;  ///< of what holds joints
};

extern template class Equations<2>;
extern template class Equations<3>;

}  // namespace vlbeam
