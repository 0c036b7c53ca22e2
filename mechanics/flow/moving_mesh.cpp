#include "mechanics/flow/moving_mesh.hpp"

#include <algorithm>
#include <string>

#include "core/error.hpp"
#include "mechanics/flow/flow.hpp"
#include "mechanics/flow/travel_events.hpp"
#include "mechanics/spin/spin_room.hpp"

namespace vlbeam {
namespace {

constexpr double least_share = 1e-6;  // of an element's mean length at t = 0: below, the elements tangle

}  // namespace

template <int D>
MovingMesh<D>::MovingMesh(const BeamModel<D>& model, const std::vector<WeightFunction>& weights)
    : model_(model), flow_(*room_of<FlowRoom<D>>(model)) {
  check_model(weights);
  flow_.motion.at(0, marks_);
  reference_length_ = (marks_.back().value - marks_.front().value) / last();
  adopt_supports();
  rotary_.reserve(weights.size());
}

template <int D>
void MovingMesh<D>::check_model(const std::vector<WeightFunction>& weights) const {
  if (static_cast<int>(weights.size()) != last()) {
    throw ModelError("weights", std::to_string(weights.size()) + " of them", "there must be one an element");
  }
  std::vector<Prescribed> nodes;
  flow_.motion.at(0, nodes);
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    const double length = nodes[k + 1].value - nodes[k].value;
    if (length > 0) continue;
    throw ModelError("mesh motion", "element " + std::to_string(k) + " of length " + six_digits(length) + " at t = 0",
                     "material coordinates must increase from node to node");
  }

  const auto check_nodes = [&](const char* field, const auto& list, int first, int end, bool once) {
    std::vector<bool> taken(nodes.size(), false);
    for (const auto& entry : list) {
      if (entry.node < first || entry.node > end) {
        throw ModelError(field, "node " + std::to_string(entry.node),
                         "it must be a node of the beam, " + std::to_string(first) + " to " + std::to_string(end) +
                             ": beyond its ends there is none");
      }
      const auto k = static_cast<std::size_t>(entry.node);
      if (taken[k] && once)
        throw ModelError(field, "node " + std::to_string(entry.node) + " twice", "a node can stand there once");
      taken[k] = true;
    }
  };
  check_nodes("supports", model_.held_nodes, 1, last() - 1, true);
  const auto check_loads = [&](const auto& loads) {
    auto at_nodes = loads;
    std::erase_if(at_nodes, [](const auto& load) { return static_cast<bool>(load.x); });
    check_nodes("loads", at_nodes, 0, last(), false);
  };
  check_loads(model_.loads.points);
  if (const SpinModel* const spin = spin_model(model_)) {
    check_loads(spin->torques.points);
    for (const Torques::Point& load : spin->torques.points) {
      if (load.x || std::ranges::count(spin->drives, load.node, &DrivenAngle::node) == 0) continue;
      throw ModelError("loads", "a torque at node " + std::to_string(load.node),
                       "the angle there is prescribed already");
    }
  }

  if (!flow_.rotary.present()) return;
  if (!(std::abs(flow_.rotary.direction.norm() - 1) < 1e-9)) {
    throw ModelError("rotary inertia", "without direction", "it needs a unit vector");
  }
  if (model_.formulation == Formulation::virtual_work) {
    throw ModelError("rotary inertia", "with virtual-work", "it must be \"none\", or the formulation variational");
  }
  const bool unequal = std::ranges::any_of(weights, [](const auto& of) { return of.w != unit_weights; });
  if (model_.transport == WeightTransport::transported && unequal) {
    throw ModelError("rotary inertia", "with transported weights",
                     "it must be \"none\", or the weights frozen or unit");
  }
}

template <int D>
void MovingMesh<D>::adopt_supports() {
  free_.assign(marks_.size(), {Components::Ones(), Components::Ones()});
  bool oriented = flow_.rotary.present();
  if (oriented) {
    const Support<D> along = Support<D>::slide(flow_.rotary.direction);
    frame_ = along.frame;
    aligned_ = along.aligned;
  }
  const auto adopt = [&](int node, const Support<D>& support) {
    free_[static_cast<std::size_t>(node)] = {support.free_position, support.free_slope};
    const auto same = [](const Components& c) { return (c == c[0]).all(); };
    if (same(support.free_position) && same(support.free_slope)) return;  // the same in any frame
    if (oriented && (support.frame - frame_).norm() > 1e-12) {
      throw ModelError("supports", "slides or clamps of two directions",
                       "those of one beam must share one direction, that of rotary inertia, too");
    }
    oriented = true;
    frame_ = support.frame;
    aligned_ = support.aligned;
  };
  adopt(0, model_.start);
  for (const auto& [node, support] : model_.held_nodes) adopt(node, support);
  adopt(last(), model_.end);
}

