#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "mechanics/statics/equilibrium.hpp"
#include "mechanics/statics/static_equations.hpp"

namespace vlbeam {

/// Looks for the equilibrium near a guess q, at a load factor. While joints are released together, the factor is the
/// share of the forces that held them that is gone, and the loads stand still.
template <int D>
class StaticSearch {
 public:
  static constexpr int most_corrections = 30;
  static constexpr int most_relaxations = 3000;
  static constexpr double largest_correction = 0.5;    // of the beam's length, and of slopes
  static constexpr double largest_relaxation = 0.05;   // the same, of one step of a relaxation
  static constexpr double by_rounding = 1e-7;          // corrections that no longer fall end the iteration from here on
  static constexpr double close = 0.05;                // corrections that free forces from their bounds
  static constexpr double near = 1e-3, nearly = 1e-6;  // corrections that lead from free forces to those of the strains
  static constexpr double least_force = 0.01;          // of a rope in search of its equilibrium, over what acts on it
  static constexpr double slack = 1e-10;               // over the axial stiffness: of a beam that holds nothing
  static constexpr double soft_in_bending = 1e-2;      // the same over that of bending, of a slender beam
  static constexpr double tangent_by_rounding = 1e-15;  // over what each element resists to stretch
  static constexpr double force_by_rounding = 2e-15;    // over EA
  static constexpr double rounding_share = 1e-3;        // of what acts: with more of it rounding hides the equilibrium
  static constexpr int most_events = 9;                 // of length control at one instant
  static constexpr double longest_slide = 0.25;         // of a joint that is released, over L_std
  static constexpr double end_distance = 1e-3;  // from an end of the beam at which a joint is too near, over L_std

  StaticSearch(BeamSystem<D>& of, const EquilibriumOptions& with, SolverCounters& counted)
      : system(of), equations(of), options(with), counters(counted), length(of.mesh().length()) {
    equations.keep_conditions(options.conditions_at_held);
    r = zero = Eigen::VectorXd::Zero(equations.size());
  }

  Eigen::VectorXd state_of(const Eigen::VectorXd& q) const {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(system.size());
    y.head(system.coordinates()) = q.head(system.coordinates());
    return y;
  }

  /// Joints that nothing guides.
  std::vector<std::size_t> free_joints() const {
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < system.places().size(); ++i) {
      if (!system.guides(i)) free.push_back(i);
    }
    return free;
  }

  /// The load factor itself.
  double load(double factor) const { return releasing ? 1 : factor; }

  Equilibrium point(const Eigen::VectorXd& q, double factor) {
    Equilibrium at{load(factor), state_of(q), 0};
    const Falls seen = falls(q, factor);
    at.negative_pivots = seen.surely;
    at.hidden_pivots = seen.perhaps - seen.surely;
    at.multipliers = q.tail(q.size() - system.coordinates());
    at.links = equations.link_forces(at.multipliers);
    at.joint_held = releasing ? factor < 1 : equations.holds_joints();
    at.holding = holding_forces(q, factor);
    for (std::size_t i = 0; i < at.holding.size() && !at.joint_held; ++i) {
      if (!equations.holds(i)) at.holding[i] = 0;
    }
    if (at.joint_held) at.holding_force = at.holding[slider];
    return at;
  }

  /// On the joints' material coordinates [N].
  std::vector<double> holding_forces(const Eigen::VectorXd& q, double factor) const {
    Eigen::VectorXd reactions;
    equations.reactions(q, load(factor), reactions);
    std::vector<double> forces;
    for (std::size_t i = 0; i < system.places().size(); ++i) forces.push_back(reactions[equations.mark(i)]);
    return forces;
  }
  double holding_force(const Eigen::VectorXd& q, double factor) const { return holding_forces(q, factor)[slider]; }

  /// Of positions over the beam's length, of slopes and of angles: the largest.
  double size(const Eigen::VectorXd& change) const {
    double largest = 0;
    for (int k = 0; k <= system.mesh().last(); ++k) {
      largest = std::max({largest, position<D>(change.data(), k).norm() / length, slope<D>(change.data(), k).norm()});
    }
    for (const JointPlace& place : system.places()) {
      largest = std::max(largest, std::abs(change[place.mark]) / length);
      if (place.behind >= 0) largest = std::max(largest, change.template segment<D>(place.behind).norm());
    }
    for (Eigen::Index k = 0; k < system.dofs().turning; ++k) {
      largest = std::max(largest, std::abs(change[system.angles() + k]));
    }
    return std::isfinite(change.sum()) ? largest : std::numeric_limits<double>::infinity();
  }

