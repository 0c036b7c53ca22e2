#pragma once

namespace vlbeam {

/// How beam lies on a winch before it comes in.
enum class Winding {
  stretched,    ///< as it is at the outlet
  unstretched,  ///< as it is without a force
};

}  // namespace vlbeam
