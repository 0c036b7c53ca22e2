#pragma once

#include "core/beam/beam_matrix.hpp"
#include "core/geometry/const_vector.hpp"
#include "mechanics/flow/flow.hpp"
#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

/// The equations of motion of a beam as a residual r = M a - Q and its exact tangent: the sum over all that acts
/// on it. What holds it, and what a thread does to its angles, is for who solves them. At rest they are those of
/// statics.
template <int D>
class Equations {
 public:
  /// Which elements of fixed length count: what holds the beam at its ends asks for those there alone.
  enum class Extent { whole, ends };

  /// `beam` must outlive this object; its events may change it at any time.
  explicit Equations(CurrentBeam<D>& beam) : beam_(beam), flow_(beam) {}

  /// Writes r of the coordinates of the state, at the start of an array that may be longer; returns the power lost [W].
  double residual(const ConstVector& q, const ConstVector& v, const ConstVector& a, double t, Eigen::VectorXd& r,
                  Extent extent = Extent::whole) const;
  /// Adds M a of elements all of whose nodes travel as prescribed, at the time of the last residual.
  void add_travelling_inertia(const Eigen::VectorXd& a, Eigen::VectorXd& r) const {
    flow_.add_inertia(a.data(), r.data());
  }
  /// Makes of `tangent` that of the residual with weights `by`, but for Unknowns, which have their own.
  void assemble(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                const TangentWeights& by, BeamMatrix<D>& tangent);
  /// What the matter brings that flows in, in a second, at the accelerations `a`: by the elements of the last residual,
  /// which Newton's last correction is next to nothing away from.
  Tally flow_power(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t) {
    return flow_.power(q.data(), v.data(), a.data(), t);
  }

 private:
  void add_joints(const Motion<D>& now, Eigen::VectorXd& r, double& lost) const;
  void add_elements(const Motion<D>& now, const TangentWeights& by, BeamMatrix<D>& tangent) const;
  void add_turning(std::size_t which, const Motion<D>& now, const TangentWeights& by, BeamMatrix<D>& tangent) const;
  void add_travelling_elements(const Motion<D>& now, const TangentWeights& by, BeamMatrix<D>& tangent) const;
  /// Calls function(part, law) with the ends of the part for the elements at joints.
  template <class Function>
  void at_moving_parts(const Motion<D>& now, const Function& function) const;
  /// Calls function(span) for the runs of fixed elements.
  template <class Function>
  void at_spans(const Function& function) const {
    function(beam_.left());
    function(beam_.right());
    for (const SpanBetween<D>& span : beam_.between()) function(span.span());
  }

  CurrentBeam<D>& beam_;
  mutable Flow<D> flow_;
  Eigen::VectorXd lacking_;  ///< of what holds joints
};

extern template class Equations<2>;
extern template class Equations<3>;

}  // namespace vlbeam
