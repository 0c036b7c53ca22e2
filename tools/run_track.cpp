#include "tools/run_track.hpp"

#include <algorithm>
#include <cmath>

#include "io/json.hpp"
#include "io/quantity.hpp"
#include "scene/assembly.hpp"
#include "scene/bearings.hpp"
#include "scene/build.hpp"
#include "scene/derived.hpp"
#include "scene/run_support.hpp"
#include "scene/shape.hpp"

namespace vlbeam {
namespace {

constexpr std::size_t most_probe_times = 60;
constexpr int probe_shares = 16;        // of the beam's length
constexpr int points_an_element = 4;    // between which the axis is a cubic
constexpr double samples_apart = 1e-9;  // of a time: samples of two runs that are the same instant

std::vector<double> components_of(const Point& point, int dimension) {
  return {point.begin(), point.begin() + dimension};
}
std::vector<double> one_number(const std::optional<double>& value) { return {value.value_or(nan)}; }

/// The axis between two of its points, by their slopes.
Point on_cubic(const ShapePoint& a, const ShapePoint& b, double x) {
  const double l = b.x - a.x, u = l > 0 ? (x - a.x) / l : 0, v = 1 - u;
  Point r{};
  for (std::size_t i = 0; i < r.size(); ++i) {
    r[i] = v * v * ((1 + 2 * u) * a.r[i] + u * l * a.r_x[i]) + u * u * ((1 + 2 * v) * b.r[i] - v * l * b.r_x[i]);
  }
  return r;
}

class Tracker {
 public:
  Tracker(const Scene& scene, const RunResult& result) : scene_(scene), result_(result) {}

  template <class Of>
  void row(const std::string& quantity, const std::string& unit, TrackKind kind, const Of& of) {
    Track::Row row{quantity, unit, kind, {}, {}};
    const auto add = [&](const Sample& sample, double t) {
      row.t.push_back(t);
      row.values.push_back(of(sample));
    };
    if (scene_.analysis == Analysis::dynamics) {
      for (const Sample& sample : result_.samples) add(sample, sample.t);
    } else if (!result_.samples.empty()) {  // the way to the last equilibrium is a matter of the search
      add(result_.samples.front(), 0);
      add(result_.samples.back(), 1);
    }
    track.rows.push_back(std::move(row));
  }

  Track track;