template <int D>
bool MovingMesh<D>::move(double t) {
  flow_.motion.at(t, marks_);
  for (std::size_t k = 0; k + 1 < marks_.size(); ++k) {
    if (!(length(k) > 0)) return false;
  }
  check_reach(t);
  return true;
}

template <int D>
void MovingMesh<D>::check_reach(double t) const {
  const double margin = 1e-9 * reference_length_, first = marks_.front().value, end = marks_.back().value;
  const auto check = [&](const auto& loads) {
    for (const auto& load : loads) {
      if (!load.x) continue;
      const double x = load.x(t);
      if (x >= first - margin && x <= end + margin) continue;
      throw ComputationFailed("a load at the material coordinate " + six_digits(x) +
                                  " m is beyond the ends of the beam, " + six_digits(first) + " and " +
                                  six_digits(end) + " m",
                              t);
    }
  };
  check(model_.loads.points);
  if (const SpinModel* const spin = spin_model(model_)) check(spin->torques.points);
}

template <int D>
void MovingMesh<D>::take_inertia(const ChainView<D>& beam, const std::vector<MovingPart>& parts, Elements& elements) {
  rotary_.clear();
  for (std::size_t k = 0; k < elements.size(); ++k) {
    MovingEquations<double, D>& eq = elements[k];
    if (flow_.rotary.present()) {
      const RotaryElement& rotary = rotary_.emplace_back(marks_[k], marks_[k + 1], parts[k].table);
      const int element = static_cast<int>(k);
      const auto residual =
          rotary.residual(flow_.rotary, element_nodes<D>(beam.q, element), element_nodes<D>(beam.rate, element));
      for (std::size_t row = 0; row < 4; ++row) eq.force[row] -= residual[row];
    }
    const double a = marks_[k].acceleration, b = marks_[k + 1].acceleration;
    for (std::size_t row = 0; row < 4; ++row) eq.force[row] -= eq.mass_a[row] * a + eq.mass_b[row] * b;
  }
}

template <int D>
void MovingMesh<D>::add_rows(int k, Rows rows, const double* a, double* r) const {
  if (flow_.rotary.present()) {
    const auto inertia = rotary_[static_cast<std::size_t>(k)].inertia(flow_.rotary, element_nodes<D>(a, k));
    for (std::size_t i = 0; i < 4; ++i) rows[i] += inertia[i];
  }
  position<D>(r, k) += rows[0];
  slope<D>(r, k) += rows[1];
  position<D>(r, k + 1) += rows[2];
  slope<D>(r, k + 1) += rows[3];
}

template <int D>
void MovingMesh<D>::add_residual(const Elements& elements, const double* a, double* r) const {
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const auto e = element_nodes<D>(a, static_cast<int>(k));
    const MovingCoordinates<double, D> nodes{e, 0, 0};  // the ends' inertia is in the force
    add_rows(static_cast<int>(k), nodal_residual(elements[k], nodes), a, r);
  }
}

template <int D>
void MovingMesh<D>::add_inertia(const Elements& elements, const double* a, double* r) const {
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const auto e = element_nodes<D>(a, static_cast<int>(k));
    add_rows(static_cast<int>(k), nodal_inertia(elements[k], e), a, r);
  }
}

template <int D>
double MovingMesh<D>::rotary_power(const ChainView<D>& beam, const MovingPart& part, const double* a) const {
  const auto k = static_cast<std::size_t>(part.element);
  const auto e = element_nodes<D>(beam.q, part.element), e_rate = element_nodes<D>(beam.rate, part.element),
             e_a = element_nodes<D>(a, part.element);
  double power = vlbeam::rotary_power(flow_.rotary, marks_[k], marks_[k + 1], part.table, e, e_rate, e_a);
  const auto r = rotary_[k].residual(flow_.rotary, e, e_rate), inertia = rotary_[k].inertia(flow_.rotary, e_a);
  const auto rates = RotaryElement::nodal(e_rate);
  for (std::size_t row = 0; row < 4; ++row) power -= (r[row] + inertia[row]).dot(rates[row]);
  return power;
}

template <int D>
std::array<typename MovingMesh<D>::Inlet, 2> MovingMesh<D>::inlets() const {
  const double start = marks_.front().rate, end = marks_.back().rate;
  return {Inlet{0, 0, 0, start, -start}, Inlet{last(), last() - 1, 1, end, end}};
}

