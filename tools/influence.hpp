#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace vlbeam {

/// What is asked of a beam at rest.
struct InfluenceOptions {
  std::vector<std::string> quantities;  ///< as samples name them
  std::optional<double> force = {};     ///< [N] by which it is disturbed; if not given, small beside what it bears
  std::optional<Point> direction = {};  ///< of the load; along gravity if not given, or against the last axis but x
  int intervals = 1;                    ///< an element, at whose ends the load stands: at 1 the nodes
  int jobs = 1;                         ///< equilibria at a time
};

/// Ordinates of influence lines: what one newton at a material coordinate adds to a quantity.
struct Influence {
  struct Line {
    std::string quantity, unit;     ///< of the ordinates, with N below: 1 where the quantity is a force
    std::vector<double> ordinates;  ///< NaN where there is no equilibrium
    double least = 0, at_least = 0, largest = 0, at_largest = 0, area = 0;  ///< area: what one newton a metre adds
  };
  double force = 0;
  std::vector<double> x;  ///< where the load stands [m]
  std::vector<Line> lines;
  std::string failure;  ///< why an ordinate is missing, of the first
};

/// Influence lines about the equilibrium of a scene of statics: half the difference of what a small force and its
/// opposite make of the quantity, over the force. Throws InvalidInput for what is not understood.
Influence influence(const Scene& scene, const InfluenceOptions& options);

/// A table of the ordinates, a line each place; and for a reader at the terminal.
std::string influence_table(const Influence& found);
std::string influence_summary(const Influence& found);

}  // namespace vlbeam
