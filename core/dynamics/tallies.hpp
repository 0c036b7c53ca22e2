#pragma once

#include <Eigen/Core>

namespace vlbeam {

/// Energies [J] since the start, or powers [W], that the motion does not depend on.
struct Tally {
  double dissipated = 0;  ///< by damping and friction
  double loads = 0;       ///< done by loads
  double drives = 0;      ///< done by what drives angles
  double supports = 0;    ///< done by supports that move

  friend Tally operator+(const Tally& a, const Tally& b) {
    return {a.dissipated + b.dissipated, a.loads + b.loads, a.drives + b.drives, a.supports + b.supports};
  }
  friend Tally operator*(double h, const Tally& a) {
    return {h * a.dissipated, h * a.loads, h * a.drives, h * a.supports};
  }
};

/// Which of them a state counts: at its end, behind coordinates and rates, in the order of Tally.
struct Tallies {
  bool dissipated = false, loads = false, drives = false, supports = false;

  Eigen::Index count() const {
    return Eigen::Index{dissipated} + Eigen::Index{loads} + Eigen::Index{drives} + Eigen::Index{supports};
  }

  /// What the end of `y` holds; zero of what is not counted.
  Tally of(const Eigen::VectorXd& y) const {
    Tally result;
    for_each(y.size(), result, [&](Eigen::Index at, double& entry) { entry = y[at]; });
    return result;
  }
  /// Adds to the end of `y`, a state or its rates.
  template <class Vector>
  void add(Tally more, Vector&& y) const {
    for_each(y.size(), more, [&](Eigen::Index at, const double& entry) { y[at] += entry; });
  }

 private:
  template <class Visit>
  void for_each(Eigen::Index size, Tally& tally, const Visit& visit) const {
    Eigen::Index at = size - count();
    if (dissipated) visit(at++, tally.dissipated);
    if (loads) visit(at++, tally.loads);
    if (drives) visit(at++, tally.drives);
    if (supports) visit(at, tally.supports);
  }
};

}  // namespace vlbeam
