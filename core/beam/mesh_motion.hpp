#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

namespace vlbeam {

/// A quantity that is given as a function of time, with its first two derivatives.
struct Prescribed {
  double value = 0, rate = 0, acceleration = 0;
};
using TimeFunction = std::function<Prescribed(double t)>;

/// value + rate t.
inline TimeFunction steadily(double value, double rate) {
  return [=](double t) { return Prescribed{value + rate * t, rate, 0}; };
}

/// What grows smoothly from 0 to 1 within `duration` [s]: S(t/duration), S(s) = s^4 (35 - 84 s + 70 s^2 - 20 s^3), with
/// three continuous derivatives; 0 before and 1 behind, and so a step at t = 0 where the duration is 0.
inline Prescribed smooth_ramp(double t, double duration) {
  if (t >= duration) return {1, 0, 0};
  if (t <= 0) return {0, 0, 0};
  const double s = t / duration, v = s * (1 - s);
  return {s * s * s * s * (35 + s * (-84 + s * (70 - 20 * s))), 140 * v * v * v / duration,
          420 * v * v * (1 - 2 * s) / (duration * duration)};
}

/// Index of the element between nodes at `marks` that holds the material point x; of the first or the last one beyond
/// the ends.
inline int element_at(const std::vector<Prescribed>& marks, double x) {
  const auto next = std::upper_bound(marks.begin() + 1, marks.end() - 1, x,
                                     [](double at, const Prescribed& node) { return at < node.value; });
  return static_cast<int>(next - marks.begin()) - 1;
}

/// Material coordinates of the nodes of a chain as functions of time: those of some nodes are given, the ones between
/// them divide the distance in fixed proportions, and so move with them.
class MeshMotion {
 public:
  struct Guide {
    int node;
    TimeFunction x;  ///< [m]
  };

  MeshMotion() = default;
  /// `guides` in increasing order of their nodes, the first and the last node among them; elements between two
  /// neighbouring guides are of equal length. Throws ModelError where the nodes do not increase from 0.
  explicit MeshMotion(std::vector<Guide> guides);

  int last() const { return guides_.empty() ? 0 : guides_.back().node; }  ///< index of the last node
  /// Writes the material coordinates of all nodes at time t.
  void at(double t, std::vector<Prescribed>& nodes) const;

  /// An instant at which an element is shorter than `shortest` [m].
  struct Tangle {
    double t;
    int element;
    double length;
  };
  /// The first such instant in [from, to], to 1e-9 of the interval; elements that are too short for less than a 2000th
  /// of it may be missed.
  std::optional<Tangle> tangle(double from, double to, double shortest) const;

 private:
  /// Length of an element between guides k and k + 1 at time t.
  double length(std::size_t k, double t) const;

  std::vector<Guide> guides_;
};

}  // namespace vlbeam
