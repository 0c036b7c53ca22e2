#include "core/joint/joint_chain.hpp"

#include <cmath>

namespace vlbeam {
namespace {

constexpr double settled = 1e-15;  // change of normal forces, over the largest
constexpr int most_rounds = 200;

}  // namespace

template <int D>
void JointChain<D>::layout(const Span<D>& first, const Span<D>& last, const std::vector<SpanBetween<D>>& between,
                           const std::vector<MovingPart>& parts, std::vector<Joint> joints) {
  first_ = &first;
  last_ = &last;
  between_ = &between;
  parts_ = &parts;
  joints_ = std::move(joints);
  stations_.clear();
  of_joint_.assign(joints_.size(), 0);
  of_part_.clear();
  const auto visit = [&](int node, int joint) {
    if (!stations_.empty() && stations_.back().node == node) return;
    Station station;
    station.node = node;
    station.joint = joint;
    if (joint >= 0) {
      const auto j = static_cast<std::size_t>(joint);
      const SlidingJoint& law = *joints_[j].law;
      of_joint_[j] = stations_.size();
      if (law.kinked()) station.behind = 2 * D;
      station.mark = station.behind + D;
      station.size = station.mark + 1 + SlopeConditions<D>(law.slopes, 0).count();
      station.held = joints_[j].held;
    }
    stations_.push_back(station);
  };
  for (const MovingPart& part : parts) {
    visit(part.element, part.a);
    of_part_.push_back(stations_.size() - 1);
    visit(part.element + 1, part.b);
  }
  // a span without elements leaves the beam's end itself open
  const auto ends_at = [](const Span<D>& span, const Station& station) {
    return (span.open_free_position() > 0).all() && (span.open_free_slope() > 0).all() ? station.held : &span.support();
  };
  stations_.front().held = ends_at(first, stations_.front());
  stations_.back().held = ends_at(last, stations_.back());
  for (std::size_t k = 0; k < stations_.size(); ++k) {
    Station& station = stations_[k];
    station.diagonal.resize(station.size, station.size);
    if (k + 1 < stations_.size()) station.upper.resize(station.size, stations_[k + 1].size);
    station.rhs.resize(station.size);
    station.answer.resize(station.size);
  }
  share_.assign(joints_.size(), 0);
  stretch_.assign(joints_.size(), 0);
  normal_.assign(joints_.size(), 0);
  pull_.assign(joints_.size(), Vec<double, D>::Zero());
  influence_.resize(D * static_cast<Eigen::Index>(joints_.size()), static_cast<Eigen::Index>(joints_.size()));
}

template <int D>
void JointChain<D>::hold(const Support<D>& held, Station& station, Station* previous) {
  Block keep = Block::Identity(station.size, station.size);
  const auto share = [&](const typename Support<D>::Components& free) -> Eigen::Matrix<double, D, D> {
    return held.frame * free.matrix().asDiagonal() * held.frame.transpose();
  };
  keep.template block<D, D>(0, 0) = share(held.free_position);
  keep.template block<D, D>(D, D) = share(held.free_slope);
  const Block whole = station.diagonal;
  station.diagonal = keep * whole * keep;
  station.diagonal += Block::Identity(station.size, station.size) - keep;
  if (station.upper.size() > 0) station.upper = (keep * station.upper).eval();
  if (previous != nullptr) previous->upper = (previous->upper * keep).eval();
  station.rhs = (keep * station.rhs).eval();
}

template <int D>
void JointChain<D>::assemble(const std::vector<MovingEquations<double, D>>& equations,
                             const std::vector<JointMotion<D>>& motion) {
  for (Station& station : stations_) {
    station.diagonal.setZero();
    station.upper.setZero();
  }
  const auto add = [](Block& to, Eigen::Index row, Eigen::Index column, double m) {
    to.template block<D, D>(row, column).diagonal().array() += m;
  };
  const auto add_even = [&](Block& to, Eigen::Index row, Eigen::Index column, double m) {
    add(to, row, column, m);
    if (row != column) add(to, column, row, m);
  };
  const auto border = [](Block& to, Eigen::Index row, Eigen::Index mark, const Vec<double, D>& m) {
    to.template block<D, 1>(row, mark) += m;
    to.template block<1, D>(mark, row) += m.transpose();
  };
  for (std::size_t p = 0; p < parts_->size(); ++p) {
    const MovingEquations<double, D>& eq = equations[p];
    const auto& m = eq.mass;
    Station &a = stations_[of_part_[p]], &b = stations_[of_part_[p] + 1];
    const Eigen::Index s_a = a.joint >= 0 ? a.behind : D;
    add_even(a.diagonal, 0, 0, m[0][0]);
    add_even(a.diagonal, 0, s_a, m[0][1]);
    add_even(a.diagonal, s_a, s_a, m[1][1]);
    add_even(b.diagonal, 0, 0, m[2][2]);
    add_even(b.diagonal, 0, D, m[2][3]);
    add_even(b.diagonal, D, D, m[3][3]);
    add(a.upper, 0, 0, m[0][2]);
    add(a.upper, 0, D, m[0][3]);
    add(a.upper, s_a, 0, m[1][2]);
    add(a.upper, s_a, D, m[1][3]);
    if (a.joint >= 0) {
      border(a.diagonal, 0, a.mark, eq.mass_a[0]);
      border(a.diagonal, s_a, a.mark, eq.mass_a[1]);
      a.diagonal(a.mark, a.mark) += eq.mass_aa;
      a.upper.template block<1, D>(a.mark, 0) += eq.mass_a[2].transpose();
      a.upper.template block<1, D>(a.mark, D) += eq.mass_a[3].transpose();
    }
    if (b.joint >= 0) {
      border(b.diagonal, 0, b.mark, eq.mass_b[2]);
      border(b.diagonal, D, b.mark, eq.mass_b[3]);
      b.diagonal(b.mark, b.mark) += eq.mass_bb;
      a.upper.template block<D, 1>(0, b.mark) += eq.mass_b[0];
      a.upper.template block<D, 1>(s_a, b.mark) += eq.mass_b[1];
    }
    if (a.joint >= 0 && b.joint >= 0) a.upper(a.mark, b.mark) += eq.mass_ab;
  }
  const auto add_span = [](Station& station, const Span<D>& span) {
    const auto& frame = span.support().frame;
    const auto part = [&](const typename Span<D>::Components& diagonal) -> Eigen::Matrix<double, D, D> {
      return frame * diagonal.matrix().asDiagonal() * frame.transpose();
    };
    const NodeBlock<D>& block = span.open_mass();
    station.diagonal.template block<D, D>(0, 0) += part(block.rr);
    station.diagonal.template block<D, D>(0, D) += part(block.rs);
    station.diagonal.template block<D, D>(D, 0) += part(block.rs);
    station.diagonal.template block<D, D>(D, D) += part(block.ss);
  };
  add_span(stations_.front(), *first_);
  add_span(stations_.back(), *last_);
  std::size_t k = 0;
  for (const SpanBetween<D>& span : *between_) {
    while (stations_[k].node != span.low()) ++k;
    if (span.low() == span.high()) continue;
    Station &low = stations_[k], &high = stations_[k + 1];
    const auto &l = span.low_low(), &c = span.low_high();
    add_even(low.diagonal, 0, 0, l.rr);
    add_even(low.diagonal, 0, D, l.rs);
    add_even(low.diagonal, D, D, l.ss);
    add(low.upper, 0, 0, c.rr);
    add(low.upper, 0, D, c.rs);
    add(low.upper, D, 0, c.sr);
    add(low.upper, D, D, c.ss);
    add_span(high, span.span());
  }
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    Station& station = stations_[of_joint_[j]];
    add(station.diagonal, 0, 0, joints_[j].law->mass);
    station.diagonal(station.mark, station.mark) += motion[j].x_inertia;
    if (!joints_[j].law->kinked()) continue;
    const SlopeConditions<D> conditions(joints_[j].law->slopes, longest_axis<D>(motion[j].slopes.template head<D>()));
    for (int i = 0; i < conditions.count(); ++i) {
      const Eigen::Matrix<double, 2 * D, 1> gradient = conditions.gradient(i, motion[j].slopes);
      const Eigen::Index at = station.mark + 1 + i;
      station.diagonal.template block<2 * D, 1>(D, at) = gradient;
      station.diagonal.template block<1, 2 * D>(at, D) = gradient.transpose();
      station.rhs[at] = -conditions.rate(i, motion[j].slope_rates, motion[j].slope_rates);
    }
  }
}

