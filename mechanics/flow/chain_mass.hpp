#pragma once

#include <array>
#include <vector>

#include "core/beam/mesh.hpp"
#include "core/beam/node_block.hpp"
#include "core/beam/node_map.hpp"

namespace vlbeam {

/// Mass matrix of a chain of elements whose lengths change: a block tridiagonal matrix of positions and slopes, the
/// same for all components but for what supports fix and what is added to some components only. Assembled and factored
/// anew at every evaluation.
template <int D>
class ChainMass {
 public:
  using Components = Eigen::Array<double, D, 1>;

  /// A zero matrix of `nodes` nodes.
  void reset(int nodes) {
    diagonal_.assign(static_cast<std::size_t>(nodes), {});
    coupling_.resize(static_cast<std::size_t>(nodes));
  }

  /// Adds the mass matrix of element k, order r_A, s_A, r_B, s_B; once for each element.
  void add(int k, const std::array<std::array<double, 4>, 4>& m) {
    const auto i = static_cast<std::size_t>(k);
    diagonal_[i].rr += m[0][0];
    diagonal_[i].rs += m[0][1];
    diagonal_[i].ss += m[1][1];
    diagonal_[i + 1].rr += m[2][2];
    diagonal_[i + 1].rs += m[2][3];
    diagonal_[i + 1].ss += m[3][3];
    auto all = [](double value) -> Components { return Components::Constant(value); };
    coupling_[i] = {all(m[0][2]), all(m[0][3]), all(m[1][2]), all(m[1][3])};
  }

  /// Adds the 4 x 4 matrix `m` to the components of element k with a 1 in `to`.
  template <class Matrix>
  void add_to(const Components& to, int k, const Matrix& m) {
    const auto i = static_cast<std::size_t>(k);
    diagonal_[i].rr += m(0, 0) * to;
    diagonal_[i].rs += m(0, 1) * to;
    diagonal_[i].ss += m(1, 1) * to;
    diagonal_[i + 1].rr += m(2, 2) * to;
    diagonal_[i + 1].rs += m(2, 3) * to;
    diagonal_[i + 1].ss += m(3, 3) * to;
    coupling_[i].rr += m(0, 2) * to;
    coupling_[i].rs += m(0, 3) * to;
    coupling_[i].sr += m(1, 2) * to;
    coupling_[i].ss += m(1, 3) * to;
  }

  /// Factors it on the free components (masks of 1 and 0, one pair a node). False where it is not positive.
  bool factor(const std::vector<std::array<Components, 2>>& free) {
    for (std::size_t k = 0; k < diagonal_.size(); ++k) {
      if (k > 0) {
        const auto& c = coupling_[k - 1];
        const auto& inv = diagonal_[k - 1];
        const Components rr = inv.rr * c.rr + inv.rs * c.sr, rs = inv.rr * c.rs + inv.rs * c.ss;
        const Components sr = inv.rs * c.rr + inv.ss * c.sr, ss = inv.rs * c.rs + inv.ss * c.ss;
        diagonal_[k].rr -= c.rr * rr + c.sr * sr;
        diagonal_[k].rs -= c.rr * rs + c.sr * ss;
        diagonal_[k].ss -= c.rs * rs + c.ss * ss;
      }
      diagonal_[k] = diagonal_[k].inverse(free[k][0], free[k][1]);
      const auto& inv = diagonal_[k];
      if (!(inv.rr.isFinite().all() && (inv.rr >= 0).all() && (inv.ss >= 0).all())) return false;
    }
    return true;
  }

  /// Solves in place; `f` holds position and slope of each node. Fixed components become zero.
  void solve(double* f) const {
    const int last = static_cast<int>(diagonal_.size()) - 1;
    Vec<double, D> r, s;
    for (int k = 0; k <= last; ++k) {
      r = position<D>(f, k);
      s = slope<D>(f, k);
      if (k > 0) {
        const auto& c = coupling_[static_cast<std::size_t>(k) - 1];
        const auto r_before = position<D>(f, k - 1).array(), s_before = slope<D>(f, k - 1).array();
        r.array() -= c.rr * r_before + c.sr * s_before;
        s.array() -= c.rs * r_before + c.ss * s_before;
      }
      apply_inverse(k, r, s);
      position<D>(f, k) = r;
      slope<D>(f, k) = s;
    }
    for (int k = last - 1; k >= 0; --k) {
      const auto& c = coupling_[static_cast<std::size_t>(k)];
      const auto r_behind = position<D>(f, k + 1).array(), s_behind = slope<D>(f, k + 1).array();
      r = c.rr * r_behind + c.rs * s_behind;
      s = c.sr * r_behind + c.ss * s_behind;
      apply_inverse(k, r, s);
      position<D>(f, k) -= r;
      slope<D>(f, k) -= s;
    }
  }

 private:
  void apply_inverse(int k, Vec<double, D>& r, Vec<double, D>& s) const {
    const auto& inv = diagonal_[static_cast<std::size_t>(k)];
    const Components a = r, b = s;
    r = inv.rr * a + inv.rs * b;
    s = inv.rs * a + inv.ss * b;
  }

  std::vector<NodeBlock<D>> diagonal_;  ///< once factored, inverses of the pivots
  std::vector<CouplingBlock<Components>> coupling_;
};

}  // namespace vlbeam