template <int D>
void MovingMesh<D>::add_entering(const ChainView<D>& beam, double* f) const {
  if (model_.formulation == Formulation::virtual_work) return;  // its forces are those of the matter that is there
  for (const Inlet& at : inlets()) {
    position<D>(f, at.node) +=
        (model_.section.rhoA * at.in) * (position<D>(beam.rate, at.node) - at.rate * slope<D>(beam.q, at.node));
    if (flow_.rotary.present()) slope<D>(f, at.node) += at.in * rotary_momentum(beam, at);
  }
}

template <int D>
Vec<double, D> MovingMesh<D>::rotary_momentum(const ChainView<D>& beam, const Inlet& inlet) const {
  const MovingKinematics<double, D> axis = beam.kinematics(inlet.element);
  const PointMotion<double, D> at = axis.at(inlet.u, rational_shape(axis.weights(), inlet.u));
  return flow_.rotary.rhoJ * flow_.rotary.across(at.v_x) - 0.5 * flow_.rotary.gyroscopic * flow_.rotary.turned(at.r_x);
}

template <int D>
bool MovingMesh<D>::solve(const Elements& elements, double* f) {
  mass_.reset(last() + 1);
  for (std::size_t k = 0; k < elements.size(); ++k) mass_.add(static_cast<int>(k), elements[k].mass);
  if (flow_.rotary.present()) {
    Components across = Components::Ones();
    across[0] = 0;  // of the frame, whose first axis is the direction then
    for (std::size_t k = 0; k < elements.size(); ++k) {
      mass_.add_to(across, static_cast<int>(k), flow_.rotary.rhoJ * rotary_[k].mass());
    }
  }
  if (!mass_.factor(free_)) return false;
  const auto turn = [&](const Eigen::Matrix<double, D, D>& into) {
    for (int k = 0; k < 2 * (last() + 1); ++k) {
      Eigen::Map<Vector> part(f + Eigen::Index{D} * k);
      part = (into * part).eval();
    }
  };
  if (!aligned_) turn(frame_.transpose());
  mass_.solve(f);
  if (!aligned_) turn(frame_);
  return true;
}

template <int D>
std::size_t MovingMesh<D>::shortest() const {
  std::size_t least = 0;
  for (std::size_t k = 1; k + 1 < marks_.size(); ++k) least = length(k) < length(least) ? k : least;
  return least;
}

template <int D>
double MovingMesh<D>::tangle() const {
  return least_share - length(shortest()) / reference_length_;
}

template <int D>
std::string MovingMesh<D>::tangled(double t) const {
  const std::size_t least = shortest();
  return "the prescribed nodes tangle: element " + std::to_string(least) + " is " + six_digits(length(least)) +
         " m long at t = " + six_digits(t) + " s";
}

template <int D>
double MovingMesh<D>::least_weight(const std::vector<WeightFunction>& weights) const {
  double most = -1;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    most = std::max(most, lost_weight(weights[k].on(marks_[k].value, marks_[k + 1].value)));
  }
  return most;
}

template <int D>
void MovingMesh<D>::check_motion(double until) const {
  if (const auto tangle = flow_.motion.tangle(0, until, least_share * reference_length_)) {
    throw ModelError(
        "mesh motion",
        "a motion by which element " + std::to_string(tangle->element) +
            " has no length left at t = " + six_digits(tangle->t) + " s",
        "material coordinates must increase from node to node until the end, t = " + six_digits(until) + " s");
  }
  std::vector<Prescribed> nodes;
  check_places<D>(model_.loads.points, until, 1e-9 * reference_length_, [&](double t) {
    flow_.motion.at(t, nodes);
    return std::pair{nodes.front().value, nodes.back().value};
  });
}

template <int D>
std::unique_ptr<MeshEquations<D>> MovingMesh<D>::new_equations(CurrentBeam<D>& beam) const {
  return std::make_unique<Flow<D>>(beam);
}

template <int D>
std::unique_ptr<PrescribedMesh<D>> FlowRoom<D>::prescribed_mesh(const CurrentBeam<D>& beam,
                                                                const std::vector<WeightFunction>& weights) const {
  return std::make_unique<MovingMesh<D>>(beam.model(), weights);
}

template <int D>
void FlowRoom<D>::add_sources(const BeamInside<D>& inside, EventSources<D>& sources) const {
  sources.push_back(std::make_unique<TravelEvents<D>>(inside));
}

template class MovingMesh<2>;
template class MovingMesh<3>;
template class FlowRoom<2>;
template class FlowRoom<3>;

}  // namespace vlbeam