 private:
  const Scene& scene_;
  const RunResult& result_;
};

}  // namespace

std::vector<double> probe_times(const Scene& scene) {
  const std::vector<double> samples = Stops(scene).samples;
  const std::size_t count = std::min(samples.size(), most_probe_times);
  std::vector<double> times;
  for (std::size_t i = 0; i <= count; ++i) times.push_back(samples[i * (samples.size() - 1) / count]);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

std::vector<double> probes(const Scene& scene, const Configuration& shape) {
  const std::vector<ShapePoint> points = points_along(scene, shape, points_an_element);
  const double start = points.front().x, length = points.back().x - start;
  std::vector<double> places;
  std::size_t k = 0;
  for (int i = 0; i <= probe_shares; ++i) {
    const double x = start + length * i / probe_shares;
    while (k + 2 < points.size() && points[k + 1].x < x) ++k;
    const Point r = on_cubic(points[k], points[k + 1], x);
    places.insert(places.end(), r.begin(), r.begin() + scene.dimension);
  }
  return places;
}

namespace {

/// The same places on the axis as it is drawn.
std::vector<double> drawn_probes(const Scene& scene) {
  const Axis<3> axis = build_axis<3>(scene);
  std::vector<double> places;
  for (int i = 0; i <= probe_shares; ++i) {
    const Vec<double, 3> r = axis.position(axis.length() * i / probe_shares);
    places.insert(places.end(), r.data(), r.data() + scene.dimension);
  }
  return places;
}

}  // namespace

namespace {

/// Reactions, what is asked of places, and forces of links and supports, by their names.
void add_asked(const Scene& scene, Tracker& tracker) {
  for (const Quantity& quantity : quantities(scene)) {
    const auto says = [&quantity](const char* word) { return quantity.name.find(word) != std::string::npos; };
    if (!says("places.") && !says("reactions.") && !says("force.")) continue;
    const bool force = quantity.unit == "N" || quantity.unit == "N m" || quantity.unit == "Pa";
    tracker.row(quantity.name, quantity.unit, force ? TrackKind::force : TrackKind::other,
                [&quantity](const Sample& s) { return one_number(quantity.of(s)); });
  }
}

/// About the last equilibrium.
void add_frequencies(const RunResult& result, Track& track) {
  for (std::size_t k = 0; k < result.frequencies.size(); ++k) {
    track.rows.push_back({"frequencies." + std::to_string(k), "Hz", TrackKind::other, {1}, {{result.frequencies[k]}}});
  }
}

/// Of several beams and bodies.
Track track_of_assembly(const Scene& scene, const RunResult& result) {
  Tracker tracker(scene, result);
  const int d = scene.dimension;
  const auto& [beams, bodies, links, longest, elements] = *scene.assembly;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const std::string& name = beams[i].name;
    tracker.row(name + " end", "m", TrackKind::place,
                [d, i](const Sample& s) { return components_of(s.assembly->beams[i].end, d); });
    const std::size_t joints = sliding_joints(beams[i].scene).size();
    for (std::size_t k = 0; k < joints; ++k) {
      tracker.row(name + " joint " + std::to_string(k), "m", TrackKind::place, [i, k, joints](const Sample& s) {
        const Sample& beam = s.assembly->beams[i];
        return one_number(joints > 1 ? beam.joints[k].position : beam.joint_position);
      });
    }
    tracker.row(name + " largest axial force", "N", TrackKind::other,
                [i](const Sample& s) { return one_number(s.assembly->beams[i].strains.axial_force[1]); });
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    tracker.row(bodies[i].name, "m", TrackKind::place,
                [d, i](const Sample& s) { return components_of(s.assembly->bodies[i].position, d); });
  }
  tracker.row("energy", "J", TrackKind::other, [](const Sample& s) { return one_number(s.energy.total()); });
  tracker.row("kinetic energy", "J", TrackKind::other, [](const Sample& s) { return one_number(s.energy.kinetic); });
  add_asked(scene, tracker);
  add_frequencies(result, tracker.track);
  return std::move(tracker.track);
}

}  // namespace

Track track_of(const Scene& scene, const RunResult& result, const std::vector<double>& times,
               const std::vector<std::vector<double>>& shapes) {
  if (scene.assembly) return track_of_assembly(scene, result);
  Tracker tracker(scene, result);
  const int d = scene.dimension;
  const auto joints = sliding_joints(scene);
  tracker.row("end", "m", TrackKind::place, [d](const Sample& s) { return components_of(s.end, d); });
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const bool one = joints.size() == 1;
    const std::string name = std::to_string(i);
    tracker.row("joint " + name, "m", TrackKind::place, [one, i](const Sample& s) {
      return one_number(one ? s.joint_position : i < s.joints.size() ? s.joints[i].position : std::nullopt);
    });
    tracker.row("mass " + name, "m", TrackKind::place, [one, i, d](const Sample& s) {
      const auto& place = one ? s.mass_position : i < s.joints.size() ? s.joints[i].mass_position : std::nullopt;
      return place ? components_of(*place, d) : std::vector<double>(static_cast<std::size_t>(d), nan);
    });
  }
  for (const std::size_t end : {0U, 1U}) {
    if (!(end == 0 ? scene.start : scene.end).pays_out()) continue;
    tracker.row(end == 0 ? "winch start" : "winch end", "m", TrackKind::place, [end](const Sample& s) {
      return one_number(s.winches[end] ? std::optional(s.winches[end]->length) : std::nullopt);
    });
  }
  if (scene.spin) {
    tracker.row("angles", "rad", TrackKind::other, [](const Sample& s) {
      return s.flow && s.flow->end_angles ? std::vector<double>(s.flow->end_angles->begin(), s.flow->end_angles->end())
                                          : std::vector<double>(2, nan);
    });
  }
  tracker.row("energy", "J", TrackKind::other, [](const Sample& s) { return one_number(s.energy.total()); });
  tracker.row("kinetic energy", "J", TrackKind::other, [](const Sample& s) { return one_number(s.energy.kinetic); });
  tracker.row("largest axial force", "N", TrackKind::other,
              [](const Sample& s) { return one_number(s.strains.axial_force[1]); });
  tracker.row("largest curvature", "1/m", TrackKind::other,
              [](const Sample& s) { return one_number(s.strains.curvature); });
  for (std::size_t i = 0; i < scene.bearings.size(); ++i) {
    tracker.row("force of support " + bearing_name(scene, i), "N", TrackKind::other, [i, d](const Sample& s) {
      return s.sections ? components_of(s.sections->bearings[i].force, d)
                        : std::vector<double>(static_cast<std::size_t>(d), nan);
    });
  }
  add_asked(scene, tracker);
  Track track = std::move(tracker.track);
  add_frequencies(result, track);
  if (shapes.empty() || result.samples.empty()) return track;
  if (scene.analysis == Analysis::dynamics) {
    track.rows.push_back({"shape", "m", TrackKind::place, times, shapes});
  } else {
    track.rows.push_back({"shape", "m", TrackKind::place, {0, 1}, {drawn_probes(scene), shapes.back()}});
  }
  return track;
}

namespace {

double distance(const std::vector<double>& a, const std::vector<double>& b, std::size_t size) {
  double largest = 0;
  for (std::size_t first = 0; first < a.size(); first += size) {
    double sum = 0;
    for (std::size_t i = first; i < std::min(first + size, a.size()); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    if (std::isfinite(sum)) largest = std::max(largest, std::sqrt(sum));
  }
  return largest;
}

/// How many numbers make one point.
std::size_t point_size(const Track::Row& row) {
  const std::size_t size = row.values.empty() ? 1 : row.values.front().size();
  return row.quantity == "shape" ? size / (probe_shares + 1) : std::max<std::size_t>(size, 1);
}

std::vector<double> running(std::vector<double> values) {
  for (std::size_t i = 1; i < values.size(); ++i) values[i] = std::max(values[i], values[i - 1]);
  return values;
}

}  // namespace

std::vector<double> largest_distance(const Track::Row& a, const Track::Row& b) {
  std::vector<double> distances;
  const std::size_t size = point_size(a);
  for (std::size_t i = 0; i < std::min(a.t.size(), b.t.size()); ++i) {
    if (std::abs(a.t[i] - b.t[i]) > samples_apart * std::abs(a.t[i])) break;
    distances.push_back(distance(a.values[i], b.values[i], size));
  }
  return running(std::move(distances));
}

std::vector<double> largest_way(const Track::Row& row) {
  std::vector<double> ways;
  const std::size_t size = point_size(row);
  for (const auto& values : row.values) ways.push_back(distance(values, row.values.front(), size));
  return running(std::move(ways));
}

}  // namespace vlbeam
