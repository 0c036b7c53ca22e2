#pragma once

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/beam/span_between.hpp"
#include "core/element/element_sums.hpp"
#include "mechanics/motion/joint/joint_chain.hpp"
#include "mechanics/motion/system/beam_joints.hpp"
#include "mechanics/motion/system/prescribed_mesh.hpp"

namespace vlbeam {

/// How many elements at the start and at the end of a beam stay as they are.
struct UnchangedElements {
  int at_start = 0, at_end = 0;
};

/// The elements of a beam between two events: runs of fixed ones, and those at joints, whose mass changes.
template <int D>
class BeamElements : public BeamJoints<D> {
 public:
  using Vector = Vec<double, D>;
  using JointElements = std::vector<MovingEquations<double, D>>;  ///< of the elements at joints: moving_parts()
  using BeamJoints<D>::coordinates;
  using BeamJoints<D>::guides;
  using BeamJoints<D>::has_joint;

  /// Of the elements.
  const BeamRules& rules() const { return rules_; }
  /// For sums over elements by so many Gauss points, or own_points.
  const SumTables& tables(int points) const;
  /// Gravity at time t [m/s^2].
  Vector gravity(double t) const {
    return model_.gravity * (model_.time_is_load_factor ? t : smooth_ramp(t, model_.gravity_ramp).value);
  }
  /// What acts on the beam's mass as gravity does: that, and the load along the beam [m/s^2].
  Vector beam_gravity(double t) const {
    Vector sum = gravity(t);
    if (model_.loads.line_force) sum += model_.loads.line_force(t) / model_.section.rhoA;
    return sum;
  }
  /// The beam with coordinates q and their rates, arrays like those of the state; where its nodes travel, as
  /// move_nodes() was told last.
  ChainView<D> view(const double* q, const double* rate) const {
    return {mesh_, model_.transport, q, rate, places_, marks()};
  }
  /// Where the four nodal vectors of element k are in an array like q.
  std::array<double*, 4> vectors_of(double* q, int k) const;
  /// Sets an array of coordinates to zero, but for nodes outside of a part.
  void clear(double* q, const BeamPart& part) const {
    std::fill(q + Eigen::Index{node_size<D>} * part.before, q + dofs_.mark() - Eigen::Index{node_size<D>} * part.behind,
              0.0);
    std::fill(q + dofs_.mark(), q + coordinates(), 0.0);
  }
  /// The mesh of a beam all of whose nodes are, or null.
  PrescribedMesh<D>* prescribed_mesh() const { return prescribed_.get(); }
  /// Material coordinates of all nodes, if they are, or null.
  const std::vector<Prescribed>* marks() const { return prescribed_ ? &prescribed_->marks() : nullptr; }
  /// Material coordinate of a node of the mesh [m].
  double mark_of(int node, const double* q) const { return view(q, q).mark_of(node); }

  /// The elements at the joints, in the order of the chain.
  const std::vector<MovingPart>& moving_parts() const { return parts_; }
  MovingLaw<D> moving_law(double t) const {
    MovingLaw<D> law{model_.axis_section(), model_.formulation, model_.transport, beam_gravity(t)};
    law.pieces = model_.several_sections();
    return law;
  }
  /// The rest shape of an element at joints whose coordinates are in `q`; nothing if it is straight.
  std::optional<RestElement<D>> rest_of(const MovingPart& part, const double* q) const;
  /// Mass matrix and forces of the elements at joints.
  void fill_elements(const double* q, const double* rate, double t, JointElements& elements) const;
  /// Their mass matrices alone; not of a beam whose nodes travel.
  void fill_masses(const double* q, double t, JointElements& elements) const;
  JointElements masses_at(const Eigen::VectorXd& y, double t) const {
    JointElements elements;
    fill_masses(y.data(), t, elements);
    return elements;
  }
  /// The fixed elements before the first and behind the last joint, or before and behind the middle of the beam.
  const Span<D>& left() const { return *spans_.left; }
  const Span<D>& right() const { return *spans_.right; }
  /// Those between joints.
  const std::vector<SpanBetween<D>>& between() const { return spans_.between; }

  /// Where the concentrated loads are.
  std::vector<Vector> load_places(const Eigen::VectorXd& y, double t) const {
    return model_.loads.places(view(y.data(), y.data() + coordinates()), t);
  }
  /// Power of the load along the beam [W].
  double line_power(const ChainView<D>& beam, double t) const;
  /// What feeds that are given do besides the work of their force along the beam, which takes the load for a potential:
  /// matter that comes in brings none of it [W].
  double fed_line_power(const ChainView<D>& beam, double t) const;

 protected:
  /// Runs of fixed elements; the first and the last stand on supports, as orient() was told last.
  struct Spans {
    std::optional<Span<D>> left, right;
    std::vector<SpanBetween<D>> between;
  };

  explicit BeamElements(const BeamModel<D>& model) : BeamJoints<D>(model), rules_(model.rules()) {}
  ~BeamElements() = default;
  /// After a change of the mesh.
  void adopt_elements(const UnchangedElements& unchanged);

  using BeamJoints<D>::dofs_;
  using BeamJoints<D>::mesh_;
  using BeamJoints<D>::model_;
  using BeamJoints<D>::places_;
  std::vector<double> rest_;  ///< nodes of the rest shape, but for the moving one; empty if it is straight
  std::unique_ptr<PrescribedMesh<D>> prescribed_;  ///< its nodes are where move_nodes() was told last
  mutable Spans spans_;

 private:
  const RestEnd<D>& rest_end(double x) const;
  /// Calls equations_of(part, law) with the ends of each part.
  template <class Equations>
  void fill(const ChainView<D>& beam, double t, JointElements& elements, const Equations& equations_of) const;

  BeamRules rules_;
  mutable std::map<int, SumTables> tables_;  ///< those that have been asked for
  mutable RestEnd<D> last_rest_end_{std::numeric_limits<double>::quiet_NaN(), {}};
  std::vector<MovingPart> parts_;
};

extern template class BeamElements<2>;
extern template class BeamElements<3>;

}  // namespace vlbeam
