#include "scene/corners.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "scene/build.hpp"
#include "scene/section_data.hpp"
#include "scene/sections.hpp"

namespace vlbeam {
namespace {

/// Whether joints that keep their place go with the rest of the scene.
bool may_have_knots(const Scene& scene) {
  if (flows(scene) || scene.spin || scene.setting != SceneSetting::standard) return false;
  if (scene.beam.element != ElementKind::ale_rancf && scene.beam.element != ElementKind::ale_ancf) return false;
  switch (scene.integrator.type) {
    case IntegratorType::rosenbrock4:
    case IntegratorType::energy_momentum:
    case IntegratorType::ida:
    case IntegratorType::cvode:
      if (scene.analysis == Analysis::dynamics) return false;
      break;
    default:
      break;
  }
  return scene.length_control.velocities != VelocityTransfer::conservative;
}

/// The break of an axis that stands at x, or x.
double snapped(const std::vector<double>& breaks, double x) {
  for (const double at : breaks) {
    if (std::abs(at - x) <= corner_rounding * breaks.back()) return at;
  }
  return x;
}

template <int D>
std::vector<Vec<double, D>> points_of(const std::vector<Point>& from) {
  std::vector<Vec<double, D>> points;
  for (const Point& point : from) points.push_back(vector_of<D>(point));
  return points;
}

template <int D>
Axis<D> draw(const CurveSpec& curve) {
  constexpr double degree = std::numbers::pi / 180;
  switch (curve.type) {
    case CurveType::arc:
      return Axis<D>::arc(vector_of<D>(curve.center), curve.radius, curve.from_degrees * degree,
                          curve.to_degrees * degree, curve.pitch);
    case CurveType::nurbs:
      return Axis<D>::nurbs(drawn_nurbs<D>(curve));
    case CurveType::polyline:
      return Axis<D>::polyline(points_of<D>(curve.points));
    case CurveType::line:
      break;
  }
  return Axis<D>::line(vector_of<D>(curve.start), vector_of<D>(curve.end));
}

}  // namespace

bool is_rope(const BeamSpec& beam) {
  return std::ranges::all_of(sections_of(beam), [](const Section* section) { return is_rope_section(*section); });
}

template <int D>
Nurbs<D> drawn_nurbs(const CurveSpec& curve) {
  Nurbs<D> nurbs{curve.degree, curve.knots, curve.weights, points_of<D>(curve.control_points)};
  if (nurbs.weights.empty()) nurbs.weights.assign(nurbs.points.size(), 1);
  return nurbs;
}

template <int D>
Axis<D> drawn_axis(const CurveSpec& curve) {
  // defaults, checks and builders of one scene ask for its axis some hundred times, and its length is an integral
  thread_local std::optional<std::pair<CurveSpec, Axis<D>>> last;
  if (!last || last->first != curve) last.emplace(curve, draw<D>(curve));
  return last->second;
}

bool may_have_corners(const CurveSpec& curve) {
  if (curve.type == CurveType::polyline) return true;
  if (curve.type != CurveType::nurbs || curve.degree < 1) return false;
  const auto degree = static_cast<std::size_t>(curve.degree);
  for (std::size_t i = degree + 1; i + degree < curve.knots.size(); ++i) {
    if (curve.knots[i] == curve.knots[i + 1 - degree]) return true;  // as many equal ones as the degree
  }
  return false;
}

std::vector<Knot> knots(const Scene& scene) {
  std::vector<Knot> result;
  const bool corners = may_have_corners(scene.beam.curve);
  const std::vector<double> changes = section_changes(scene.beam);
  if (scene.point_masses.empty() && scene.loads.empty() && !corners && changes.empty()) return result;
  if (!may_have_knots(scene)) return result;
  const bool rope = is_rope(scene.beam);
  const auto joints = sliding_joints(scene);
  const auto kinked = [](const SlidingJointSpec& joint) { return joint.slopes != JointSlopes::continuous; };
  if (rope ? !std::ranges::all_of(joints, kinked) : std::ranges::none_of(joints, kinked)) return result;
  const auto drawn = drawn_axis<3>(scene.beam.curve);
  const auto [x, taken, masses] = place_nodes(scene, drawn.breaks());
  const auto add = [&, &taken = taken](int node) {
    if (node <= 0 || node >= scene.beam.elements || std::ranges::find(taken, node) != taken.end()) return;
    const auto same = [node](const Knot& knot) { return knot.node == node; };
    if (std::ranges::none_of(result, same)) {
      result.push_back({node, rope ? JointSlopes::free : JointSlopes::continuous});
    }
  };
  for (const int node : masses) add(node);
  for (const LoadSpec& load : scene.loads) {
    if (rope && load.type == LoadType::force && load.at == LoadPlace::node) add(load.node);
  }
  if (rope) {
    for (const double at : changes) add(static_cast<int>(std::ranges::lower_bound(x, at) - x.begin()));
  }
  if (rope && joints.empty()) {
    for (const double at : drawn.kinks()) add(static_cast<int>(std::ranges::lower_bound(x, at) - x.begin()));
  }
  std::ranges::sort(result, {}, &Knot::node);
  return result;
}

std::vector<double> rounded_corners(const Scene& scene, const Axis<3>& drawn) {
  std::vector<double> round;
  if (drawn.kinks().empty() || !is_rope(scene.beam)) return round;
  const auto joints = sliding_joints(scene);
  const std::vector<double> nodes = place_nodes(scene, drawn.breaks()).x;
  const auto its_knots = knots(scene);
  for (const double at : drawn.kinks()) {
    const bool joint = std::ranges::any_of(joints, [&](const SlidingJointSpec& spec) {
      return snapped(drawn.breaks(), spec.position) == at && spec.slopes != JointSlopes::continuous;
    });
    const bool knot = std::ranges::any_of(
        its_knots, [&](const Knot& other) { return nodes[static_cast<std::size_t>(other.node)] == at; });
    if (!joint && !knot) round.push_back(at);
  }
  return round;
}

void place_at_corners(Scene& scene) {
  if (sliding_joint(scene) == nullptr) return;
  const auto each = [&scene](const auto& place) {
    if (scene.sliding_mass) place(*scene.sliding_mass, std::string("/sliding_mass"));
    for (std::size_t i = 0; i < scene.sliding_joints.size(); ++i) {
      place(static_cast<SlidingMassSpec&>(scene.sliding_joints[i]), "/sliding_joints/" + std::to_string(i));
    }
  };
  const CurveSpec& curve = scene.beam.curve;
  std::vector<double> kinks, corners;
  const bool drawable = curve.type != CurveType::polyline ||
                        (curve.points.size() > 2 && std::ranges::adjacent_find(curve.points) == curve.points.end());
  if (may_have_corners(curve) && drawable) {
    try {
      const auto drawn = drawn_axis<3>(curve);
      kinks = corners = drawn.kinks();
      if (curve.type == CurveType::polyline) corners.assign(drawn.breaks().begin() + 1, drawn.breaks().end() - 1);
    } catch (const NurbsError&) {
      return;  // such a curve is refused
    }
  }
  each([&](SlidingMassSpec& joint, const std::string& key) {
    if (!joint.at_corner) return;
    const int corner = joint.at_corner->corner;
    if (corner < 1 || corner > static_cast<int>(corners.size())) {
      throw InvalidInput(key + "/position/corner", std::to_string(corner),
                         corners.empty() ? "the beam's axis has no corner"
                                         : "the beam's axis has corners 1 to " + std::to_string(corners.size()));
    }
    joint.position = corners[static_cast<std::size_t>(corner) - 1];
    joint.at_corner.reset();
  });
  if (kinks.empty()) return;
  const double near = means_corner * standard_length(scene);
  each([&](SlidingMassSpec& joint, const std::string&) {
    for (const double at : kinks) {
      if (std::abs(joint.position - at) <= near) joint.position = at;
    }
  });
}

double position_on_axis(const CurveSpec& curve, const std::vector<double>& breaks, double position) {
  if (!may_have_corners(curve)) return position;
  const std::vector<double> drawn = drawn_axis<3>(curve).breaks();
  const double x = snapped(drawn, position);
  if (breaks == drawn) return x;
  const auto i = static_cast<std::size_t>(std::upper_bound(drawn.begin() + 1, drawn.end() - 1, x) - drawn.begin());
  if (x == drawn[i - 1]) return breaks[i - 1];
  return breaks[i - 1] + (x - drawn[i - 1]) * (breaks[i] - breaks[i - 1]) / (drawn[i] - drawn[i - 1]);
}

template Nurbs<3> drawn_nurbs(const CurveSpec&);
template Axis<2> drawn_axis(const CurveSpec&);
template Axis<3> drawn_axis(const CurveSpec&);

}  // namespace vlbeam
