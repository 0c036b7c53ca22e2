#include "mechanics/flow/steady_flow.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mechanics/flow/flow_room.hpp"
#include "mechanics/motion/system/implicit_beam.hpp"
#include "mechanics/spin/spin_unknowns.hpp"

namespace vlbeam {
namespace {

constexpr int most_iterations = 50;
constexpr double converged = 1e-13;  // Newton's correction over the size of the coordinates

}  // namespace

template <int D>
ChainState<D> straight_chain(const BeamModel<D>& model, const Vec<double, D>& start, const Vec<double, D>& along,
                             double stretch, double velocity, double t) {
  std::vector<Prescribed> marks;
  room_of<FlowRoom<D>>(model)->motion.at(t, marks);
  ChainState<D> chain;
  chain.q.resize(marks.size() * static_cast<std::size_t>(node_size<D>));
  chain.rate.assign(chain.q.size(), 0);
  for (std::size_t k = 0; k < marks.size(); ++k) {
    const int node = static_cast<int>(k);
    const Prescribed& x = marks[k];
    chain.mesh.x.push_back(x.value);
    if (k > 0) chain.mesh.weights.push_back({unit_weights, marks[k - 1].value, x.value});
    chain.mark_rates.push_back(x.rate);
    position<D>(chain.q.data(), node) = start + along * (stretch * (x.value - marks.front().value));
    slope<D>(chain.q.data(), node) = stretch * along;
    position<D>(chain.rate.data(), node) = along * (velocity + stretch * x.rate);
  }
  return chain;
}

template <int D>
Eigen::VectorXd straight_state(const BeamSystem<D>& beam, const Vec<double, D>& start, const Vec<double, D>& along,
                               double stretch, double velocity, double spin, double t) {
  const ChainState<D> chain = straight_chain(beam.model(), start, along, stretch, velocity, t);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(beam.size());
  std::ranges::copy(chain.q, y.data());
  std::ranges::copy(chain.rate, y.data() + beam.coordinates());
  for (int k = 0; spin_of(beam) != nullptr && k <= chain.mesh.last(); ++k) {
    y[beam.coordinates() + angle_of(beam, k)] = spin;
  }
  return y;
}

namespace {

/// The matrix of tangents_apart() with weights `by`, of free coordinates.
template <int D>
void add_matrix(BeamSystem<D>& beam, const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                const TangentWeights& by, Eigen::MatrixXd LinearMotion::*which, LinearFlows& flows) {
  ImplicitBeam<D> view(beam.accelerations());
  Eigen::MatrixXd axis, angles;
  view.tangents_apart(q, v, Eigen::VectorXd::Zero(q.size()), t, by, axis, angles);
  const Spin* spin = spin_of(beam);
  const Eigen::MatrixXd free = beam.supports().directions(beam.coordinates());
  const Eigen::Index turning = spin == nullptr ? 0 : spin->coordinates();
  const Eigen::MatrixXd basis = free.topLeftCorner(axis.rows(), free.cols() - turning);
  flows.axis.*which = basis.transpose() * axis * basis;
  if (spin == nullptr) return;
  std::vector<Eigen::Index> turns;
  for (int k = 0; k <= beam.mesh().last(); ++k) {
    if (!spin->driven(k)) turns.push_back(2 * Eigen::Index{k});
    if (spin->model().field == AngleField::hermite) turns.push_back(2 * Eigen::Index{k} + 1);
  }
  flows.angles.*which = angles(turns, turns);
}

}  // namespace

template <int D>
Eigen::VectorXd steady_state(BeamSystem<D>& beam, const Eigen::VectorXd& guess, double t, bool unstable) {
  ImplicitBeam<D> flow(beam.accelerations());
  const Eigen::Index n = beam.coordinates();
  Eigen::VectorXd q = guess.head(n), r(n);
  const Eigen::VectorXd v = guess.segment(n, n), a = Eigen::VectorXd::Zero(n);
  const std::vector<FieldRun> fields = flow.fields();
  beam.move_nodes(t);
  const double length = beam.marks()->back().value - beam.marks()->front().value;
  FieldNorms natural;  // sizes below which a field's rounding is no error
  natural.fill(1);
  natural[static_cast<std::size_t>(Field::position)] = length;
  natural[static_cast<std::size_t>(Field::twist)] = 1 / length;
  double last = 1;
  for (int i = 0;; ++i) {
    flow.residual(q, v, a, t, r);
    if (!r.allFinite() || !flow.linearize(q, v, a, t, {1, 0, 0})) {
      throw ComputationFailed("no steady state: the tangent is singular, as at a critical speed or load", t);
    }
    flow.solve(r);
    q -= r;
    const FieldNorms corrections = field_norms(fields, r), sizes = field_norms(fields, q);
    double correction = 0;
    for (std::size_t f = 0; f < field_count; ++f) {
      correction = std::max(correction, corrections[f] / std::max(sizes[f], natural[f]));
    }
    if (correction <= converged || (correction < 1e-10 && correction >= last)) break;
    if (!r.allFinite() || i == most_iterations) {
      throw ComputationFailed("no steady state: Newton's method does not converge", t);
    }
    last = correction;
  }
  if (!unstable) {
    LinearFlows stiffness;
    add_matrix(beam, q, v, t, {1, 0, 0}, &LinearMotion::K, stiffness);
    auto positive = [](const Eigen::MatrixXd& k) {
      return k.size() == 0 || Eigen::LLT<Eigen::MatrixXd>((k + k.transpose()) / 2).info() == Eigen::Success;
    };
    if (!positive(stiffness.axis.K) || !positive(stiffness.angles.K)) {
      throw ComputationFailed(
          "no stable steady state: the beam flows at or above its critical speed, or is loaded beyond buckling", t);
    }
  }
  Eigen::VectorXd y = guess;
  y.head(n) = q;
  return y;
}

template <int D>
LinearFlows linear_flows(BeamSystem<D>& beam, const Eigen::VectorXd& y, double t) {
  const Eigen::Index n = beam.coordinates();
  const Eigen::VectorXd q = y.head(n), v = y.segment(n, n);
  LinearFlows flows;
  add_matrix(beam, q, v, t, {1, 0, 0}, &LinearMotion::K, flows);
  add_matrix(beam, q, v, t, {0, 1, 0}, &LinearMotion::C, flows);
  add_matrix(beam, q, v, t, {0, 0, 1}, &LinearMotion::M, flows);
  return flows;
}

template ChainState<2> straight_chain(const BeamModel<2>&, const Vec<double, 2>&, const Vec<double, 2>&, double, double,
                                      double);
template ChainState<3> straight_chain(const BeamModel<3>&, const Vec<double, 3>&, const Vec<double, 3>&, double, double,
                                      double);
template Eigen::VectorXd straight_state(const BeamSystem<2>&, const Vec<double, 2>&, const Vec<double, 2>&, double,
                                        double, double, double);
template Eigen::VectorXd straight_state(const BeamSystem<3>&, const Vec<double, 3>&, const Vec<double, 3>&, double,
                                        double, double, double);
template Eigen::VectorXd steady_state(BeamSystem<2>&, const Eigen::VectorXd&, double, bool);
template Eigen::VectorXd steady_state(BeamSystem<3>&, const Eigen::VectorXd&, double, bool);
template LinearFlows linear_flows(BeamSystem<2>&, const Eigen::VectorXd&, double);
template LinearFlows linear_flows(BeamSystem<3>&, const Eigen::VectorXd&, double);

}  // namespace vlbeam
