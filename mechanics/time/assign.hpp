#pragma once

#include <Eigen/Core>

#include <algorithm>

#include "core/pieces.hpp"

namespace vlbeam {

/// Writes some entries of an expression of vectors to one of its size.
template <class Expression>
void assign_piece(Eigen::Ref<Eigen::VectorXd> to, const Expression& expression, Eigen::Index first,
                  Eigen::Index count) {
  if constexpr ((Expression::Flags & Eigen::DirectAccessBit) != 0) {  // a vector, or a part of one
    std::copy_n(expression.data() + first, count, to.data() + first);
  } else {
    to.segment(first, count) = expression.segment(first, count);
  }
}

/// Writes an expression of vectors, entry by entry, in pieces, to one of its size.
template <class Expression>
void assign_to(Eigen::Ref<Eigen::VectorXd> to, const Expression& expression) {
  in_pieces(to.size(), 1, [&](Eigen::Index first, Eigen::Index count) { assign_piece(to, expression, first, count); });
}

/// Writes two expressions of one size in one pass. An entry of the second may depend on the same entry of the first,
/// which is written before it.
template <class A, class B>
void assign_both_to(Eigen::Ref<Eigen::VectorXd> a, const A& of_a, Eigen::Ref<Eigen::VectorXd> b, const B& of_b) {
  eigen_assert(a.size() == b.size());
  in_pieces(a.size(), 1, [&](Eigen::Index first, Eigen::Index count) {
    assign_piece(a, of_a, first, count);
    assign_piece(b, of_b, first, count);
  });
}

/// The same to one that gets its size.
template <class Expression>
void assign(Eigen::VectorXd& to, const Expression& expression) {
  to.resize(expression.size());
  assign_to(to, expression);
}

/// The same to two that get their size. If the second expression reads the first vector, that has its size already.
template <class A, class B>
void assign_both(Eigen::VectorXd& a, const A& of_a, Eigen::VectorXd& b, const B& of_b) {
  a.resize(of_a.size());
  b.resize(of_b.size());
  assign_both_to(a, of_a, b, of_b);
}

}  // namespace vlbeam
