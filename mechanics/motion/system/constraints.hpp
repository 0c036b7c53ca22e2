#pragma once

namespace vlbeam {

/// How an implicit method treats supports.
enum class Constraints {
  eliminated,   ///< the coordinates they fix or tie are left out
  multipliers,  ///< they are equations, and their reactions unknowns
};

}  // namespace vlbeam
