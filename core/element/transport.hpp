#pragma once

namespace vlbeam {

/// How the rational weights follow the moving ends of a variable-length element.
enum class WeightTransport {
  frozen,       ///< the four weights stay constant while the length changes (Ding & Ouyang 2022)
  transported,  ///< W(x) belongs to the material points; the weights are its restriction to the current interval
};

/// Which equations of motion hold at a moving node.
enum class Formulation {
  variational,   ///< Lagrange's equations of the discrete Lagrangian: conserves energy
  virtual_work,  ///< virtual work at fixed material points (Ding & Ouyang 2022, Eq. 17): misses the configurational
                 ///< force
};

}  // namespace vlbeam
