#pragma once

#include <Eigen/LU>
#include <optional>
#include <span>
#include <vector>

#include "core/beam/chain_view.hpp"
#include "core/beam/span_between.hpp"
#include "core/joint/sliding_joint.hpp"

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

/// M a = f of a chain with sliding joints. Runs of resting elements are eliminated with factors of their own;
/// what is left are the joints with the open nodes beside them, a block tridiagonal system of one block a node:
/// position and slope, at a joint its material coordinate, the slope behind it if it has one, and what ties the two.
/// Cost: one sweep over the resting elements, and two or three dense blocks a joint.
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
  /// whatever acts on them. Nothing is returned where the mass matrix is singular or friction jams.
  std::optional<JointPower> solve(const std::vector<MovingEquations<double, D>>& equations,
                                  const std::vector<JointMotion<D>>& motion, double* force);

 private:
  static constexpr int most = 3 * D + 1 + SlopeConditions<D>::most;
  using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;

  /// A node of the reduced system: unknowns r, r_x; at a joint then the slope behind it, x and the multipliers of the
  /// conditions on the slopes.
  struct Station {
    int node = 0;
    int joint = -1;
    Eigen::Index size = 2 * D;
    Eigen::Index behind = D;  ///< where the slope behind the node stands
    Eigen::Index mark = -1;   ///< where x stands
    const Support<D>* held = nullptr;
    Block diagonal, upper;  ///< `upper` couples it to the next station
    Eigen::PartialPivLU<Block> factor;
    Column rhs, answer;
    /// Of a guided joint: the row of M of its material coordinate, by itself and its neighbours, and the force on it.
    struct Guided {
      Column own, previous, next;
      double force = 0;
    };
    std::optional<Guided> guided = {};
    /// Of a joint that rubs and is held: the rows of M of its place, by itself and its neighbours, and the force there.
    struct HeldRows {
      Eigen::Matrix<double, D, Eigen::Dynamic, 0, D, most> own, previous, next;
      Vec<double, D> force;
    };
    std::optional<HeldRows> held_rows = {};
  };

  void assemble(const std::vector<MovingEquations<double, D>>& equations, const std::vector<JointMotion<D>>& motion);
  /// Gives a joint's material coordinate its acceleration.
  void guide(std::size_t station, double acceleration);
  /// Remembers what the node of a held joint that rubs has for equations.
  void keep_rows(std::size_t station);
  /// With what a guide acts on the material coordinate [N], less what it bears of friction.
  double guide_force(std::size_t station) const;
  bool factor();
  /// Solves in place of each station's `rhs`.
  void substitute();
  std::optional<double> add_friction(const std::vector<JointMotion<D>>& motion);
  /// What acts on the node of a held joint that rubs, less what the accelerations in `rhs` take of it [N]; 0 elsewhere.
  Vec<double, D> lacking(std::size_t station, bool with_forces) const;
  static void hold(const Support<D>& held, Station& station, Station* previous);

  const Span<D>*first_ = nullptr, *last_ = nullptr;
  const std::vector<SpanBetween<D>>* between_ = nullptr;
  const std::vector<MovingPart>* parts_ = nullptr;
  std::vector<Joint> joints_;
  std::vector<Station> stations_;
  std::vector<std::size_t> of_joint_, of_part_;  ///< which station is a joint's, and that of a part's end A
  std::vector<double> normal_, share_, stretch_;
  std::vector<Vec<double, D>> pull_;  ///< by the beam on a joint without friction [N]
  Eigen::MatrixXd influence_;         ///< by friction at one joint, the accelerations there and at others
};

extern template class JointChain<2>;
extern template class JointChain<3>;

}  // namespace vlbeam
