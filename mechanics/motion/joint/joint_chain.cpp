#include "mechanics/motion/joint/joint_chain.hpp"

#include <type_traits>

namespace vlbeam {
namespace {

/// Calls `work` with the number of unknowns: that of most joints, of one slope, is a constant there.
template <int Usual, class Work>
bool with_size(int size, const Work& work) {
  return size == Usual ? work(std::integral_constant<int, Usual>()) : work(size);
}

}  // namespace

template <int D>
void JointChain<D>::layout(const Span<D>& first, const Span<D>& last, const std::vector<SpanBetween<D>>& between,
                           const std::vector<MovingPart>& parts, std::vector<Joint> joints) {
  first_ = &first;
  last_ = &last;
  between_ = &between;
  parts_ = &parts;
  joints_ = std::move(joints);
  stations_ = std::vector<Station>(joints_.size());
  open_.assign(joints_.size() - 1, std::nullopt);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    Station& station = stations_[j];
    const SlidingJoint& law = *joints_[j].law;
    if (law.kinked()) station.behind = 2 * D;
    station.mark = station.behind + D;
    station.size = station.mark + 1 + SlopeConditions<D>(law.slopes, 0).count();
    station.held = joints_[j].held;
  }
  // a joint at an end of the beam has its support
  const auto ends_at = [](const Span<D>& span, Station& station) {
    if ((span.open_free_position() == 0).any() || (span.open_free_slope() == 0).any()) station.held = &span.support();
  };
  if (parts.front().a >= 0) ends_at(first, stations_.front());
  if (parts.back().b >= 0) ends_at(last, stations_.back());
  share_.assign(joints_.size(), 0);
  stretch_.assign(joints_.size(), 0);
  normal_.assign(joints_.size(), 0);
  pull_.assign(joints_.size(), Vec<double, D>::Zero());
  influence_.resize(D * static_cast<Eigen::Index>(joints_.size()), static_cast<Eigen::Index>(joints_.size()));
}

template <int D>
void JointChain<D>::add_tie(const JointTie<D>& tie, Station& one, Station& other) {
  const auto add_end = [](Station& station, int s, const auto& mass, const auto& by_x, double xx) {
    Block& to = station.mass;
    for (int c = 0; c < D; ++c) {
      to(c, c) += mass(0, 0);
      to(c, s + c) += mass(0, 1);
      to(s + c, s + c) += mass(1, 1);
      to(c, station.mark) += by_x(0, c);
      to(s + c, station.mark) += by_x(1, c);
    }
    to(station.mark, station.mark) += xx;
  };
  add_end(one, one.behind, tie.mass.template topLeftCorner<2, 2>(), tie.by_a.template topRows<2>(), tie.aa);
  add_end(other, D, tie.mass.template bottomRightCorner<2, 2>(), tie.by_b.template bottomRows<2>(), tie.bb);
  for (int c = 0; c < D; ++c) {
    for (int i = 0; i < 2; ++i) {
      const int row = (i == 0 ? 0 : one.behind) + c;
      one.next(row, c) = tie.mass(i, 2);
      one.next(row, D + c) = tie.mass(i, 3);
      one.next(row, 2 * D) = tie.by_b(i, c);
      one.next(one.mark, i * D + c) = tie.by_a(2 + i, c);
    }
  }
  one.next(one.mark, 2 * D) = tie.ab;
}

template <int D>
void JointChain<D>::add_conditions(const JointMotion<D>& motion, JointSlopes slopes, Station& station) {
  const SlopeConditions<D> conditions(slopes, longest_axis<D>(motion.slopes.template head<D>()));
  for (int i = 0; i < conditions.count(); ++i) {
    const int at = station.mark + 1 + i;
    station.mass.template block<2 * D, 1>(D, at) = conditions.gradient(i, motion.slopes);
    station.rhs[at] = -conditions.rate(i, motion.slope_rates, motion.slope_rates);
  }
}

