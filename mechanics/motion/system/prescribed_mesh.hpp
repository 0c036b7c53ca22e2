#pragma once

#include <memory>
#include <vector>

#include "core/beam/chain_view.hpp"
#include "mechanics/motion/joint/joint_chain.hpp"
#include "mechanics/motion/parts/part.hpp"
#include "mechanics/motion/system/section_inertia.hpp"

namespace vlbeam {

/// The equations of a beam all of whose nodes move along it as prescribed, of one view of them.
template <int D>
class MeshEquations {
 public:
  using Elements = std::vector<MovingEquations<double, D>>;  ///< one an element

  virtual ~MeshEquations() = default;
  /// Adds M a - Q of the elements and of what comes in at the ends; returns the power lost to damping [W].
  virtual double add_residual(const double* q, const double* rate, const double* a, double t, double* r) = 0;
  /// Adds M a of the elements of the last add_residual().
  virtual void add_inertia(const double* a, double* r) const = 0;
  virtual void add_tangent(const Motion<D>& now, const TangentWeights& by, BeamMatrix<D>& tangent) const = 0;
  /// What the beam is given in a second at the accelerations `a`, if the model counts it; `elements` are those of the
  /// last evaluation, null for those of the last add_residual().
  virtual EnergyBalance power(const Elements* elements, const double* q, const double* rate, const double* a,
                              double t) = 0;
};

template <int D>
class CurrentBeam;

/// A mesh all of whose nodes move along the beam as prescribed: a load that moves, a stem that is fed through its
/// guides.
template <int D>
class PrescribedMesh {
 public:
  using Elements = typename MeshEquations<D>::Elements;

  virtual ~PrescribedMesh() = default;
  /// The nodes are where they are at time t; false where they tangle.
  virtual bool move(double t) = 0;
  /// Material coordinates of the nodes, as they were moved last.
  virtual const std::vector<Prescribed>& marks() const = 0;
  /// Takes from the nodal forces what the given accelerations of the ends ask for.
  virtual void take_inertia(const ChainView<D>& beam, const std::vector<MovingPart>& parts, Elements& elements) = 0;
  /// Adds the momentum that comes in with the matter at the ends.
  virtual void add_entering(const ChainView<D>& beam, double* f) const = 0;
  /// Solves M a = f in place; false where the mass matrix is not positive.
  virtual bool solve(const Elements& elements, double* f) = 0;
  virtual std::unique_ptr<MeshEquations<D>> new_equations(CurrentBeam<D>& beam) const = 0;
  /// Null where there is none.
  virtual const SectionInertia<D>* section_inertia() const { return nullptr; }
};

}  // namespace vlbeam
