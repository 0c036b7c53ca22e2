#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/beam/chain_view.hpp"
#include "mechanics/motion/joint/joint_side.hpp"
#include "mechanics/motion/joint/open_nodes.hpp"
#include "mechanics/motion/joint/sliding_joint.hpp"

namespace vlbeam {

/// A variable-length element of a chain with joints: at least one of its ends is one.
struct MovingPart {
  int element = 0;
  MovingEnds ends = MovingEnds::a;
  int a = -1, b = -1;  ///< which of the chain's joints is at that end; -1 for none
  ShapeTabulation table;
};

/// What joints take from a beam and its guides give it.
struct JointPower {
  double dissipated = 0;  ///< by friction [W]
  double guided = 0;      ///< by what prescribes material coordinates [W]
};

/// M a = f of a chain with sliding joints. Runs of resting elements are eliminated with factors of their own, then the
/// open nodes beside the joints, whose components are all alike. The joints are left: a block tridiagonal system of one
/// block each. A block holds position, slope, the slope behind the joint if it has one, the material coordinate, and
/// the multipliers of slopes. The mass is positive definite and multipliers come last, so that L D L^T needs no pivots.
/// Cost: one sweep over the resting elements, and one small dense block a joint.
template <int D>
class JointChain {
 public:
  /// A joint as its equations need it.
  struct Joint {
    const SlidingJoint* law;
    const Support<D>* held;  ///< what holds its node in space, or null
    JointPlace place;
  };

  /// The spans end beside the first and the last joint; `between` are the runs of resting elements from one joint to
  /// the next, where there are any. All must outlive this object.
  void layout(const Span<D>& first, const Span<D>& last, const std::vector<SpanBetween<D>>& between,
              const std::vector<MovingPart>& parts, std::vector<Joint> joints);

  /// Accelerations in place of the forces, of an array like q; friction included. `motion` holds an entry a joint; with
  /// nothing moving in it, the same solves M v = p. Material coordinates whose acceleration is given there take it,
  /// whatever acts on them. Nothing is returned where the mass matrix is not positive definite or friction jams. Where
  /// nothing acts on the nodes outside a part, they are left out of it all.
  std::optional<JointPower> solve(const std::vector<MovingEquations<double, D>>& equations,
                                  const std::vector<JointMotion<D>>& motion, double* force, const BeamPart& part = {});

 private:
  /// Of one side of a joint: r, the slope there, x.
  static constexpr int side = 2 * D + 1;
  static constexpr int most = 3 * D + 1 + SlopeConditions<D>::most;
  using Block = Eigen::Matrix<double, most, most, Eigen::RowMajor>;
  using Columns = Eigen::Matrix<double, most, side, Eigen::RowMajor>;
  using Column = Eigen::Matrix<double, most, 1>;
  using OfSide = Eigen::Matrix<double, side, 1>;
  using Side = JointSide<D, side, D>;

  /// The equations of a joint once the open nodes are eliminated. Unknowns: r, the slope before it, that behind it if
  /// it has one, x, and what ties the slopes. Entries from `size` on are zero.
  struct Station {
    int size = side;
    int behind = D;    ///< where the slope behind it stands
    int mark = 2 * D;  ///< where x stands
    const Support<D>* held = nullptr;
    Block mass;    ///< its upper triangle; once factored L^T, with 1/d on the diagonal
    Columns next;  ///< couples it to (r, slope, x) of the next one; L^-1 of that then
    Column rhs, answer = Column::Zero();
    /// Of a guided joint: the row of M of its material coordinate, by itself and its neighbours, and the force on it.
    struct Guided {
      Column own, previous;
      OfSide next;
      double force = 0;
    };
    std::optional<Guided> guided = {};
    /// Of a joint that rubs and is held: the rows of M of its place, by itself and its neighbours, and the force there.
    struct HeldRows {
      Eigen::Matrix<double, D, most> own, previous;
      Eigen::Matrix<double, D, side> next;
      Vec<double, D> force;
    };
    std::optional<HeldRows> held_rows = {};

    /// Where the unknown i of the side before the joint or behind it stands.
    int before_at(int i) const { return i < 2 * D ? i : mark; }
    int behind_at(int i) const { return i < D ? i : i < 2 * D ? behind + i - D : mark; }
  };

  /// Condenses M a = f to the joints.
  void assemble(const std::vector<MovingEquations<double, D>>& equations, const std::vector<JointMotion<D>>& motion,
                const double* force);
  void add_tie(const JointTie<D>& tie, Station& one, Station& other);
  void add_conditions(const JointMotion<D>& motion, JointSlopes slopes, Station& station);
  /// Gives a joint's material coordinate its acceleration.
  void guide(std::size_t station, double acceleration);
  /// Keeps the rows of a held joint with friction, before hold() replaces them.
  void keep_rows(std::size_t station);
  /// The force of a guide on the material coordinate [N], without the friction that it bears.
  double guide_force(std::size_t station) const;
  bool factor();
  /// Solves in place of each station's `rhs`.
  void substitute();
  std::optional<double> add_friction(const std::vector<JointMotion<D>>& motion);
  /// Forces on the node of a held joint with friction, less its inertia by the accelerations in `rhs` [N]; else 0.
  Vec<double, D> lacking(std::size_t station, bool with_forces) const;
  /// What holds the joint holds it: there, a = 0.
  void hold(std::size_t station);
  /// What of `rhs` couples to the previous and to the next joint.
  static OfSide before(const Station& station) {
    OfSide values;
    values << station.rhs.template head<2 * D>(), station.rhs[station.mark];
    return values;
  }

  const Span<D>*first_ = nullptr, *last_ = nullptr;
  const std::vector<SpanBetween<D>>* between_ = nullptr;
  const std::vector<MovingPart>* parts_ = nullptr;
  std::vector<Joint> joints_;
  std::vector<Station> stations_;  ///< one a joint
  std::vector<std::optional<OpenNodes<D>>>
      open_;                                    ///< between a joint and the next; nothing where they share an element
  std::optional<Side> first_side_, last_side_;  ///< the open nodes at the ends, where there are any
  std::vector<double> normal_, share_, stretch_;
  std::vector<Vec<double, D>> pull_;  ///< by the beam on a joint without friction [N]
  Eigen::MatrixXd influence_;         ///< by friction at one joint, the accelerations there and at others
};

extern template class JointChain<2>;
extern template class JointChain<3>;

}  // namespace vlbeam
