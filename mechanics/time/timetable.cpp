#include "mechanics/time/timetable.hpp"

#include <algorithm>
#include <cmath>

namespace vlbeam {
namespace {

constexpr double same_time = 1e-12;  // relative: corners that rounding tells apart, or a corner and where a step ended
constexpr double just_before = 1e-15;     // relative: where a step ends whose equations are not yet those of a corner
constexpr double slightly_beyond = 1e-9;  // share of a step that it is longer by, to end at a corner

}  // namespace

Timetable::Timetable(const std::vector<Stretch>& stretches) {
  std::vector<double> corners{0};
  for (const auto& [from, to, longest] : stretches) {
    for (const double corner : {from, to}) {
      if (corner > 0 && std::isfinite(corner)) corners.push_back(corner);
    }
  }
  std::ranges::sort(corners);
  for (const double corner : corners) {
    if (pieces_.empty() || corner > pieces_.back().from * (1 + same_time)) pieces_.push_back({corner, never});
  }
  const auto piece_at = [this](double t) {
    return std::ranges::lower_bound(pieces_, t * (1 - 2 * same_time), {}, &Piece::from);
  };
  bool limits = pieces_.size() > 1;
  for (const auto& [from, to, longest] : stretches) {
    if (!(longest < never)) continue;
    limits = true;
    const auto last = piece_at(to);
    for (auto piece = piece_at(std::max(from, 0.0)); piece != last; ++piece) {
      piece->longest = std::min(piece->longest, longest);
    }
  }
  if (!limits) pieces_.clear();
}

Timetable::Step Timetable::step(double t, double dt) const {
  if (pieces_.empty()) return {dt};
  const auto next = std::ranges::upper_bound(pieces_, t * (1 + same_time), {}, &Piece::from);
  const double longest = next == pieces_.begin() ? never : std::prev(next)->longest;
  const double length = std::min(dt, longest);
  if (next == pieces_.end()) return {length, {}, longest};
  const double left = next->from - t;
  if (left <= length * (1 + slightly_beyond)) return {next->from * (1 - just_before) - t, next->from, longest};
  // two of half the length rather than one of next to none
  if (left < 2 * length * (1 - slightly_beyond)) return {left / 2, {}, longest};
  return {length, {}, longest};
}

}  // namespace vlbeam