  /// Of forces, of moments over the mean length of an element, and of conditions on slopes times EA [N].
  double force_of(const Eigen::VectorXd& residual) const {
    const double element = length / system.mesh().elements();
    double sum = 0;
    for_each_coordinate(system.fields(), [&](Field field, Eigen::Index i) {
      const bool turns = field == Field::slope || field == Field::angle;
      const double force = turns ? residual[i] / element : residual[i];
      sum += force * force;
    });
    const double EA = system.model().section.stiffness.EA;
    return std::sqrt(sum + EA * EA * residual.tail(residual.size() - system.coordinates()).squaredNorm());
  }

  void impose(Eigen::VectorXd& q, double factor) const {
    Eigen::VectorXd y = state_of(q);
    system.impose(y, load(factor));
    q.head(system.coordinates()) = y.head(system.coordinates());
  }

  void residual(const Eigen::VectorXd& q, double factor) {
    ++counters.rhs_evaluations;
    equations.residual(q, load(factor), r);
    if (!releasing) return;
    for (const std::size_t i : free_joints()) r[equations.mark(i)] -= (1 - factor) * held_by[i];
  }

  /// What counts as holding nothing, over inertia [1/s^2].
  double soft() const {
    const auto& section = system.model().section;
    const Stiffness& k = section.stiffness;
    const double axial = slack * k.EA / (section.rhoA * length * length);
    if (!k.bends()) return axial;
    const double bending = soft_in_bending * k.EI / (section.rhoA * length * length * length * length);
    return std::min(axial, std::max(bending, rounding()));
  }

  bool linearize(const Eigen::VectorXd& q, double factor, double by_a = 0) {
    ++counters.newton.tangents;
    return equations.linearize(q, load(factor), by_a);
  }

  /// Ends once a correction is as small as wanted, or as rounding lets it be.
  bool is_last(double correction, double previous) const {
    return correction <= options.tolerance || (correction < by_rounding && correction > previous / 2);
  }

  /// Whether the residual, which was asked for last, is rounding, and less than a little of what acts on the beam.
  bool rests(const Eigen::VectorXd& q) {
    const double left = force_of(r);
    if (!(left <= force_by_rounding * system.model().section.stiffness.EA)) return false;
    const Eigen::VectorXd lacking = r;
    equations.residual(q, 0, r);
    r -= lacking;
    const double acts = force_of(r);
    r = lacking;
    return acts == 0 || left <= rounding_share * acts;
  }

