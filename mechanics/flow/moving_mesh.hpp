#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/beam/chain_view.hpp"
#include "core/tangent_weights.hpp"
#include "mechanics/flow/chain_mass.hpp"
#include "mechanics/flow/flow_room.hpp"
#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

/// A mesh all of whose nodes travel along the beam as prescribed: a load that moves, a stem that is fed through its
/// guides, a span that is only what lies between two supports at any time. It knows where the nodes are, the mass
/// matrix, which changes with time, and what comes in with the matter at the ends.
template <int D>
class MovingMesh final : public PrescribedMesh<D>, private SectionInertia<D> {
 public:
  using Vector = Vec<double, D>;
  using typename PrescribedMesh<D>::Elements;

  /// `model`, which has a FlowRoom, must outlive this object. Throws ModelError where it makes no sense: nodes that do
  /// not exist, elements of no length at t = 0, supports with oblique frames of their own.
  explicit MovingMesh(const BeamModel<D>& model, const std::vector<WeightFunction>& weights);

  /// The nodes are where they are at time t; false where they tangle. Throws ComputationFailed where a load is beyond
  /// the ends of the beam.
  bool move(double t) override;
  /// Material coordinates of the nodes, as they were moved last.
  const std::vector<Prescribed>& marks() const override { return marks_; }
  int last() const { return flow_.motion.last(); }

  /// An array of accelerations as element k sees it, its ends included.
  MovingCoordinates<double, D> accelerations(const double* a, int k) const {
    const auto i = static_cast<std::size_t>(k);
    return {element_nodes<D>(a, k), marks_[i].acceleration, marks_[i + 1].acceleration};
  }
  /// Takes from the nodal forces what rotary inertia and the given accelerations of the ends ask for.
  void take_inertia(const ChainView<D>& beam, const std::vector<MovingPart>& parts, Elements& elements) override;
  /// Adds M a - Q of elements from which that was taken, a the accelerations of the nodes.
  void add_residual(const Elements& elements, const double* a, double* r) const;
  /// Adds their M a alone.
  void add_inertia(const Elements& elements, const double* a, double* r) const;
  /// Power of rotary inertia in an element that does not come in by its nodal residual [W].
  double rotary_power(const ChainView<D>& beam, const MovingPart& part, const double* a) const;
  /// Adds the momentum that comes in with the matter at the ends.
  void add_entering(const ChainView<D>& beam, double* f) const override;
  /// Solves M a = f in place; false where the mass matrix is not positive.
  bool solve(const Elements& elements, double* f) override;
  std::unique_ptr<MeshEquations<D>> new_equations(CurrentBeam<D>& beam) const override;
  const SectionInertia<D>* section_inertia() const override { return flow_.rotary.present() ? this : nullptr; }
  /// Adds the tangent of the inflow, times minus one, by blocks: add(row node, column node, matrix).
  template <class Add>
  void add_inflow_tangent(const ChainView<D>& beam, const TangentWeights& by, const Add& add) const;

  /// How short the shortest element is [-]: positive where nodes tangle.
  double tangle() const;
  /// A sentence about it.
  std::string tangled(double t) const;
  /// How far transported weights are below what is allowed; positive is too far.
  double least_weight(const std::vector<WeightFunction>& weights) const;
  /// Throws ModelError, with the time, where the nodes tangle in [0, until], or a load is beyond the ends.
  void check_motion(double until) const;

 private:
  double kinetic(double weight, const Vector& v_x) const override {
    return 0.5 * weight * flow_.rotary.rhoJ * flow_.rotary.across(v_x).squaredNorm();
  }

  using Components = typename Support<D>::Components;
  using Rows = std::array<Vector, 4>;  // of an element's positions and slopes

  /// Adds the rows of element k, and its rotary inertia.
  void add_rows(int k, Rows rows, const double* a, double* r) const;
  void check_model(const std::vector<WeightFunction>& weights) const;
  void adopt_supports();
  double length(std::size_t k) const { return marks_[k + 1].value - marks_[k].value; }
  std::size_t shortest() const;
  /// Throws ComputationFailed where a load is beyond the ends of the beam.
  void check_reach(double t) const;
  /// The end of the beam at node k: the length that comes in a second, and the rate of its mark.
  struct Inlet {
    int node, element;
    double u, rate, in;
  };
  std::array<Inlet, 2> inlets() const;
  /// Momentum conjugate to the slope at an end, of rotary inertia [kg m/s].
  Vector rotary_momentum(const ChainView<D>& beam, const Inlet& at) const;

  const BeamModel<D>& model_;
  const FlowRoom<D>& flow_;
  std::vector<Prescribed> marks_;
  double reference_length_;                      ///< [m], of an element at t = 0
  std::vector<std::array<Components, 2>> free_;  ///< of position and slope, in the frame
  Eigen::Matrix<double, D, D> frame_ = Eigen::Matrix<double, D, D>::Identity();
  bool aligned_ = true;
  std::vector<RotaryElement> rotary_;
  ChainMass<D> mass_;
};

template <int D>
template <class Add>
void MovingMesh<D>::add_inflow_tangent(const ChainView<D>& beam, const TangentWeights& by, const Add& add) const {
  if (model_.formulation == Formulation::virtual_work) return;
  constexpr int B = node_size<D>;
  using Block = Eigen::Matrix<double, B, B>;
  const RotaryInertia<D>& rotary = flow_.rotary;
  for (const Inlet& at : inlets()) {
    Block own = Block::Zero();
    own.template topLeftCorner<D, D>().diagonal().array() -= model_.section.rhoA * at.in * by.v;
    own.template topRightCorner<D, D>().diagonal().array() += model_.section.rhoA * at.in * at.rate * by.q;
    add(at.node, at.node, own);
    if (!rotary.present()) continue;
    const auto k = static_cast<std::size_t>(at.element);
    const RotaryPoint point(marks_[k], marks_[k + 1], at.u, 1, rational_shape(beam.weights(at.element).w, at.u));
    for (int end = 0; end < 2; ++end) {
      Block block = Block::Zero();
      for (int i = 0; i < 2; ++i) {
        const int j = 2 * end + i;
        auto part = block.template block<D, D>(D, D * i);
        for (int c = 0; c < D; ++c) {
          const Vector unit = Vector::Unit(c);
          part.col(c) = at.in * (0.5 * rotary.gyroscopic * by.q * point.s[j] * rotary.turned(unit) -
                                 rotary.rhoJ * (by.v * point.s[j] + by.q * point.g[j]) * rotary.across(unit));
        }
      }
      add(at.node, at.element + end, block);
    }
  }
}

/// The mesh of a beam whose nodes all travel.
template <int D>
MovingMesh<D>& moving_mesh_of(const CurrentBeam<D>& beam) {
  return dynamic_cast<MovingMesh<D>&>(*beam.prescribed_mesh());
}

extern template class MovingMesh<2>;
extern template class MovingMesh<3>;

}  // namespace vlbeam
