#pragma once

#include <functional>
#include <vector>

#include "scene/scene.hpp"
#include "studies/exact_solutions/axis.hpp"
#include "studies/exact_solutions/problem.hpp"

namespace vlbeam::exact_solutions {

/// A beam or cable in balance, and what is known of it.
struct Balance {
  std::function<Scene(int elements, double EA)> scene;
  std::function<std::vector<double>(const Scene&, const RunResult&)> values;
  /// The axis at a material coordinate of an element.
  std::function<AxisPoint(const Scene&, const RunResult&, double x, std::size_t element)> axis = {};
  double EA = 1;
  /// The reference does not stretch: what falls as 1/EA is extrapolated away, by a second run with twice of it.
  bool inextensible = false;
};

/// What becomes of it on a mesh.
Found in_balance(const Balance& balance, int elements);

/// The balance on the meshes of the family, against what is known: errors of values over the length, of the axis over
/// the length and its root.
Problem on_meshes(const FamilyData& data, const std::string& family, const std::string& name, Known known,
                  Balance balance, double length);

/// A beam or a cable (EI = 0) of ALE-ANCF elements without weight, in statics, that runs along a line to `end`.
Scene beam_at_rest(int elements, double EA, double EI, const Point& end, AxialStrain strain);

/// A dead force at a node.
LoadSpec force_at(int node, double force, const Point& direction);

/// The law of a case, by its name.
Stretching stretching_of(const std::string& law);
/// Of the elements; those that hardly stretch have Green's law.
StrainLaw strain_law_of(Stretching law);

/// The number of elements of a level.
inline int count(double level) { return static_cast<int>(level); }

/// Whether an element is before the first joint of a result, whose node is the last one that is not behind it.
bool before_joint(const RunResult& result, std::size_t element);

}  // namespace vlbeam::exact_solutions
