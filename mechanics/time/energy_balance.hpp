#pragma once

#include <Eigen/Core>

#include "mechanics/time/archive.hpp"

namespace vlbeam {

/// What has been supplied since the start, or its rate; the motion does not depend on it. Energies [J], unless said.
struct EnergyBalance {
  double dissipated = 0;  ///< by damping and friction
  double loads = 0;       ///< done by loads
  double ends = 0;        ///< by what drives angles; where beam flows, all that its supports do and matter brings along
  double supports = 0;    ///< done by supports that move, and by guides
  double mesh = 0;        ///< work of moving inner nodes along the beam: discretisation error only
  double mass = 0;        ///< in through the ends [kg]
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();  ///< of supports, loads, gravity, and in with the matter [N s]
  double impulse_about_axis = 0;                      ///< about the axis [N m s]

  void exchange(Archive& memory) {
    for (double* entry : {&dissipated, &loads, &ends, &supports, &mesh, &mass}) memory(*entry);
    for (double& component : impulse) memory(component);
    memory(impulse_about_axis);
  }

  friend EnergyBalance operator+(const EnergyBalance& a, const EnergyBalance& b) {
    return {a.dissipated + b.dissipated,
            a.loads + b.loads,
            a.ends + b.ends,
            a.supports + b.supports,
            a.mesh + b.mesh,
            a.mass + b.mass,
            a.impulse + b.impulse,
            a.impulse_about_axis + b.impulse_about_axis};
  }
  friend EnergyBalance operator*(double h, const EnergyBalance& a) {
    return {h * a.dissipated, h * a.loads, h * a.ends,    h * a.supports,
            h * a.mesh,       h * a.mass,  h * a.impulse, h * a.impulse_about_axis};
  }
};

/// Which of them a state counts: at its end, behind coordinates and rates, in the order of EnergyBalance.
struct BalanceEntries {
  bool dissipated = false, loads = false, ends = false, supports = false;
  int impulse = 0;  ///< its components, where it and the rest are counted: of a beam whose nodes are prescribed

  Eigen::Index count() const {
    EnergyBalance none;
    Eigen::Index entries = 0;
    for_each(0, none, [&](Eigen::Index, double&) { ++entries; });
    return entries;
  }

  /// What the end of `y` holds; zero of what is not counted.
  EnergyBalance of(const Eigen::VectorXd& y) const {
    EnergyBalance result;
    for_each(y.size() - count(), result, [&](Eigen::Index at, double& entry) { entry = y[at]; });
    return result;
  }
  /// Adds to the end of `y`, a state or its rates.
  template <class Vector>
  void add(EnergyBalance more, Vector&& y) const {
    for_each(y.size() - count(), more, [&](Eigen::Index at, const double& entry) { y[at] += entry; });
  }

 private:
  /// Visits the entries of a state that stand from `at` on.
  template <class Visit>
  void for_each(Eigen::Index at, EnergyBalance& tally, const Visit& visit) const {
    if (dissipated) visit(at++, tally.dissipated);
    if (loads) visit(at++, tally.loads);
    if (ends) visit(at++, tally.ends);
    if (supports) visit(at++, tally.supports);
    if (impulse == 0) return;
    visit(at++, tally.mesh);
    visit(at++, tally.mass);
    for (int c = 0; c < impulse; ++c) visit(at++, tally.impulse[c]);
    visit(at, tally.impulse_about_axis);
  }
};

}  // namespace vlbeam
