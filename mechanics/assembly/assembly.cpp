#include "mechanics/assembly/assembly.hpp"

#include <stdexcept>

#include "core/error.hpp"
#include "mechanics/assembly/assembly_equations.hpp"

namespace vlbeam {

template <int D>
Handle<D> BeamMember<D>::handle(const LinkEnd<D>& end, double t) const {
  int node = end.of == LinkEnd<D>::Of::beam_start ? 0 : system_.mesh().last();
  if (end.of == LinkEnd<D>::Of::node) node = end.joint;
  if (end.of == LinkEnd<D>::Of::joint) {
    if (!system_.on_beam(end.joint) || system_.loose() != nullptr) {
      throw ComputationFailed("joint " + std::to_string(end.joint) + ", which a link holds, has left the beam", t);
    }
    node = system_.place_of(end.joint).node;
  }
  const Eigen::Index at = Eigen::Index{node_size<D>} * node;
  return {{{end.direction ? at + D : at, 1.0}}};
}

template <int D>
AssemblySystem<D>::AssemblySystem(Members members, std::vector<Link<D>> links)
    : members_(std::move(members)), links_(std::move(links)) {
  for (const Link<D>& link : links_) {
    first_end_.push_back(ends_.size());
    for (const LinkEnd<D>& end : link.ends) ends_.push_back(&end);
  }
  adopt(0);
  initial_.setZero(size());
  for (std::size_t b = 0; b < members_.size(); ++b) {
    const Eigen::VectorXd own = members_[b]->initial_state();
    const Eigen::Index n = members_[b]->coordinates();
    initial_.segment(first_[b], n) = own.head(n);
    initial_.segment(coordinates() + first_[b], n) = own.segment(n, n);
  }
  view_ = std::make_unique<AssemblyEquations<D>>(*this);
}

template <int D>
AssemblySystem<D>::~AssemblySystem() = default;

template <int D>
void AssemblySystem<D>::adopt(double t) {
  ++revision_;
  first_.clear();
  Eigen::Index at = 0;
  for (const auto& member : members_) {
    first_.push_back(at);
    at += member->coordinates();
  }
  coordinates_ = at;
  states_.resize(members_.size());
  for (const auto& member : members_) member->link_forces().all.clear();  // they name handles that are no more
  handles_.clear();
  is_whole_ = false;  // until each link has found what it holds
  for (const LinkEnd<D>* end : ends_) {
    handles_.push_back(end->member == LinkEnd<D>::no_member ? Handle<D>{{}, end->place}
                                                            : members_[end->member]->handle(*end, t));
  }
  is_whole_ = true;
}

template <int D>
LinkVector AssemblySystem<D>::values(const Eigen::VectorXd& y, std::size_t link, bool rates) const {
  const std::size_t count = links_[link].ends.size();
  LinkVector h(static_cast<Eigen::Index>(D * count));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t handle = first_end_[link] + i, member = ends_[handle]->member;
    const double* const q =
        member == LinkEnd<D>::no_member ? nullptr : y.data() + first_[member] + (rates ? coordinates() : 0);
    h.template segment<D>(static_cast<Eigen::Index>(D * i)) =
        rates ? handles_[handle].rate(q) : handles_[handle].value(q);
  }
  return h;
}

template <int D>
std::vector<typename AssemblySystem<D>::Gap> AssemblySystem<D>::gaps() const {
  std::vector<Gap> gaps;
  for (std::size_t k = 0; k < links_.size(); ++k) {
    Gap& gap = gaps.emplace_back();
    const LinkVector h = values(initial_, k, false), rate = values(initial_, k, true);
    for (const LinkCondition& condition : links_[k].conditions) {
      gap.position = std::max(gap.position, std::abs(condition.value(h)));
      gap.rate = std::max(gap.rate, std::abs(condition.slope(h).dot(rate)));
    }
  }
  return gaps;
}

template <int D>
std::vector<std::string> AssemblySystem<D>::settle() {
  for (std::size_t k = 0; k < links_.size(); ++k) {
    const LinkVector h = values(initial_, k, false);
    for (LinkCondition& condition : links_[k].conditions) condition.constant -= condition.value(h);
  }
  project(initial_, 0);
  find_forces(initial_, 0);
  return redundant;
}

template <int D>
std::vector<FieldRun> AssemblySystem<D>::fields() const {
  std::vector<FieldRun> runs;
  for (std::size_t b = 0; b < members_.size(); ++b) {
    for (FieldRun run : members_[b]->ode().fields()) {
      run.first += first_[b];
      runs.push_back(run);
    }
  }
  return runs;
}

