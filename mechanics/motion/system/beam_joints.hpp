#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "core/length_control/chain_state.hpp"
#include "mechanics/motion/joint/kinks.hpp"
#include "mechanics/motion/system/beam_model.hpp"
#include "mechanics/motion/system/dof_map.hpp"
#include "mechanics/time/solver_counters.hpp"

namespace vlbeam {

/// The mesh of a beam between two events, and the joints on it: which of the model's they are, and where their
/// coordinates stand.
template <int D>
class BeamJoints {
 public:
  const BeamModel<D>& model() const { return model_; }
  const Mesh& mesh() const { return mesh_; }
  const DofMap<D>& dofs() const { return dofs_; }
  Eigen::Index coordinates() const { return dofs_.coordinates(); }

  bool has_joint() const { return !places_.empty(); }
  /// Where the coordinates of the joints stand that are on the beam, in the order of the chain.
  const std::vector<JointPlace>& places() const { return places_; }
  /// The same joints in the model.
  const ModelJoint<D>& joint(std::size_t which) const {
    return model_.joints[static_cast<std::size_t>(joints_[which].index)];
  }
  int joint_index(std::size_t which) const { return joints_[which].index; }
  /// Where joint `index` of the model is, which is on the beam.
  const JointPlace& place_of(int index) const { return places_[static_cast<std::size_t>(find(index))]; }
  bool at_joint(int node) const {
    return std::any_of(places_.begin(), places_.end(), [node](const JointPlace& place) { return place.node == node; });
  }
  /// Whether that joint is an end of the beam, through which it is fed: there is an element on one side only.
  bool feeds(std::size_t which) const { return places_[which].node == 0 || places_[which].node == mesh_.last(); }
  /// What holds a joint's node, or null.
  const Support<D>* held(std::size_t which) const {
    const auto& support = joint(which).support;
    return support ? &*support : nullptr;
  }
  /// Whether a guide prescribes a joint's material coordinate.
  bool guides(std::size_t which) const { return static_cast<bool>(joint(which).x); }
  /// What it prescribes; nothing where there is none.
  std::optional<Prescribed> guided(std::size_t which, double t) const {
    const TimeFunction& x = joint(which).x;
    return x ? std::optional(x(t)) : std::nullopt;
  }
  /// A joint on the beam has passed a point mass, forwards or backwards.
  void pass(std::size_t which, int by) { places_[which].passed += by; }
  using Touch = typename ChainState<D>::Touch;
  /// Of a joint on the beam and what is before it (side 0) or behind it (side 1).
  const Touch& touch(std::size_t which, std::size_t side) const { return joints_[which].touches[side]; }
  void set_touch(std::size_t which, std::size_t side, const Touch& touch) { joints_[which].touches[side] = touch; }

  /// The beam has two slopes at that joint.
  bool kinked(std::size_t which) const { return joint(which).law.kinked(); }
  bool kinked() const {
    return std::any_of(places_.begin(), places_.end(), [](const JointPlace& place) { return place.behind >= 0; });
  }
  /// Slopes at a joint, before and behind it, of an array of coordinates or rates.
  Eigen::Matrix<double, 2 * D, 1> joint_slopes(std::size_t which, const double* q) const {
    return slopes_at<D>(places_[which], q);
  }
  /// Of what turns at a joint, against the acceleration of its material coordinate [kg].
  double turning_inertia(std::size_t which, const double* q) const {
    const Turning& turning = joint(which).law.turning;
    if (!turning.present()) return 0;
    return turning.against<D>(q[places_[which].mark], slope<D>(q, places_[which].node));
  }
  /// What that inertia needs on the coordinate besides [N].
  double turning_lag(std::size_t which, const double* q, const double* rate) const {
    const Turning& turning = joint(which).law.turning;
    if (!turning.stretched) return 0;
    const JointPlace& place = places_[which];
    return turning.lag<D>(q[place.mark], rate[place.mark], slope<D>(q, place.node), slope<D>(rate, place.node));
  }
  /// How far the slopes at joints are from their conditions [-], [1/s].
  ConstraintResidual slope_residual(const Eigen::VectorXd& y) const;

 protected:
  /// A joint on the beam: which of the model's it is, and what it touches.
  struct Joint {
    int index;
    std::array<Touch, 2> touches;
  };

  /// Which of the joints on the beam is joint `index` of the model; -1 for none.
  int find(int index) const {
    const auto at = std::ranges::find(joints_, index, &Joint::index);
    return at == joints_.end() ? -1 : static_cast<int>(at - joints_.begin());
  }

  explicit BeamJoints(const BeamModel<D>& model) : model_(model) {}
  ~BeamJoints() = default;

  BeamModel<D> model_;
  Mesh mesh_;
  DofMap<D> dofs_;
  std::vector<JointPlace> places_;  ///< of the joints on the beam, in the order of the chain
  std::vector<Joint> joints_;       ///< the same
};

extern template class BeamJoints<2>;
extern template class BeamJoints<3>;

}  // namespace vlbeam