template <int D>
void JointChain<D>::guide(std::size_t which, double acceleration) {
  Station& station = stations_[which];
  const Eigen::Index x = station.mark;
  typename Station::Guided& row = station.guided.emplace();
  row.own = station.diagonal.row(x);
  row.force = station.rhs[x];
  station.rhs -= acceleration * row.own;
  station.rhs[x] = acceleration;
  station.diagonal.row(x).setZero();
  station.diagonal.col(x).setZero();
  station.diagonal(x, x) = 1;
  if (which + 1 < stations_.size()) {
    row.next = station.upper.row(x);
    stations_[which + 1].rhs -= acceleration * row.next;
    station.upper.row(x).setZero();
  }
  if (which > 0) {
    Station& previous = stations_[which - 1];
    row.previous = previous.upper.col(x);
    previous.rhs -= acceleration * row.previous;
    previous.upper.col(x).setZero();
  }
}

template <int D>
double JointChain<D>::guide_force(std::size_t which) const {
  const typename Station::Guided& row = *stations_[which].guided;
  double force = row.own.dot(stations_[which].rhs) - row.force;
  if (which + 1 < stations_.size()) force += row.next.dot(stations_[which + 1].rhs);
  if (which > 0) force += row.previous.dot(stations_[which - 1].rhs);
  return force;
}

