#include "core/element/moving_residual.hpp"

#include "core/element/active.hpp"
#include "core/element/active_pack.hpp"

namespace vlbeam {
namespace {

/// Whether the element is what numbers in lanes know.
template <int D>
bool has_lanes(const MovingLaw<D>& law) {
  return law.rest == nullptr && law.transport == WeightTransport::frozen && !law.section.damped();
}

template <class Real, int D>
MovingCoordinates<Real, D> constants(const MovingCoordinates<double, D>& of) {
  const auto cast = [](const Vec<double, D>& v) {
    Vec<Real, D> result;
    for (int c = 0; c < D; ++c) result[c] = Real(v[c]);
    return result;
  };
  return {{cast(of.e.r_a), cast(of.e.s_a), cast(of.e.r_b), cast(of.e.s_b)}, Real(of.x_a), Real(of.x_b)};
}

/// `part` of each number of a residual.
template <MovingEnds Ends, class Real, int D, class Part>
MovingResidual<double, D, Ends> take(const MovingResidual<Real, D, Ends>& from, const Part& part) {
  MovingResidual<double, D, Ends> r;
  for (std::size_t i = 0; i < 4; ++i) {
    for (int c = 0; c < D; ++c) r.nodes[i][c] = part(from.nodes[i][c]);
  }
  for (std::size_t e = 0; e < r.ends.size(); ++e) r.ends[e] = part(from.ends[e]);
  return r;
}

// Flattened: the compiler otherwise leaves the arithmetic of lanes in calls.

template <MovingEnds Ends, int D>
[[gnu::flatten]] MovingResidual<Pack, D, Ends> in_packs(const MovingCoordinates<double, D>& q,
                                                        const MovingCoordinates<double, D>& rate,
                                                        const MovingCoordinates<double, D>& a,
                                                        const WeightFunction& weights, const PackTabulation& table,
                                                        const MovingLaw<D>& law) {
  return moving_residual<Ends, Pack, D>(constants<Pack, D>(q), constants<Pack, D>(rate), constants<Pack, D>(a), weights,
                                        table, law);
}

template <MovingEnds Ends, int D>
[[gnu::flatten]] MovingResidual<ActivePack, D, Ends> in_active_packs(const MovingCoordinates<ActivePack, D>& q,
                                                                     const MovingCoordinates<ActivePack, D>& rate,
                                                                     const MovingCoordinates<ActivePack, D>& a,
                                                                     const WeightFunction& weights,
                                                                     const PackTabulation& table,
                                                                     const MovingLaw<D>& law) {
  return moving_residual<Ends, ActivePack, D>(q, rate, a, weights, table, law);
}

}  // namespace

template <MovingEnds Ends, int D>
MovingResidual<double, D, Ends> residual_of(const MovingCoordinates<double, D>& q,
                                            const MovingCoordinates<double, D>& rate,
                                            const MovingCoordinates<double, D>& a, const WeightFunction& weights,
                                            const PointTables& tables, const MovingLaw<D>& law, double& dissipation) {
  if constexpr (Ends != MovingEnds::both) {  // joints beside each other are rare
    if (has_lanes(law)) {
      return take<Ends, Pack, D>(in_packs<Ends, D>(q, rate, a, weights, tables.four, law),
                                 [](const Pack& x) { return x.sum(); });
    }
  }
  return moving_residual<Ends, double, D>(q, rate, a, weights, tables.one, law, &dissipation);
}

template <MovingEnds Ends, int D>
MovingResidual<double, D, Ends> residual_by_end(int e, const MovingCoordinates<double, D>& q,
                                                const MovingCoordinates<double, D>& rate,
                                                const MovingCoordinates<double, D>& a, const TangentWeights& by,
                                                const WeightFunction& weights, const PointTables& tables,
                                                const MovingLaw<D>& law) {
  if constexpr (Ends != MovingEnds::both) {
    if (has_lanes(law)) {
      const auto along_end = [e](const MovingCoordinates<double, D>& from, double scale) {
        auto result = constants<ActivePack, D>(from);
        ActivePack& x = is_end_a<Ends>(e) ? result.x_a : result.x_b;
        x = ActivePack(x.value(), Pack(scale));
        return result;
      };
      return take<Ends, ActivePack, D>(in_active_packs<Ends, D>(along_end(q, by.q), along_end(rate, by.v),
                                                                along_end(a, by.a), weights, tables.four, law),
                                       [](const ActivePack& x) { return x.by().sum(); });
    }
  }
  using Real = Active<1>;
  const auto along_end = [e](const MovingCoordinates<double, D>& from, double scale) {
    auto result = constants<Real, D>(from);
    (is_end_a<Ends>(e) ? result.x_a : result.x_b).derivatives()[0] = scale;
    return result;
  };
  return take<Ends, Real, D>(moving_residual<Ends, Real, D>(along_end(q, by.q), along_end(rate, by.v),
                                                            along_end(a, by.a), weights, tables.one, law),
                             [](const Real& x) { return x.derivatives()[0]; });
}

#define VLBEAM_MOVING_RESIDUAL(ENDS, D)                                                                              \
  template MovingResidual<double, D, ENDS> residual_of<ENDS, D>(                                                     \
      const MovingCoordinates<double, D>&, const MovingCoordinates<double, D>&, const MovingCoordinates<double, D>&, \
      const WeightFunction&, const PointTables&, const MovingLaw<D>&, double&);                                      \
  template MovingResidual<double, D, ENDS> residual_by_end<ENDS, D>(                                                 \
      int, const MovingCoordinates<double, D>&, const MovingCoordinates<double, D>&,                                 \
      const MovingCoordinates<double, D>&, const TangentWeights&, const WeightFunction&, const PointTables&,         \
      const MovingLaw<D>&)
VLBEAM_MOVING_RESIDUAL(MovingEnds::a, 2);
VLBEAM_MOVING_RESIDUAL(MovingEnds::b, 2);
VLBEAM_MOVING_RESIDUAL(MovingEnds::both, 2);
VLBEAM_MOVING_RESIDUAL(MovingEnds::a, 3);
VLBEAM_MOVING_RESIDUAL(MovingEnds::b, 3);
VLBEAM_MOVING_RESIDUAL(MovingEnds::both, 3);
#undef VLBEAM_MOVING_RESIDUAL

}  // namespace vlbeam