template <int D>
void AssemblySystem<D>::rhs(const Eigen::VectorXd& y, Eigen::VectorXd& dydt, double t) {
  const Eigen::Index n = coordinates();
  const double lost = find_forces(y, t);
  dydt.setZero(y.size());
  dydt.head(n) = y.segment(n, n);
  EnergyBalance power;
  power.dissipated = lost;
  Eigen::VectorXd rates;
  for (std::size_t b = 0; b < members_.size(); ++b) {
    const Eigen::VectorXd& own = state_of(y, b);
    const Eigen::Index count = members_[b]->coordinates();
    rates.resize(own.size());
    members_[b]->ode().rhs(own, rates, t);
    dydt.segment(n + first_[b], count) = rates.segment(count, count);
    power = power + members_[b]->balance().of(rates);
  }
  balance().add(power, dydt);
}

template <int D>
void AssemblySystem<D>::correct(Eigen::VectorXd& y, double t) {
  if (!corrects) return;
  for (std::size_t b = 0; b < members_.size(); ++b) {
    Eigen::VectorXd own = state_of(y, b);
    if (!members_[b]->correct(own)) continue;
    const Eigen::Index count = members_[b]->coordinates();
    y.segment(first_[b], count) = own.head(count);
    y.segment(coordinates() + first_[b], count) = own.segment(count, count);
  }
  Eigen::VectorXd q, v;
  view_->expand(y, q, v);
  view_->approach(q, v, t);
  view_->contract(q, v, y);
}

template <int D>
void AssemblySystem<D>::jacobian(const Eigen::VectorXd& /*y*/, double /*t*/, Eigen::MatrixXd& /*dfdy*/,
                                 Eigen::VectorXd& /*dfdt*/) {
  throw std::logic_error("assemblies have no Jacobian of their right-hand side");
}

template <int D>
std::unique_ptr<SecondOrderSystem> AssemblySystem<D>::new_second_order() {
  auto view = std::make_unique<AssemblyEquations<D>>(*this);
  view->follow(*view_);
  return view;
}

template <int D>
BalanceEntries AssemblySystem<D>::balance() const {
  BalanceEntries all;
  for (const auto& member : members_) {
    const BalanceEntries own = member->balance();
    all.dissipated = all.dissipated || own.dissipated;
    all.loads = all.loads || own.loads;
    all.ends = all.ends || own.ends;
    all.supports = all.supports || own.supports;
  }
  for (const Link<D>& link : links_) all.dissipated = all.dissipated || (link.spring && link.spring->damping > 0);
  return all;
}

template <int D>
const Eigen::VectorXd& AssemblySystem<D>::state_of(const Eigen::VectorXd& y, std::size_t which) const {
  const Member<D>& member = *members_[which];
  const Eigen::Index n = member.coordinates();
  Eigen::VectorXd& own = states_[which];
  own.resize(2 * n + member.balance().count());
  own.head(n) = y.segment(first_[which], n);
  own.segment(n, n) = y.segment(coordinates() + first_[which], n);
  own.tail(own.size() - 2 * n).setZero();
  return own;
}

template <int D>
Guards AssemblySystem<D>::guards(const Eigen::VectorXd& y, double t) const {
  Guards all;
  for (std::size_t b = 0; b < members_.size(); ++b) {
    for (Guard guard : members_[b]->ode().guards(state_of(y, b), t)) {
      guard.source += static_cast<int>(1000 * b);
      all.push_back(guard);
    }
  }
  return all;
}

template <int D>
void AssemblySystem<D>::handle_event(int index, Eigen::VectorXd& y, double t) {
  for (std::size_t b = 0; b < members_.size(); ++b) {
    const Eigen::VectorXd now = state_of(y, b);
    const auto count = static_cast<int>(members_[b]->ode().guards(now, t).size());
    if (index >= count) {
      index -= count;
      continue;
    }
    const double before = observe(y, t, own_points).energy.total();
    const Eigen::Index old_n = coordinates(), own_n = members_[b]->coordinates(), others = y.size() - 2 * old_n;
    Eigen::VectorXd own = now;
    members_[b]->link_forces().all.clear();  // an event moves what they act on
    members_[b]->ode().handle_event(index, own, t);
    const Eigen::Index n = members_[b]->coordinates(), at = first_[b], behind = old_n - at - own_n;
    Eigen::VectorXd changed(2 * (old_n - own_n + n) + others);
    const Eigen::Index new_n = old_n - own_n + n;
    for (const Eigen::Index half : {0, 1}) {
      changed.segment(half * new_n, at) = y.segment(half * old_n, at);
      changed.segment(half * new_n + at, n) = own.segment(half * n, n);
      changed.segment(half * new_n + at + n, behind) = y.segment(half * old_n + at + own_n, behind);
    }
    changed.tail(others) = y.tail(others);
    y = std::move(changed);
    adopt(t);
    project(y, t);
    if (on_event) on_event(observe(y, t, own_points).energy.total() - before);
    return;
  }
}