template <int D>
void JointChain<D>::keep_rows(std::size_t which) {
  Station& station = stations_[which];
  station.held_rows.reset();
  if (station.joint < 0) return;
  const Joint& joint = joints_[static_cast<std::size_t>(station.joint)];
  if (joint.held == nullptr || !joint.law->friction) return;
  auto& rows = station.held_rows.emplace();
  rows.own = station.diagonal.template topRows<D>();
  if (which > 0) rows.previous = stations_[which - 1].upper.template leftCols<D>().transpose();
  if (which + 1 < stations_.size()) rows.next = station.upper.template topRows<D>();
  rows.force = station.rhs.template head<D>();
}

template <int D>
bool JointChain<D>::factor() {
  for (std::size_t k = 0; k < stations_.size(); ++k) {
    Station& station = stations_[k];
    if (k > 0) {
      const Station& previous = stations_[k - 1];
      station.diagonal.noalias() -= previous.upper.transpose() * previous.factor.solve(previous.upper);
    }
    if (!station.diagonal.allFinite()) return false;
    station.factor.compute(station.diagonal);
    if (!(station.factor.matrixLU().diagonal().cwiseAbs().minCoeff() > 0)) return false;
  }
  return true;
}

template <int D>
void JointChain<D>::substitute() {
  for (std::size_t k = 0; k < stations_.size(); ++k) {
    Station& station = stations_[k];
    if (k > 0) station.rhs.noalias() -= stations_[k - 1].upper.transpose() * stations_[k - 1].rhs;
    station.rhs = station.factor.solve(station.rhs).eval();
  }
  for (std::size_t k = stations_.size() - 1; k-- > 0;) {
    Station& station = stations_[k];
    const Column by_next = station.upper * stations_[k + 1].rhs;
    station.rhs -= station.factor.solve(by_next);
  }
}

template <int D>
Vec<double, D> JointChain<D>::lacking(std::size_t which, bool with_forces) const {
  const auto& rows = stations_[which].held_rows;
  if (!rows) return Vec<double, D>::Zero();
  Vec<double, D> sum = -rows->own * stations_[which].rhs;
  if (with_forces) sum += rows->force;
  if (which > 0) sum -= rows->previous * stations_[which - 1].rhs;
  if (which + 1 < stations_.size()) sum -= rows->next * stations_[which + 1].rhs;
  return sum;
}