template <int D>
void JointChain<D>::assemble(const std::vector<MovingEquations<double, D>>& equations,
                             const std::vector<JointMotion<D>>& motion, const double* force) {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    Station& station = stations_[j];
    const Joint& joint = joints_[j];
    station.mass.setZero();
    station.next.setZero();
    station.rhs.setZero();
    station.rhs.template head<D>() = position<D>(force, joint.place.node);
    station.rhs.template segment<D>(D) = slope<D>(force, joint.place.node);
    if (joint.law->kinked()) {
      station.rhs.template segment<D>(station.behind) = Eigen::Map<const Vec<double, D>>(force + joint.place.behind);
      add_conditions(motion[j], joint.law->slopes, station);
    }
    station.rhs[station.mark] = force[joint.place.mark];
    for (int c = 0; c < D; ++c) station.mass(c, c) = joint.law->mass;
    station.mass(station.mark, station.mark) = motion[j].x_inertia;
  }
  const auto add_side = [&](const Span<D>& span, std::size_t part, std::size_t joint_end, std::optional<Side>& open) {
    open.emplace(span, equations[part], joint_end);
    Station& station = joint_end == 2 ? stations_.front() : stations_.back();
    typename Side::Matrix mass = Side::Matrix::Zero();
    typename Side::Column rhs = Side::Column::Zero();
    open->eliminate(force, mass, rhs);
    for (int i = 0; i < side; ++i) {
      const int row = joint_end == 2 ? station.before_at(i) : station.behind_at(i);
      station.rhs[row] += rhs[i];
      for (int k = i; k < side; ++k) {
        station.mass(row, joint_end == 2 ? station.before_at(k) : station.behind_at(k)) += mass(i, k);
      }
    }
  };
  if (parts_->front().a < 0) add_side(*first_, 0, 2, first_side_);
  if (parts_->back().b < 0) add_side(*last_, parts_->size() - 1, 0, last_side_);
  auto run = between_->begin();
  auto part = static_cast<std::size_t>(parts_->front().a < 0 ? 1 : 0);  // behind the joint
  for (std::size_t j = 0; j + 1 < joints_.size(); ++j) {
    Station &one = stations_[j], &other = stations_[j + 1];
    const MovingEquations<double, D>& eq = equations[part];
    JointTie<D> tie;
    if ((*parts_)[part].b >= 0) {
      for (int i = 0; i < 4; ++i) {
        const auto row = static_cast<std::size_t>(i);
        for (int k = 0; k < 4; ++k) tie.mass(i, k) = eq.mass[row][static_cast<std::size_t>(k)];
        tie.by_a.row(i) = eq.mass_a[row].transpose();
        tie.by_b.row(i) = eq.mass_b[row].transpose();
      }
      tie.aa = eq.mass_aa;
      tie.ab = eq.mass_ab;
      tie.bb = eq.mass_bb;
      part += 1;
    } else {
      const MovingEquations<double, D>& behind = equations[part + 1];
      OpenNodes<D>& open = open_[j].emplace(*run++, eq, behind);
      open.condense(eq, behind, tie);
      typename OpenNodes<D>::Force on_one, on_other;
      open.reduce(force, on_one, on_other);
      for (int c = 0; c < D; ++c) {
        one.rhs[c] += on_one.nodal(0, c);
        one.rhs[one.behind + c] += on_one.nodal(1, c);
        other.rhs[c] += on_other.nodal(0, c);
        other.rhs[D + c] += on_other.nodal(1, c);
      }
      one.rhs[one.mark] += on_one.x;
      other.rhs[other.mark] += on_other.x;
      part += 2;
    }
    add_tie(tie, one, other);
  }
}

template <int D>
bool JointChain<D>::factor() {
  for (std::size_t j = 0; j < stations_.size(); ++j) {
    Station& station = stations_[j];
    Block& m = station.mass;
    Columns& next = station.next;
    const bool last = j + 1 == stations_.size();
    const bool sound = with_size<side>(station.size, [&](const auto size) {
      for (int k = 0; k < size; ++k) {
        const double pivot = k <= station.mark ? m(k, k) : -m(k, k);
        if (!(pivot > 0) || !std::isfinite(pivot)) return false;
        const double inverse = 1 / m(k, k);
        for (int i = k + 1; i < size; ++i) {
          const double share = m(k, i) * inverse;
          for (int c = i; c < size; ++c) m(i, c) -= share * m(k, c);
          if (!last) next.row(i) -= share * next.row(k);
          m(k, i) = share;
        }
        m(k, k) = inverse;
      }
      return true;
    });
    if (!sound) return false;
    if (last) return true;
    Station& following = stations_[j + 1];
    Eigen::Matrix<double, side, side> taken = Eigen::Matrix<double, side, side>::Zero();
    with_size<side>(station.size, [&](const auto size) {
      for (int k = 0; k < size; ++k) {
        for (int i = 0; i < side; ++i) {
          const double share = next(k, i) * m(k, k);
          for (int c = i; c < side; ++c) taken(i, c) += share * next(k, c);
        }
      }
      return true;
    });
    for (int i = 0; i < side; ++i) {
      for (int c = i; c < side; ++c) following.mass(following.before_at(i), following.before_at(c)) -= taken(i, c);
    }
  }
  return true;
}

