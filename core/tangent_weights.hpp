#pragma once

namespace vlbeam {

/// Weights of the derivatives of a residual r(q, q', q'') in a tangent, q dr/dq + v dr/dq' + a dr/dq'': {1, 0, 0} is
/// the stiffness, {0, 0, 1} the mass, {1, by_v, by_a} what Newton's iteration of an implicit step needs.
struct TangentWeights {
  double q, v, a;
};

}  // namespace vlbeam
