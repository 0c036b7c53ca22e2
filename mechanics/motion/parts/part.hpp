#pragma once

#include "core/beam/beam_matrix.hpp"
#include "core/beam/chain_view.hpp"
#include "core/tangent_weights.hpp"
#include "mechanics/time/energy_balance.hpp"

namespace vlbeam {

/// A beam at one instant. At rest its rates and accelerations are 0, and t is the load factor.
template <int D>
struct Motion {
  ChainView<D> beam;
  const double* a;  ///< accelerations, an array like q; null where they are not known yet
  double t;         ///< [s]
  Vec<double, D> gravity = Vec<double, D>::Zero();  ///< [m/s^2]
};

/// One thing that acts on a beam. The equations M a = Q are sums over parts. What a part has of inertia on elements
/// whose ends are joints is in their mass matrix; that of the others is constant, and factored.
template <int D>
class Part {
 public:
  virtual ~Part() = default;
  /// Adds its generalized forces Q to an array like q; returns the power that it takes and gives.
  virtual EnergyBalance add_force(const Motion<D>& motion, double* force) const = 0;
  /// What of the power add_force() counts as of loads [W]; whoever knows it for less than all forces says so. `scratch`
  /// is an array of forces to write on.
  virtual double load_power(const Motion<D>& motion, double* scratch) const { return add_force(motion, scratch).loads; }
  /// Whether it may take or give power: the state then counts it.
  virtual bool works() const { return true; }
  /// Whether it may give power, and not only take it.
  virtual bool gives() const { return works(); }
  /// Whether what it takes changes so little in a step that its power at both ends tells.
  virtual bool takes_evenly() const { return !works(); }
  /// What of its force acts on a joint at that node, and not on the beam there [N].
  virtual Vec<double, D> force_on_joint(int /*node*/) const { return Vec<double, D>::Zero(); }
  /// Adds the tangent of M a - Q as far as it is the part's.
  virtual void add_tangent(const Motion<D>& motion, const TangentWeights& by, BeamMatrix<D>& tangent) const = 0;
};

}  // namespace vlbeam