/// The normal force at one joint depends on the friction at the others, but little: by rounds over them all.
template <int D>
std::optional<double> JointChain<D>::add_friction(const std::vector<JointMotion<D>>& motion) {
  for (Station& station : stations_) station.answer = station.rhs;
  const auto count = joints_.size();
  const auto contact_at = [&](std::size_t j) { return motion[j].contact(*joints_[j].law); };
  for (std::size_t j = 0; j < count; ++j) {  // by the beam on the joint
    pull_[j] = joints_[j].law->mass * (stations_[of_joint_[j]].rhs.template head<D>() - motion[j].gravity) +
               lacking(of_joint_[j], true);
  }
  const auto push = [&](std::size_t j, double force) {
    Station& station = stations_[of_joint_[j]];
    if (!station.guided) station.rhs[station.mark] += stretch_[j] * force;
  };
  for (std::size_t j = 0; j < count; ++j) {
    const Contact<double, D> contact = contact_at(j);
    const auto& friction = joints_[j].law->friction;
    stretch_[j] = contact.stretch();
    share_[j] = friction ? contact.share(*friction, motion[j].x_rate) : 0;
    if (share_[j] == 0) continue;
    for (Station& station : stations_) station.rhs.setZero();
    push(j, 1);
    substitute();
    for (std::size_t i = 0; i < count; ++i) {
      influence_.template block<D, 1>(D * static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          contact_at(i).pressing(joints_[i].law->mass * stations_[of_joint_[i]].rhs.template head<D>() +
                                 lacking(of_joint_[i], false));
    }
  }
  const auto influence = [&](std::size_t on, std::size_t by) -> Vec<double, D> {
    return influence_.template block<D, 1>(D * static_cast<Eigen::Index>(on), static_cast<Eigen::Index>(by));
  };
  normal_.assign(count, 0);
  double change = 1, largest = 0;
  for (int round = 0; change > settled * largest; ++round) {
    if (round == most_rounds) return std::nullopt;
    change = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (share_[i] == 0) continue;
      Vec<double, D> pull = contact_at(i).pressing(pull_[i]);
      for (std::size_t j = 0; j < count; ++j) {
        if (j != i && share_[j] != 0) pull -= share_[j] * normal_[j] * influence(i, j);
      }
      const auto normal = pressing_force<D>(pull, influence(i, i), share_[i]);
      if (!normal) return std::nullopt;
      change = std::max(change, std::abs(*normal - normal_[i]));
      largest = std::max(largest, *normal);
      normal_[i] = *normal;
    }
  }
  for (Station& station : stations_) station.rhs.setZero();
  double dissipation = 0;
  for (std::size_t j = 0; j < count; ++j) {
    push(j, -share_[j] * normal_[j]);
    dissipation += share_[j] * normal_[j] * stretch_[j] * motion[j].x_rate;
  }
  substitute();
  for (Station& station : stations_) station.rhs += station.answer;
  return dissipation;
}

template <int D>
std::optional<JointPower> JointChain<D>::solve(const std::vector<MovingEquations<double, D>>& equations,
                                               const std::vector<JointMotion<D>>& motion, double* force) {
  first_->reduce(force);
  last_->reduce(force);
  for (const SpanBetween<D>& span : *between_) span.reduce(force);
  bool rubs = false;
  for (Station& station : stations_) {
    station.rhs.template head<D>() = position<D>(force, station.node);
    station.rhs.template segment<D>(D) = slope<D>(force, station.node);
    if (station.joint < 0) continue;
    const Joint& joint = joints_[static_cast<std::size_t>(station.joint)];
    if (joint.law->kinked()) {
      station.rhs.template segment<D>(station.behind) = Eigen::Map<const Vec<double, D>>(force + joint.place.behind);
    }
    station.rhs[station.mark] = force[joint.place.mark];
    rubs = rubs || joint.law->friction;
  }
  assemble(equations, motion);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    stations_[of_joint_[j]].guided.reset();
    if (const auto& given = motion[j].x_acceleration) guide(of_joint_[j], *given);
  }
  for (std::size_t k = 0; k < stations_.size(); ++k) keep_rows(k);
  for (std::size_t k = 0; k < stations_.size(); ++k) {
    if (stations_[k].held != nullptr) hold(*stations_[k].held, stations_[k], k > 0 ? &stations_[k - 1] : nullptr);
  }
  if (!factor()) return std::nullopt;
  substitute();
  const auto dissipation = rubs ? add_friction(motion) : std::optional(0.0);
  if (!dissipation) return std::nullopt;
  JointPower power{.dissipated = *dissipation};
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (!motion[j].x_acceleration) continue;
    const double rubs_off = share_[j] * normal_[j] * stretch_[j];
    power.guided += (guide_force(of_joint_[j]) + rubs_off) * motion[j].x_rate;
  }
  for (const Station& station : stations_) {
    position<D>(force, station.node) = station.rhs.template head<D>();
    slope<D>(force, station.node) = station.rhs.template segment<D>(D);
    if (station.joint < 0) continue;
    const Joint& joint = joints_[static_cast<std::size_t>(station.joint)];
    if (joint.law->kinked()) {
      Eigen::Map<Vec<double, D>>(force + joint.place.behind) = station.rhs.template segment<D>(station.behind);
    }
    force[joint.place.mark] = station.rhs[station.mark];
  }
  for (const SpanBetween<D>& span : *between_) span.substitute(force);
  first_->substitute(force);
  last_->substitute(force);
  return power;
}

template class JointChain<2>;
template class JointChain<3>;

}  // namespace vlbeam
