#pragma once

#include <Eigen/Core>

#include <algorithm>

#include "core/pieces.hpp"

namespace vlbeam {

/// Writes an expression of vectors, entry by entry, in pieces, to one of its size.
template <class Expression>
void assign_to(Eigen::Ref<Eigen::VectorXd> to, const Expression& expression) {
  in_pieces(to.size(), 1, [&](Eigen::Index first, Eigen::Index count) {
    if constexpr ((Expression::Flags & Eigen::DirectAccessBit) != 0) {  // a vector, or a part of one
      std::copy_n(expression.data() + first, count, to.data() + first);
    } else {
      to.segment(first, count) = expression.segment(first, count);
    }
  });
}

/// The same to one that gets its size.
template <class Expression>
void assign(Eigen::VectorXd& to, const Expression& expression) {
  to.resize(expression.size());
  assign_to(to, expression);
}

}  // namespace vlbeam
