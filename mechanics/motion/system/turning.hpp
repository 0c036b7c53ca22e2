#pragma once

#include <algorithm>

#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

/// How fast a beam turns [rad/s]: the mean over its nodes of the turning of their slopes, in which vibrations cancel;
/// or the path of a mass that slides freely, which curves as the beam does between its neighbours, where that is more.
/// `q` and `v` are arrays of coordinates and their rates.
template <int D>
double turning_of(const CurrentBeam<D>& beam, const double* q, const double* v) {
  const int last = beam.mesh().last();
  Vec<double, 3> sum = Vec<double, 3>::Zero();
  for (int k = 0; k <= last; ++k) {
    const auto s = slope<D>(q, k), rate = slope<D>(v, k);
    const double size = s.squaredNorm();
    sum[2] += (s[0] * rate[1] - s[1] * rate[0]) / size;
    if constexpr (D == 3) {
      sum[0] += (s[1] * rate[2] - s[2] * rate[1]) / size;
      sum[1] += (s[2] * rate[0] - s[0] * rate[2]) / size;
    }
  }
  double fastest = sum.norm() / (last + 1);
  for (std::size_t i = 0; i < beam.places().size(); ++i) {
    if (beam.feeds(i) || beam.guides(i) || beam.held(i) != nullptr) continue;
    const JointPlace& place = beam.places()[i];
    const double apart = beam.mark_of(place.node + 1, q) - beam.mark_of(place.node - 1, q);
    const Vec<double, D> turn = slope<D>(q, place.node + 1).normalized() - slope<D>(q, place.node - 1).normalized();
    fastest = std::max(fastest, std::abs(v[place.mark]) * turn.norm() / apart);
  }
  return fastest;
}

}  // namespace vlbeam
