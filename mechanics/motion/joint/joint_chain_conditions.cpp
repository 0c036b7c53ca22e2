// What holds, guides and rubs at the joints of a chain.
#include <cmath>

#include "mechanics/motion/joint/joint_chain.hpp"

namespace vlbeam {
namespace {

constexpr double settled = 1e-15;  // change of normal forces, over the largest
constexpr int most_rounds = 200;

}  // namespace

template <int D>
void JointChain<D>::hold(std::size_t which) {
  Station& station = stations_[which];
  if (station.held == nullptr) return;
  Eigen::Matrix<double, 2 * D, 2 * D> keep = Eigen::Matrix<double, 2 * D, 2 * D>::Zero();
  const auto share = [&](const typename Support<D>::Components& free) -> Eigen::Matrix<double, D, D> {
    return station.held->frame * free.matrix().asDiagonal() * station.held->frame.transpose();
  };
  keep.template topLeftCorner<D, D>() = share(station.held->free_position);
  keep.template bottomRightCorner<D, D>() = share(station.held->free_slope);
  auto own = station.mass.template topLeftCorner<2 * D, 2 * D>();
  const Eigen::Matrix<double, 2 * D, 2 * D> whole = own.template selfadjointView<Eigen::Upper>();
  own = keep * whole * keep;
  // what is held has a mass of the size of what is free: the unit of mass must not matter
  for (const int at : {0, D}) {
    const double size = whole.template block<D, D>(at, at).trace();
    own.template block<D, D>(at, at) +=
        size * (Eigen::Matrix<double, D, D>::Identity() - keep.template block<D, D>(at, at));
  }
  const auto keep_rows_of = [&](auto rows) { rows = (keep * rows).eval(); };
  keep_rows_of(station.mass.template topRightCorner<2 * D, most - 2 * D>());
  keep_rows_of(station.next.template topRows<2 * D>());
  keep_rows_of(station.rhs.template head<2 * D>());
  if (which == 0) return;
  auto previous = stations_[which - 1].next.template leftCols<2 * D>();
  previous = (previous * keep).eval();
}

template <int D>
void JointChain<D>::guide(std::size_t which, double acceleration) {
  Station& station = stations_[which];
  const int x = station.mark;
  typename Station::Guided& row = station.guided.emplace();
  row.own = station.mass.row(x);
  row.own.head(x) = station.mass.col(x).head(x);
  row.force = station.rhs[x];
  station.rhs -= acceleration * row.own;
  station.rhs[x] = acceleration;
  station.mass.row(x).setZero();
  station.mass.col(x).setZero();
  station.mass(x, x) = 1;
  if (which + 1 < stations_.size()) {
    Station& following = stations_[which + 1];
    row.next = station.next.row(x);
    following.rhs.template head<2 * D>() -= acceleration * row.next.template head<2 * D>();
    following.rhs[following.mark] -= acceleration * row.next[2 * D];
    station.next.row(x).setZero();
  }
  if (which > 0) {
    Station& previous = stations_[which - 1];
    row.previous = previous.next.col(2 * D);
    previous.rhs -= acceleration * row.previous;
    previous.next.col(2 * D).setZero();
  }
}

template <int D>
double JointChain<D>::guide_force(std::size_t which) const {
  const typename Station::Guided& row = *stations_[which].guided;
  double force = row.own.dot(stations_[which].rhs) - row.force;
  if (which + 1 < stations_.size()) force += row.next.dot(before(stations_[which + 1]));
  if (which > 0) force += row.previous.dot(stations_[which - 1].rhs);
  return force;
}

template <int D>
void JointChain<D>::keep_rows(std::size_t which) {
  Station& station = stations_[which];
  station.held_rows.reset();
  if (station.held == nullptr || !joints_[which].law->friction) return;
  auto& rows = station.held_rows.emplace();
  rows.own = station.mass.template topRows<D>();
  rows.own.template leftCols<D>() =
      station.mass.template topLeftCorner<D, D>().template selfadjointView<Eigen::Upper>();
  if (which > 0) rows.previous = stations_[which - 1].next.template leftCols<D>().transpose();
  rows.next = station.next.template topRows<D>();
  rows.force = station.rhs.template head<D>();
}

template <int D>
Vec<double, D> JointChain<D>::lacking(std::size_t which, bool with_forces) const {
  const auto& rows = stations_[which].held_rows;
  if (!rows) return Vec<double, D>::Zero();
  Vec<double, D> sum = -rows->own * stations_[which].rhs;
  if (with_forces) sum += rows->force;
  if (which > 0) sum -= rows->previous * stations_[which - 1].rhs;
  if (which + 1 < stations_.size()) sum -= rows->next * before(stations_[which + 1]);
  return sum;
}

/// The normal force at one joint depends on the friction at the others, but little: by rounds over them all.
template <int D>
std::optional<double> JointChain<D>::add_friction(const std::vector<JointMotion<D>>& motion) {
  for (Station& station : stations_) station.answer = station.rhs;
  const auto count = joints_.size();
  const auto contact_at = [&](std::size_t j) { return motion[j].contact(*joints_[j].law); };
  for (std::size_t j = 0; j < count; ++j) {  // by the beam on the joint
    pull_[j] = joints_[j].law->mass * (stations_[j].rhs.template head<D>() - motion[j].gravity) + lacking(j, true);
  }
  const auto push = [&](std::size_t j, double force) {
    Station& station = stations_[j];
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
          contact_at(i).pressing(joints_[i].law->mass * stations_[i].rhs.template head<D>() + lacking(i, false));
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

template void JointChain<2>::hold(std::size_t);
template void JointChain<2>::guide(std::size_t, double);
template double JointChain<2>::guide_force(std::size_t) const;
template void JointChain<2>::keep_rows(std::size_t);
template Vec<double, 2> JointChain<2>::lacking(std::size_t, bool) const;
template std::optional<double> JointChain<2>::add_friction(const std::vector<JointMotion<2>>&);
template void JointChain<3>::hold(std::size_t);
template void JointChain<3>::guide(std::size_t, double);
template double JointChain<3>::guide_force(std::size_t) const;
template void JointChain<3>::keep_rows(std::size_t);
template Vec<double, 3> JointChain<3>::lacking(std::size_t, bool) const;
template std::optional<double> JointChain<3>::add_friction(const std::vector<JointMotion<3>>&);

}  // namespace vlbeam
