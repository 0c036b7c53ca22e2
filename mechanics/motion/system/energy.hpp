#pragma once

namespace vlbeam {

/// Energies [J]. `gravity` is the potential energy, `dissipated` what damping has taken since the start, and
/// `supplied` the work that moving supports have done: total() - supplied is what is conserved.
struct Energy {
  double kinetic = 0;
  double axial = 0;
  double bending = 0;
  double gravity = 0;
  double dissipated = 0;
  double torsion = 0;
  double supplied = 0;

  double total() const { return kinetic + axial + bending + gravity + dissipated + torsion; }

  Energy& operator+=(const Energy& other) {
    kinetic += other.kinetic;
    axial += other.axial;
    bending += other.bending;
    gravity += other.gravity;
    dissipated += other.dissipated;
    torsion += other.torsion;
    supplied += other.supplied;
    return *this;
  }
  friend Energy operator+(Energy a, const Energy& b) { return a += b; }
  friend Energy operator-(const Energy& a, const Energy& b) {
    return {a.kinetic - b.kinetic,       a.axial - b.axial,     a.bending - b.bending,  a.gravity - b.gravity,
            a.dissipated - b.dissipated, a.torsion - b.torsion, a.supplied - b.supplied};
  }
};

}  // namespace vlbeam
