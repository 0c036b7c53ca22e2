#pragma once

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "tools/observed_order.hpp"

namespace vlbeam {

/// How a scene is discretized.
struct Setting {
  int elements = 0;
  int points = 0;       ///< of quadrature, an element
  double accuracy = 0;  ///< step [s] of methods that do not choose it, else the relative tolerance; the absolute one
                        ///< keeps its ratio to it, and the longest step of generalized-alpha, cubed

  bool operator==(const Setting&) const = default;
};

/// The scene's own.
Setting setting_of(const Scene& scene);

/// The scene that refinement starts from. An automatic integrator then errs less in time than the mesh does in space.
Scene to_converge(const Scene& scene);

/// The scene in another setting. Node numbers name the same material points on the new mesh. Throws InvalidInput where
/// a node would fall between two others, or the scene cannot be modelled so.
Scene with_setting(const Scene& scene, const Setting& setting);

/// What a level refines.
enum class Refined { mesh, time, quadrature };

/// One run of the scene, and what became of the quantity.
struct ConvergeLevel {
  Setting setting;
  Refined refined = Refined::mesh;
  std::string failure;         ///< why there is no value, or empty
  double value = 0;            ///< NaN where there is none
  std::vector<double> series;  ///< at the samples
  double work = 0;  ///< evaluations of the right-hand side or residual (of an equilibrium, Newton iterations),
                    ///< times elements and points
  std::size_t events = 0;
  double seconds = 0;
};

/// What is asked of a scene, and what it may cost.
struct ConvergeOptions {
  std::string quantity;
  double error = 0;               ///< wanted, in the quantity's unit, or of its magnitude
  bool relative = false;          ///< the latter
  std::optional<double> at = {};  ///< [s]; the scene's duration if not given
  bool horizon = false;           ///< also until when the motion can be predicted at all
  int jobs = 1;                   ///< runs at a time; the answer does not depend on it
  int most_elements = 1280;       ///< of the finest mesh
  double budget = 15;             ///< all runs together, in runs of the finest setting
  double seconds =
      std::numeric_limits<double>::infinity();              ///< wall time, after which what is known then is the answer
  std::function<void(const ConvergeLevel&)> on_level = {};  ///< called after each, in their order
};

/// How far the quantity can be trusted.
struct Convergence {
  std::string quantity, unit;
  double t = 0;            ///< [s]; of an equilibrium the load factor
  double error = 0;        ///< wanted, in the unit
  double answer = 0;       ///< of the finest setting
  double uncertainty = 0;  ///< of the answer: those of mesh, time and quadrature together
  bool reached = false;
  std::string reason;  ///< why it was not reached
  Setting finest;
  std::optional<Setting> cheapest;  ///< of the settings run: the least work that keeps the error wanted
  std::array<std::optional<GridConvergence>, 3> parts;  ///< by Refined
  double predictable_until = 0;                         ///< [s], samples: the error wanted is kept until then
  std::optional<double> horizon;  ///< [s]: a change of the density by 1e-8 is worth less than the error until then
  std::vector<ConvergeLevel> levels;
  double cost = 0;  ///< work of all runs over that of the finest
};

/// Refines mesh, time and quadrature of a scene, of an equilibrium without time, each by itself, until the quantity is
/// known to the error wanted, or until that cannot be reached. Throws InvalidInput for what is not understood, and for
/// an error no level can show.
Convergence converge(const Scene& scene, const ConvergeOptions& options);

/// The report (`vlbeam schema converge`), and the table of its levels.
Json convergence_to_json(const Scene& scene, const Convergence& found);
std::string convergence_table(const Scene& scene, const Convergence& found);

/// For a reader at the terminal: of one level, with a line's end, and of all.
std::string level_line(const Scene& scene, const ConvergeLevel& level);
std::string convergence_summary(const Scene& scene, const Convergence& found);

}  // namespace vlbeam
