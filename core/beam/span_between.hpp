#pragma once

#include "core/beam/span.hpp"

namespace vlbeam {

/// A run of fixed-length elements between two open nodes, `low` and `high`, where something else carries on. Its inner
/// nodes are eliminated from M a = force once and for all, which leaves a constant mass on the two open ones:
///   [S_ll  S_lh; S_hl  S_hh],  each a 2 x 2 matrix (position, slope) times the identity.
/// It is a span from `low`, held, to `high`, and what a unit acceleration of `low` makes of its nodes besides. It may
/// be a single node, low = high, that has no mass then.
template <int D>
class SpanBetween {
 public:
  using Coupling = CouplingBlock<double>;

  SpanBetween(const Mesh& mesh, int low, int high, const BeamSections& sections, const BeamRules& rules,
              const double* rest, const std::vector<PointMass>& masses)
      : span_(mesh, low, high, low == high ? Support<D>::free_end() : Support<D>::clamp(), sections, rules, rest,
              masses),
        low_(low),
        high_(high),
        low_low_{0, 0, 0, 0},
        low_high_{0, 0, 0, 0} {
    if (low < high) respond(mesh, sections, rules, masses);
  }

  const Span<D>& span() const { return span_; }
  int low() const { return low_; }
  int high() const { return high_; }
  const Coupling& low_low() const { return low_low_; }
  const Coupling& low_high() const { return low_high_; }  ///< row of `low`, column of `high`
  const NodeBlock<D>& high_high() const { return span_.open_mass(); }

  /// Eliminates the inner nodes: `force` holds the reduced forces at `low` and `high` then.
  void reduce(double* force) const {
    if (low_ == high_) return;
    Vec<double, D> on_r = position<D>(force, low_), on_s = slope<D>(force, low_);
    for (int node = low_ + 1; node < high_; ++node) {
      const Coupling& w = answer_[static_cast<std::size_t>(node - low_ - 1)];
      on_r += w.rr * position<D>(force, node) + w.sr * slope<D>(force, node);
      on_s += w.rs * position<D>(force, node) + w.ss * slope<D>(force, node);
    }
    span_.reduce(force);
    position<D>(force, low_) = on_r;
    slope<D>(force, low_) = on_s;
  }

  /// Accelerations of the inner nodes, given those of `low` and `high`, in place of the forces.
  void substitute(double* force) const {
    if (low_ == high_) return;
    const Vec<double, D> a_r = position<D>(force, low_), a_s = slope<D>(force, low_);
    span_.substitute(force);
    for (int node = low_ + 1; node < high_; ++node) {
      const Coupling& w = answer_[static_cast<std::size_t>(node - low_ - 1)];
      position<D>(force, node) += w.rr * a_r + w.rs * a_s;
      slope<D>(force, node) += w.sr * a_r + w.ss * a_s;
    }
    position<D>(force, low_) = a_r;
    slope<D>(force, low_) = a_s;
  }

 private:
  /// The accelerations that a unit one of `low` (its position in the first component, its slope in the second) makes
  /// of the inner nodes while `high` rests, and the forces that this takes.
  void respond(const Mesh& mesh, const BeamSections& sections, const BeamRules& rules,
               const std::vector<PointMass>& masses) {
    const auto e = static_cast<std::size_t>(low_);
    const auto& weights = mesh.weights[e].w;
    auto mass = fixed_inertia(mesh.x[e], mesh.x[e + 1], weights, rules.of(weights), sections.pieces).mass;
    for (auto& row : mass) {
      for (double& entry : row) entry *= sections.own.rhoA;
    }
    add_point_masses(masses, mesh, low_, mass);
    std::vector<double> nodal(static_cast<std::size_t>(node_size<D>) * static_cast<std::size_t>(high_ + 1), 0.0);
    double* const force = nodal.data();
    for (int unit = 0; unit < 2; ++unit) {
      const auto column = static_cast<std::size_t>(unit);
      position<D>(force, low_ + 1)[unit] = -mass[2][column];
      slope<D>(force, low_ + 1)[unit] = -mass[3][column];
    }
    span_.reduce(force);
    const auto entries = [&](int node) -> Coupling {
      const auto r = position<D>(force, node), s = slope<D>(force, node);
      return {r[0], r[1], s[0], s[1]};
    };
    const Coupling from_high = entries(high_);  // minus S_hl
    low_high_ = {-from_high.rr, -from_high.sr, -from_high.rs, -from_high.ss};
    position<D>(force, high_).setZero();
    slope<D>(force, high_).setZero();
    span_.substitute(force);
    answer_.clear();
    for (int node = low_ + 1; node < high_; ++node) answer_.push_back(entries(node));
    low_low_ = {mass[0][0], mass[0][1], mass[1][0], mass[1][1]};
    if (answer_.empty()) return;
    const Coupling& w = answer_.front();
    low_low_.rr += mass[0][2] * w.rr + mass[0][3] * w.sr;
    low_low_.rs += mass[0][2] * w.rs + mass[0][3] * w.ss;
    low_low_.sr += mass[1][2] * w.rr + mass[1][3] * w.sr;
    low_low_.ss += mass[1][2] * w.rs + mass[1][3] * w.ss;
  }

  Span<D> span_;
  int low_, high_;
  Coupling low_low_, low_high_;
  std::vector<Coupling> answer_;  ///< of the inner nodes, to unit accelerations of `low`
};

}  // namespace vlbeam
