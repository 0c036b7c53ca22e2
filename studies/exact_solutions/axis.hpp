#pragma once

#include <array>
#include <functional>
#include <vector>

#include "scene/scene.hpp"
#include "scene/shape.hpp"

namespace vlbeam::exact_solutions {

/// How a beam stretches: not at all, or by one of the strain laws.
enum class Stretching { none, green, engineering };

/// What a piece of a beam or a cable does that is bent by forces at its ends and by its weight, by initial values that
/// are known: reference/exact has the equations (elastica.py, catenary.py). No elements.
struct Piece {
  Stretching law = Stretching::none;
  double EA = 0, EI = 0;         ///< EI = 0: a cable
  std::array<double, 2> pull{};  ///< force at its start, on the piece from behind [N]: that with which it pulls
  double weight = 0;             ///< per reference length [N/m]
  double angle = 0, moment = 0;  ///< of a beam at its start [rad], [N m]
  double length = 1;             ///< [m]
  std::array<double, 2> start{};
};

/// Position and derivative by the material coordinate.
struct AxisPoint {
  std::array<double, 2> r, r_x;
};

/// A piece integrated in small steps of the classical Runge-Kutta method: 1e-12 of the length.
class KnownAxis {
 public:
  explicit KnownAxis(const Piece& piece);

  /// At the distance s from the start; also a little beyond either end.
  AxisPoint at(double s) const;
  std::array<double, 2> end() const { return at(piece_.length).r; }

 private:
  /// x, y, angle, moment.
  using State = std::array<double, 4>;
  State rates(const State& at, double s) const;
  State step(const State& from, double s, double h) const;

  Piece piece_;
  std::vector<State> states_;
};

/// Differences of an axis from the one that is known at equally spaced points of each element, with the shares of
/// Simpson's rule [m].
struct Differences {
  std::vector<double> share;
  std::vector<std::array<double, 2>> r, r_x;

  double displacement() const { return norm(r); }  ///< sqrt(integral |r - r_known|^2 dx)
  double slope() const { return norm(r_x); }

 private:
  double norm(const std::vector<std::array<double, 2>>& of) const;
};

/// `known` gives the point of the material coordinate x in an element.
Differences differences(const Scene& scene, const Configuration& shape,
                        const std::function<AxisPoint(double x, std::size_t element)>& known);

/// As beyond(), member by member.
Differences beyond(const Differences& a, const Differences& b);

}  // namespace vlbeam::exact_solutions
