#pragma once

#include <string>
#include <vector>

#include "scene/result.hpp"
#include "studies/harness/report.hpp"

namespace vlbeam {

/// A run under the name its columns carry.
struct NamedRun {
  std::string name;
  const RunResult* result;
};

/// Table of quantities of planar runs against time. Columns are "<quantity>_<run>"; a cell is empty if the run has no
/// value. Quantities: joint, mass_x, mass_y, end_x, end_y, beam_length, beam_length_rate, and the energies kinetic,
/// axial, bending, strain, gravity, total. The runs must have the same samples.
Table histories(const std::string& name, const std::string& caption, const std::vector<NamedRun>& runs,
                const std::vector<std::string>& quantities);

/// Whole shapes of planar runs at the times kept, `points` material points of each: columns "<run>_<t>_x" and "..._y".
Table shapes(const std::string& name, const std::string& caption, const std::vector<NamedRun>& runs, int points);

/// Where the nodes and the mass of planar runs are at the times kept: columns run, t, x, y, joint (1 at the mass).
Table shape_nodes(const std::string& name, const std::string& caption, const std::vector<NamedRun>& runs);

}  // namespace vlbeam
