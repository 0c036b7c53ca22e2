#pragma once

#include "core/beam/beam_matrix.hpp"
#include "core/geometry/const_vector.hpp"
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
  explicit Equations(CurrentBeam<D>& beam) : beam_(beam) {
    if (beam.prescribed_mesh() != nullptr) of_mesh_ = beam.prescribed_mesh()->new_equations(beam);
  }

  /// Writes r of the coordinates of the state, at the start of an array that may be longer; returns the power lost [W].
  double residual(const ConstVector& q, const ConstVector& v, const ConstVector& a, double t, Eigen::VectorXd& r,
                  Extent extent = Extent::whole) const;
  /// Makes of `tangent` that of the residual with weights `by`, but for Unknowns, which have their own.
  void assemble(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t,
                const TangentWeights& by, BeamMatrix<D>& tangent);
  /// Those of a beam all of whose nodes are prescribed, or null: by the elements of the last residual, which Newton's
  /// last correction is next to nothing away from.
  MeshEquations<D>* of_mesh() { return of_mesh_.get(); }

 private:
  void add_joints(const Motion<D>& now, Eigen::VectorXd& r, double& lost) const;
  void add_elements(const Motion<D>& now, const TangentWeights& by, BeamMatrix<D>& tangent) const;
  void add_turning(std::size_t which, const Motion<D>& now, const TangentWeights& by, BeamMatrix<D>& tangent) const;
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
  std::unique_ptr<MeshEquations<D>> of_mesh_;
  Eigen::VectorXd lacking_;  ///< of what holds joints
};

extern template class Equations<2>;
extern template class Equations<3>;

}  // namespace vlbeam
