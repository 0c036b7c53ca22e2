#pragma once

#include <vector>

#include "core/beam/node_map.hpp"
#include "mechanics/motion/system/unknowns.hpp"
#include "mechanics/time/energy_balance.hpp"
#include "mechanics/time/fields.hpp"

namespace vlbeam {

/// Where everything stands in a state y = (q, q', balance). The coordinates q are, in this order: the nodes, position
/// and slope each; the material coordinates of joints, or of a mass that rides; the slopes behind joints that are
/// kinked; the positions of masses that have left; the angles of a beam that spins; multipliers, where there are any.
template <int D>
struct DofMap {
  int nodes = 0, marks = 0, kinks = 0, free_masses = 0;
  Eigen::Index turning = 0, multipliers = 0;  ///< how many there are of angles (and twists), and of multipliers
  BalanceEntries balance = {};

  Eigen::Index mark(int i = 0) const { return Eigen::Index{node_size<D>} * nodes + i; }
  Eigen::Index kink(int i = 0) const { return mark(marks) + Eigen::Index{D} * i; }
  Eigen::Index free_mass(int i = 0) const { return kink(kinks) + Eigen::Index{D} * i; }
  Eigen::Index angle() const { return free_mass(free_masses); }
  Eigen::Index multiplier() const { return angle() + turning; }
  Eigen::Index coordinates() const { return multiplier() + multipliers; }
  Eigen::Index state() const { return 2 * coordinates() + balance.count(); }

  /// What they are, but for multipliers; `unknowns` is null without.
  std::vector<FieldRun> fields(const Unknowns<D>* unknowns) const {
    std::vector<FieldRun> runs = nodal_fields(D, nodes);
    if (marks > 0) runs.push_back({Field::mark, mark(), 1, 1, marks});
    if (kinks > 0) runs.push_back({Field::slope, kink(), D, D, kinks});
    if (free_masses > 0) runs.push_back({Field::mass, free_mass(), D, D, free_masses});
    if (unknowns != nullptr) unknowns->add_fields(angle(), runs);
    return runs;
  }
};

}  // namespace vlbeam
