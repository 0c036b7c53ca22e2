#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/element/twice_active.hpp"
#include "mechanics/frames/triad.hpp"

namespace vlbeam {

/// How the sections of a beam in space stand at rest, as a function of the material coordinate: what a node that moves,
/// or that is new, follows. Either y axes are as near a given direction as they can be, or from node to node of the
/// mesh that there was at the start they go by smallest rotations.
class RestTriads {
 public:
  /// `orientation` is that direction, 0 for none; `x` and `at` are the nodes and how sections stood there.
  RestTriads(Vec<double, 3> orientation, std::vector<double> x, std::vector<TriadReference> at)
      : orientation_(std::move(orientation)), x_(std::move(x)), at_(std::move(at)) {}

  /// The y axis at `x`, where the rest curve has the slope `s` with its derivatives.
  template <class Real>
  Vec<Real, 3> direction(double x, const Vec<Real, 3>& s) const {
    using std::sqrt;
    const Vec<Real, 3> t = s / Real(sqrt(s.dot(s)));
    if (orientation_ == Vec<double, 3>::Zero()) {
      const auto k = static_cast<std::size_t>(std::upper_bound(x_.begin() + 1, x_.end() - 1, x) - x_.begin()) - 1;
      return carried<Real>(at_[k].t.cast<Real>(), t, at_[k].d.cast<Real>());
    }
    const Vec<Real, 3> given = orientation_.cast<Real>(), across = given - t * Real(t.dot(given));
    return across / Real(sqrt(across.dot(across)));
  }
  /// How fast sections turn about the tangent along the rest curve at `x` [rad/m], and how that changes with x. `curve`
  /// is the rest curve there, with its first three derivatives.
  std::array<double, 2> turning(double x, const std::array<Vec<double, 3>, 4>& curve) const {
    Vec<TwiceActive, 3> s;
    for (int c = 0; c < 3; ++c) s[c] = TwiceActive(curve[1][c], curve[2][c], 0, curve[3][c], 0, 0);
    const Vec<TwiceActive, 3> y = direction<TwiceActive>(x, s), t = s / sqrt(s.dot(s)), z = t.cross(y);
    std::array<double, 2> result{};
    for (int c = 0; c < 3; ++c) {
      result[0] += z[c].value * y[c].a;
      result[1] += z[c].a * y[c].a + z[c].value * y[c].aa;
    }
    return result;
  }

 private:
  Vec<double, 3> orientation_;
  std::vector<double> x_;
  std::vector<TriadReference> at_;
};

}  // namespace vlbeam
