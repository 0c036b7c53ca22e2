#include "tools/measures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/geometry/elementary.hpp"
#include "core/geometry/rational_cubic.hpp"
#include "io/json.hpp"

namespace vlbeam {
namespace {

Vec<double, 2> planar(const Point& p) { return {p[0], p[1]}; }

}  // namespace

double distance(const Point& a, const Point& b) { return portable::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

const Sample* sample_at(const RunResult& result, double t) {
  for (const Sample& sample : result.samples) {
    if (std::abs(sample.t - t) < 1e-9) return &sample;
  }
  return nullptr;
}

double position_error(const Sample& a, const Sample& b) {
  if (!a.mass_position || !b.mass_position || !a.joint_position || !b.joint_position) return nan;
  return std::max({std::abs(*a.joint_position - *b.joint_position), distance(a.end, b.end),
                   distance(*a.mass_position, *b.mass_position)}) /
         beam_length_m;
}

double position_error(const RunResult& run, const RunResult& reference, double t) {
  const Sample* a = sample_at(run, t);
  const Sample* b = sample_at(reference, t);
  return a && b ? position_error(*a, *b) : nan;
}

std::vector<const Event*> merges_until(const RunResult& result, double t) {
  std::vector<const Event*> merges;
  for (const Event& event : result.events) {
    if (event.type == EventType::segment_merge && event.t <= t) merges.push_back(&event);
  }
  return merges;
}

double separation_time(const RunResult& result) {
  for (const Event& event : result.events) {
    if (event.type == EventType::separation) return event.t;
  }
  return nan;
}

double furthest_joint_position(const RunResult& result, double t) {
  double furthest = 0;
  for (const Sample& sample : result.samples) {
    if (sample.t <= t + 1e-9) furthest = std::max(furthest, sample.joint_position.value_or(0));
  }
  return furthest;
}

WeightSet weight_set(const RunResult& result, double t) {
  WeightSet set;
  set.size = 3;
  double squares = 0;
  for (const Event* event : merges_until(result, t)) {
    set.size += 3;
    set.fallbacks += event->unit_fallback ? 1 : 0;
    for (const double k : event->weights) {
      set.maximum = std::max(set.maximum, k);
      set.minimum = std::min(set.minimum, k);
      squares += (k - 1) * (k - 1);
    }
  }
  set.sigma = std::sqrt(squares / static_cast<double>(set.size));
  return set;
}

double energy_without_jumps(const RunResult& result, const Sample& sample) {
  double energy = sample.energy.total();
  for (const Event& event : result.events) {
    if (event.t <= sample.t) energy -= event.energy_jump.total();
  }
  return energy;
}

double ledger_gap(const RunResult& result, double t) {
  const double start = result.samples.front().energy.total();
  double gap = 0;
  for (const Sample& sample : result.samples) {
    if (sample.t > t + 1e-9) break;
    gap = std::max(gap, std::abs(energy_without_jumps(result, sample) - start));
  }
  return gap / result.max_kinetic;
}

EventEnergy event_energy(const RunResult& result) {
  EventEnergy found;
  for (const Event& event : result.events) {
    if (event.type != EventType::segment_merge) continue;
    const double jump = std::abs(event.energy_jump.total());
    found.largest = std::max(found.largest, jump);
    found.sum += jump;
  }
  return found;
}

double energy_change(const RunResult& result) {
  double largest = 0;
  for (const Sample& sample : result.samples) {
    const double change = sample.energy.total() - sample.energy.supplied - result.samples.front().energy.total();
    largest = std::max(largest, std::abs(change));
  }
  return largest / result.max_kinetic;
}

std::array<double, 2> point_at(const Configuration& shape, double x) {
  const auto next = std::upper_bound(shape.x.begin() + 1, shape.x.end() - 1, x);
  const auto k = static_cast<std::size_t>(next - shape.x.begin()) - 1;
  const double l = shape.x[k + 1] - shape.x[k];
  const auto* const kink = shape.kink_at(k);
  const Point& r_x = kink != nullptr ? kink->r_x : shape.r_x[k];
  const NodalCubic<double, 2> e{planar(shape.r[k]), planar(r_x), planar(shape.r[k + 1]), planar(shape.r_x[k + 1])};
  const auto curve = RationalCubic<double, 2>::from_nodal(e, l, shape.weights[k]);
  const auto r = curve.evaluate((x - shape.x[k]) / l)[0];
  return {r[0], r[1]};
}

Stretch changed_by(const Event& event) {
  const auto& x = event.before.x;
  const auto at = std::ranges::lower_bound(x, event.joint_position - 1e-9);
  const auto j = at - x.begin();
  const auto last = static_cast<std::ptrdiff_t>(x.size()) - 1;
  const auto node = [&](std::ptrdiff_t k) {
    return x[static_cast<std::size_t>(std::clamp(k, std::ptrdiff_t{0}, last))];
  };
  // Forward: the element behind the joint is cut, the two ahead are merged. Backward: the other way round.
  const bool forward = node(j) - node(j - 1) > node(j + 1) - node(j);
  return forward ? Stretch{node(j - 1), node(j), node(j + 2), true} : Stretch{node(j - 2), node(j), node(j + 1), false};
}

Displacement displacement_by(const Event& event) {
  constexpr int points = 100;
  const Stretch stretch = changed_by(event);
  Displacement largest;
  for (int i = 0; i <= points; ++i) {
    const double x = stretch.begin + (stretch.end - stretch.begin) * i / points;
    const auto a = point_at(event.before, x), b = point_at(event.after, x);
    double& side = (x <= stretch.cut) == stretch.forward ? largest.segmented : largest.merged;
    side = std::max(side, portable::hypot(a[0] - b[0], a[1] - b[1]));
  }
  return largest;
}

}  // namespace vlbeam