template <int D>
void AssemblySystem<D>::project(Eigen::VectorXd& y, double t) {
  Eigen::VectorXd q, v;
  view_->expand(y, q, v);
  view_->project(q, v, t);
  view_->contract(q, v, y);
}

template <int D>
double AssemblySystem<D>::find_forces(const Eigen::VectorXd& y, double t) {
  Eigen::VectorXd q, v, a;
  view_->expand(y, q, v);
  return view_->find_acceleration(q, v, t, a);
}

template <int D>
void AssemblySystem<D>::sample(const Eigen::VectorXd& y, double t) {
  if (!is_whole_ || y.size() != size()) throw ComputationFailed("a link has lost what it held", t);
  find_forces(y, t);
  for (std::size_t b = 0; b < members_.size(); ++b) members_[b]->ode().sample(state_of(y, b), t);
  if (on_sample) on_sample(y, t);
}

template <int D>
bool AssemblySystem<D>::proceed(const Eigen::VectorXd& y, double t) {
  bool goes_on = true;
  for (std::size_t b = 0; b < members_.size(); ++b) {
    goes_on = members_[b]->ode().proceed(state_of(y, b), t) && goes_on;
  }
  if (on_state) on_state(y, t);
  return goes_on && (!on_step || on_step(t));
}

template <int D>
std::string AssemblySystem<D>::fastest(const Eigen::VectorXd& y) const {
  for (std::size_t b = 0; b < members_.size(); ++b) {
    const std::string text = members_[b]->ode().fastest(state_of(y, b));
    if (!text.empty()) return text;
  }
  return "";
}

template <int D>
void AssemblySystem<D>::exchange(Archive& memory) {
  for (const auto& member : members_) member->ode().exchange(memory);
  view_->exchange(memory);
}

template <int D>
Vec<double, D> AssemblySystem<D>::apart(const Eigen::VectorXd& y, std::size_t link) const {
  if (links_[link].ends.size() < 2) return Vec<double, D>::Zero();
  const LinkVector h = values(y, link, false);
  return h.segment<D>(D) - h.segment<D>(0);
}

template <int D>
double AssemblySystem<D>::spring_energy(const Eigen::VectorXd& y) const {
  double sum = 0;
  for (std::size_t k = 0; k < links_.size(); ++k) {
    const auto& spring = links_[k].spring;
    if (!spring) continue;
    const LinkVector h = values(y, k, false);
    const double stretch = (h.segment<D>(D) - h.segment<D>(0)).norm() - spring->length;
    if (!spring->tension_only || stretch > 0) sum += 0.5 * spring->stiffness * stretch * stretch;
  }
  return sum;
}

template <int D>
Observation<D> AssemblySystem<D>::observe(const Eigen::VectorXd& y, double t, int points) const {
  Observation<D> all;
  for (std::size_t b = 0; b < members_.size(); ++b) all += members_[b]->observe(state_of(y, b), t, points);
  all.energy.axial += spring_energy(y);
  const EnergyBalance given = balance().of(y);
  all.energy.dissipated += given.dissipated;
  all.energy.supplied += given.supports;
  all.load_work += given.loads;
  all.end_work += given.ends;
  return all;
}

template <int D>
std::vector<Vec<double, D>> AssemblySystem<D>::forces_of(std::size_t link) const {
  std::vector<Vec<double, D>> forces(links_[link].ends.size(), Vec<double, D>::Zero());
  std::vector<std::size_t> seen(members_.size(), 0);
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    const std::size_t member = ends_[i]->member;
    if (member == LinkEnd<D>::no_member) continue;
    const std::size_t which = seen[member]++;
    if (i < first_end_[link] || i >= first_end_[link] + forces.size()) continue;
    const auto& all = members_[member]->link_forces().all;
    if (which < all.size()) forces[i - first_end_[link]] = all[which].force;
  }
  return forces;
}

template class BeamMember<2>;
template class BeamMember<3>;
template class BodyMember<2>;
template class BodyMember<3>;
template class AssemblySystem<2>;
template class AssemblySystem<3>;

}  // namespace vlbeam