  /// Newton's iteration with the exact tangent; false where it finds nothing near q, which then is no equilibrium.
  bool newton(Eigen::VectorXd& q, double factor) {
    impose(q, factor);
    double previous = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_corrections; ++i) {
      ++counters.newton.iterations;
      residual(q, factor);
      const bool at_rest = rests(q);
      if (!linearize(q, factor)) return at_rest && !tangled(q);
      equations.solve(r);
      const double correction = size(r);
      if (at_rest && !(correction <= by_rounding)) return !tangled(q);  // rounding, where nothing holds the beam
      if (!(correction <= largest_correction)) return false;
      q -= r;
      if (is_last(correction, previous)) return !tangled(q);
      previous = correction;
    }
    return false;
  }

  /// How an iteration with free forces goes: at first none is below `first`, and later none below `least` [N].
  struct Walk {
    double first, least;
    double longest = largest_correction;  ///< of a step
    int most = most_corrections;
  };

  /// The same with the forces along the axis as unknowns of their own (FreeTension), then as above.
  bool newton_with_forces(Eigen::VectorXd& q, double factor, const Walk& walk) {
    Eigen::VectorXd at = q;
    impose(at, factor);
    FreeTension<D> forces(system);
    forces.start(at, walk.first);
    double previous = std::numeric_limits<double>::infinity();
    for (int i = 0; i < walk.most; ++i) {
      ++counters.newton.iterations;
      ++counters.newton.tangents;
      residual(at, factor);
      if (!equations.linearize(at, load(factor), 0, &forces)) return false;
      equations.solve(r);
      const double correction = size(r);
      if (!std::isfinite(correction)) return false;
      // in the end even those of a rope may push, at a point of an element or where the ground holds it
      const double least = correction < close ? -std::numeric_limits<double>::infinity() : walk.least;
      forces.advance(at, r, std::min(1.0, walk.longest / correction), least);
      const bool settles = correction < nearly || (correction < near && correction > previous / 2);
      if (settles || i + 1 == walk.most) {
        Eigen::VectorXd tried = at;
        if (newton(tried, factor)) {
          q = tried;
          return true;
        }
      }
      previous = correction;
    }
    return false;
  }

  /// With forces as strains say at first; a rope does not push.
  bool newton_with_forces(Eigen::VectorXd& q, double factor) {
    const double least = system.model().section.stiffness.bends() ? -std::numeric_limits<double>::infinity() : 0;
    return newton_with_forces(q, factor, Walk{least, least});
  }

  /// Where a rope that holds nothing at first hangs: forces that bear what acts on it, and none that pushes, lead
  /// there. False where it finds no stable equilibrium, or one that pushes, on the ground or so.
  bool hang(Eigen::VectorXd& q, double factor) {
    if (system.model().section.stiffness.bends()) return false;
    residual(q, factor);
    const double bears = force_of(r);
    if (!(bears > 0)) return false;
    for (const int pace : {1, 5, 25}) {
      Eigen::VectorXd tried = q;
      const Walk walk{bears, least_force * bears, largest_correction / pace, most_corrections * pace};
      if (!newton_with_forces(tried, factor, walk)) continue;
      if (!FreeTension<D>(system).pulls(tried, -by_rounding * bears) || !stable_at(tried, factor)) continue;
      q = tried;
      return true;
    }
    return false;
  }

  /// Whether a joint has run through another node, or left the beam.
  bool tangled(const Eigen::VectorXd& q) const {
    const ChainView<D> beam = system.view(q.data(), q.data());
    for (std::size_t i = 0; i < system.places().size(); ++i) {
      const JointPlace& place = system.places()[i];
      if (beam.mark_of(place.node - 1) >= q[place.mark] || q[place.mark] >= beam.mark_of(place.node + 1)) return true;
      if (equations.holds(i)) continue;
      for (const int way : {-1, 1}) {
        if (next_is_end(i, way) && until_node(i, q, way) <= 0) return true;
      }
    }
    return false;
  }

  /// Directions in which the energy falls.
  struct Falls {
    int surely;   ///< by more than what rounding may make of it
    int perhaps;  ///< or by less
  };
  /// Rounding changes the tangent by no more than so much inertia more or less does, which is a share of what each
  /// element resists to stretch.
  Falls falls(const Eigen::VectorXd& q, double factor) {
    const auto count = [&](double by_a) { return linearize(q, factor, by_a) ? equations.negative_pivots(0) : 0; };
    const double hidden = rounding();
    const int surely = count(hidden);
    return {surely, std::max(surely, count(-hidden))};
  }
  bool stable_at(const Eigen::VectorXd& q, double factor) { return falls(q, factor).surely == 0; }

  /// What rounding of an element's stretch amounts to, over inertia [1/s^2].
  double rounding() const {
    const auto& section = system.model().section;
    const double l = length / system.mesh().elements();
    return tangent_by_rounding * section.stiffness.EA / (section.rhoA * l * l);
  }

  /// Down the potential energy, as an overdamped beam would go, until Newton's iteration finds a stable equilibrium.
  bool relax(Eigen::VectorXd& q, double factor) {
    Eigen::VectorXd at = q;
    impose(at, factor);
    const auto& section = system.model().section;
    double mu = section.stiffness.EA / (section.rhoA * length * length);  // [1/s^2], of the beam's axial waves
    const double largest = 1e12 * mu;
    for (int i = 0; i < most_relaxations && mu < largest; ++i) {
      residual(at, factor);
      if (!linearize(at, factor, mu) || equations.negative_pivots(0) > 0) {
        mu *= 4;
        continue;
      }
      equations.solve(r);
      const double step = size(r);
      if (!(step <= 2 * largest_relaxation)) {
        mu *= 4;
        continue;
      }
      at -= r;
      if (step <= std::numeric_limits<double>::epsilon()) return false;  // on a ridge of the energy
      if (step < largest_relaxation) mu /= 2;
      if (step > 1e-3 * largest_relaxation && i % 20 != 0) continue;
      Eigen::VectorXd tried = at;
      if (newton(tried, factor) && stable_at(tried, factor)) {
        q = tried;
        return true;
      }
    }
    return false;
  }

  bool in_ring(std::size_t which) const {
    return system.held(which) != nullptr && (system.held(which)->free_slope > 0).all();
  }

  /// What slides has run to where it cannot go on: of a ring, with the force that it would take there.
  [[noreturn]] void not_balanced(std::size_t which, double force, const std::string& ring, const std::string& other) {
    const int joint = system.joint_index(which);
    const std::string slides = "the beam slides along the ring at joint " + std::to_string(joint) + " with " +
                               in_digits(std::abs(force), 4) + " N unbalanced: ";
    throw NotBalanced(in_ring(which) ? slides + ring : other, joint, force);
  }

  bool next_is_end(std::size_t which, int way) const {
    const int node = system.places()[which].node;
    return way > 0 ? node + 1 == system.mesh().last() : node == 1;
  }

  /// How far a joint is from the next node that way [m].
  double reach(std::size_t which, const Eigen::VectorXd& q, int way) const {
    const JointPlace& place = system.places()[which];
    return way * (system.view(q.data(), q.data()).mark_of(place.node + way) - q[place.mark]);
  }

  /// How far a joint may slide that way until it runs into a node, or out of the beam.
  double until_node(std::size_t which, const Eigen::VectorXd& q, int way) const {
    const auto& model = system.model();
    double distance = end_distance * model.length_control.standard_length;
    const bool leaves = next_is_end(which, way) && (way > 0 ? model.end_releases : model.start_releases);
    if (leaves) distance = std::max(distance, (1 + 1e-9) * system.joint(which).separation_distance);
    return reach(which, q, way) - distance;
  }

  /// How far it may slide that way: until it runs into a node or out of the beam, or until length control is due.
  double room(std::size_t which, const Eigen::VectorXd& q, int way) const {
    const auto& control = system.model().length_control;
    if (!control.enabled || next_is_end(which, way)) return until_node(which, q, way);
    return control.trigger_length() * (1 + 1e-12) - reach(which, q, -way);
  }

  /// Length control that is due, and the equilibrium on its mesh; false where there is none.
  bool control_length(Eigen::VectorXd& q, double factor = 1) {
    for (int events = 0; events < most_events; ++events) {
      Eigen::VectorXd y = state_of(q);
      const Guards guards = system.guards(y, load(factor));
      const auto due = std::find_if(guards.begin(), guards.end(), [](const Guard& guard) { return guard.value > 0; });
      if (due == guards.end()) return true;
      system.handle_event(static_cast<int>(due - guards.begin()), y, load(factor));
      const Eigen::VectorXd multipliers = q.tail(equations.conditions());
      zero = Eigen::VectorXd::Zero(equations.size());  // there may be another number of nodes
      q = zero;
      q.head(system.coordinates()) = y.head(system.coordinates());
      q.tail(multipliers.size()) = multipliers;
      Eigen::VectorXd tried = q;
      if (newton(tried, factor)) {
        q = tried;
      } else if (!newton_with_forces(q, factor) && !hang(q, factor)) {
        return false;  // q is what the event has left
      }
    }
    return true;
  }

  BeamSystem<D>& system;
  StaticEquations<D> equations;
  const EquilibriumOptions& options;
  SolverCounters& counters;
  Eigen::VectorXd zero, r;  ///< r: the residual that was asked for last
  double length;
  std::size_t slider = 0;       ///< of the joints: the first that nothing guides
  bool releasing = false;       ///< several at once
  std::vector<double> held_by;  ///< what then held the joints at first [N]
};

}  // namespace vlbeam
