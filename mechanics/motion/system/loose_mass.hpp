#pragma once

#include <array>
#include <memory>
#include <optional>

#include "core/beam/beam_matrix.hpp"
#include "core/length_control/chain_state.hpp"
#include "core/tangent_weights.hpp"
#include "mechanics/motion/parts/part.hpp"

namespace vlbeam {

/// The mass of the only joint where no node carries it. Its material coordinate stands where those of joints do, of
/// arrays like q.
template <int D>
class LooseMass {
 public:
  using Vector = Vec<double, D>;

  virtual ~LooseMass() = default;
  /// Supports of the beam stand otherwise.
  virtual void update() = 0;
  /// Writes its coordinate in a chain.
  virtual void write(ChainState<D>& chain, double x, double rate) const = 0;

  /// Where it is, how it moves, and the beam's derivative there.
  struct Place {
    Vector r, v, r_x;
  };
  virtual Place place(const double* q, const double* rate) const = 0;
  virtual Vector acceleration(const double* q, const double* rate, const double* a) const = 0;

  /// Adds what it adds to M a - Q, and to its tangent; returns the power lost [W].
  virtual double add_residual(const Motion<D>& now, double* r) const = 0;
  virtual void add_tangent(const Motion<D>& now, const TangentWeights& by, BeamMatrix<D>& tangent) const = 0;

  /// What it does to a beam that would have the accelerations `a` without it, which it completes.
  struct Answer {
    Vector force;             ///< on the mass [N]
    std::array<double, 4> s;  ///< shares of it on positions and slopes of `element`
    int element;
    double dissipation;  ///< by friction [W]
    double contact;      ///< generalized force of a support that holds it, on its coordinate [N]
  };
  virtual std::optional<Answer> accelerate(const double* q, const double* rate, const Vector& gravity,
                                           double* a) const = 0;
  /// The same of velocities `p` that a momentum means without it; false where there are none.
  virtual bool solve(const double* q, double* p) const = 0;
  /// Adds the momentum of the mass moving with `v`, of the nodes and of its coordinate.
  virtual void add_momentum(const double* q, const double* rate, const Vector& v, double* out) const = 0;
};

}  // namespace vlbeam