template <int D>
void JointChain<D>::substitute() {
  for (std::size_t j = 0; j < stations_.size(); ++j) {
    Station& station = stations_[j];
    Column& y = station.rhs;
    with_size<side>(station.size, [&](const auto size) {
      for (int k = 0; k < size; ++k) {
        for (int i = k + 1; i < size; ++i) y[i] -= station.mass(k, i) * y[k];
        y[k] *= station.mass(k, k);
      }
      return true;
    });
    if (j + 1 == stations_.size()) break;
    Station& following = stations_[j + 1];
    const OfSide taken = station.next.transpose() * y;
    following.rhs.template head<2 * D>() -= taken.template head<2 * D>();
    following.rhs[following.mark] -= taken[2 * D];
  }
  for (std::size_t j = stations_.size(); j-- > 0;) {
    Station& station = stations_[j];
    Column& y = station.rhs;
    if (j + 1 < stations_.size()) {
      const OfSide known = before(stations_[j + 1]);
      with_size<side>(station.size, [&](const auto size) {
        for (int k = 0; k < size; ++k) y[k] -= station.mass(k, k) * station.next.row(k).dot(known);
        return true;
      });
    }
    with_size<side>(station.size, [&](const auto size) {
      for (int k = size - 1; k >= 0; --k) {
        for (int i = k + 1; i < size; ++i) y[k] -= station.mass(k, i) * y[i];
      }
      return true;
    });
  }
}

template <int D>
std::optional<JointPower> JointChain<D>::solve(const std::vector<MovingEquations<double, D>>& equations,
                                               const std::vector<JointMotion<D>>& motion, double* force,
                                               const BeamPart& part) {
  first_->reduce(force, part.before);
  last_->reduce(force, part.behind);
  for (const SpanBetween<D>& span : *between_) span.reduce(force);
  assemble(equations, motion, force);
  bool rubs = false;
  for (std::size_t j = 0; j < stations_.size(); ++j) {
    rubs = rubs || joints_[j].law->friction;
    stations_[j].guided.reset();
    if (const auto& given = motion[j].x_acceleration) guide(j, *given);
  }
  for (std::size_t j = 0; j < stations_.size(); ++j) keep_rows(j);
  for (std::size_t j = 0; j < stations_.size(); ++j) hold(j);
  if (!factor()) return std::nullopt;
  substitute();
  const auto dissipation = rubs ? add_friction(motion) : std::optional(0.0);
  if (!dissipation) return std::nullopt;
  JointPower power{.dissipated = *dissipation};
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (!motion[j].x_acceleration) continue;
    const double rubs_off = share_[j] * normal_[j] * stretch_[j];
    power.guided += (guide_force(j) + rubs_off) * motion[j].x_rate;
  }
  for (std::size_t j = 0; j < stations_.size(); ++j) {
    const Station& station = stations_[j];
    const JointPlace& place = joints_[j].place;
    position<D>(force, place.node) = station.rhs.template head<D>();
    slope<D>(force, place.node) = station.rhs.template segment<D>(D);
    if (place.behind >= 0) {
      Eigen::Map<Vec<double, D>>(force + place.behind) = station.rhs.template segment<D>(station.behind);
    }
    force[place.mark] = station.rhs[station.mark];
    if (j + 1 == stations_.size() || !open_[j]) continue;
    const auto node = [](const Station& at, int s) {
      typename OpenNodes<D>::Node values;
      values << at.rhs.template head<D>().transpose(), at.rhs.template segment<D>(s).transpose();
      return values;
    };
    const Station& other = stations_[j + 1];
    open_[j]->substitute(node(station, station.behind), station.rhs[station.mark], node(other, D),
                         other.rhs[other.mark], force);
  }
  if (parts_->front().a < 0) first_side_->substitute(before(stations_.front()), force);
  if (parts_->back().b < 0) {
    const Station& station = stations_.back();
    typename Side::Column joint;
    for (int i = 0; i < side; ++i) joint[i] = station.rhs[station.behind_at(i)];
    last_side_->substitute(joint, force);
  }
  for (const SpanBetween<D>& span : *between_) span.substitute(force);
  first_->substitute(force, part.before);
  last_->substitute(force, part.behind);
  return power;
}

template class JointChain<2>;
template class JointChain<3>;

}  // namespace vlbeam
