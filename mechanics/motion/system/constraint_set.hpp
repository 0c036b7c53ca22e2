#pragma once

#include <vector>

#include "core/beam/beam_matrix.hpp"
#include "mechanics/time/archive.hpp"
#include "mechanics/time/fields.hpp"

namespace vlbeam {

/// Constraints C(q) = 0 of one kind, each with a multiplier m whose force on the coordinates is `unit` m dC/dq.
/// Supports, the conditions on slopes at kinks, and links are such sets. Arrays of multipliers, values and rates hold
/// an entry a constraint.
template <int D>
class ConstraintSet {
 public:
  virtual ~ConstraintSet() = default;

  /// After each change of the beam.
  virtual void adopt() = 0;
  virtual Eigen::Index count() const = 0;
  /// Appends the kinds of the multipliers, which stand from `first` on.
  virtual void add_fields(Eigen::Index first, std::vector<FieldRun>& runs) const = 0;
  /// Where constraints can be written in several ways: takes those that serve at q.
  virtual void choose(const double* /*q*/) {}

  /// Adds the forces of the multipliers to r, an array like q.
  virtual void add_forces(const double* q, const double* multipliers, double unit, double* r) const = 0;
  /// Writes C.
  virtual void write_values(const double* q, double* values) const = 0;
  /// Writes dC/dt.
  virtual void write_rates(const double* q, const double* v, double* rates) const = 0;
  /// Adds rows and columns of the multipliers, times `scale`, to the border, and what their forces change with q.
  virtual void add_tangent(const double* q, const double* multipliers, double unit, double scale,
                           BeamMatrix<D>& tangent) const = 0;
  /// Adds `factor` times the second derivative of constraint i to a matrix of the coordinates.
  virtual void add_second_derivative(Eigen::Index /*i*/, double /*factor*/, Eigen::MatrixXd& /*dense*/) const {}

  /// Takes over what the same set of another view has chosen.
  virtual void follow(const ConstraintSet& /*other*/) {}
  /// Writes or reads what it has chosen.
  virtual void exchange(Archive& /*memory*/) {}
};

}  // namespace vlbeam
