#include "core/scene/shape.hpp"

#include <stdexcept>

#include "core/element/moving_kinematics.hpp"
#include "core/element/rest_curve.hpp"
#include "core/scene/build.hpp"
#include "core/scene/build_flow.hpp"
#include "core/scene/run_support.hpp"
#include "core/system/strain_extremes.hpp"

namespace vlbeam {
namespace {

template <int D>
Vec<double, D> vector_of(const Point& point) {
  return Eigen::Map<const Vec<double, D>>(point.data());
}

void check(const Configuration& shape, int per_element) {
  const std::size_t nodes = shape.x.size();
  const bool whole = nodes >= 2 && shape.r.size() == nodes && shape.r_x.size() == nodes &&
                     shape.weights.size() + 1 == nodes && shape.rates.x.size() == nodes &&
                     shape.rates.v.size() == nodes && shape.rates.r_x.size() == nodes &&
                     (!shape.kink || shape.kink->node < nodes);
  if (!whole) throw std::invalid_argument("a configuration has one entry a node, and one of weights an element");
  if (per_element < 1) throw std::invalid_argument("an element has at least one interval of points");
}

template <int D>
std::vector<ShapePoint> points_in(const Scene& scene, const Configuration& shape, int per_element) {
  const BeamSection section = build_section(scene.beam);
  std::shared_ptr<const RestCurve<D>> rest;
  if (!flows(scene) && has_rest_shape(scene)) rest = build_model<D>(scene).rest;

  // A node travels along the beam: it moves with v + r_x x_rate.
  const auto position_rate = [&shape](std::size_t node) -> Vec<double, D> {
    return vector_of<D>(shape.rates.v[node]) + shape.rates.x[node] * vector_of<D>(shape.r_x[node]);
  };
  std::vector<ShapePoint> points;
  for (std::size_t k = 0; k + 1 < shape.x.size(); ++k) {
    const bool behind_kink = shape.kink && shape.kink->node == k;
    const Point& slope = behind_kink ? shape.kink->r_x : shape.r_x[k];
    const Point& slope_rate = behind_kink ? shape.kink->r_x_rate : shape.rates.r_x[k];
    const MovingCoordinates<double, D> q{
        {vector_of<D>(shape.r[k]), vector_of<D>(slope), vector_of<D>(shape.r[k + 1]), vector_of<D>(shape.r_x[k + 1])},
        shape.x[k],
        shape.x[k + 1]};
    const MovingCoordinates<double, D> rate{
        {position_rate(k), vector_of<D>(slope_rate), position_rate(k + 1), vector_of<D>(shape.rates.r_x[k + 1])},
        shape.rates.x[k],
        shape.rates.x[k + 1]};
    const WeightFunction weights{shape.weights[k], q.x_a, q.x_b};
    const MovingKinematics<double, D> kinematics(q, rate, scene.weights, weights);
    for (int i = 0; i <= per_element; ++i) {
      const double u = static_cast<double>(i) / per_element;
      const auto at = kinematics.at(u, rational_shape(kinematics.weights(), u));
      ShapePoint point{.element = k, .x = q.x_a + u * (q.x_b - q.x_a)};
      point.r = point_of<D>(at.r);
      point.r_x = point_of<D>(at.r_x);
      point.v = point_of<D>(at.v);
      StrainExtremes strains;
      if (rest != nullptr) {
        const int piece = rest->piece_at(i == per_element ? (q.x_a + q.x_b) / 2 : point.x);
        const auto from = rest->at(point.x, piece);
        strains.add(section, at, &from);
      } else {
        strains.add(section, at, nullptr);
      }
      point.strain = strains.strain.largest;
      point.tension = strains.force.largest;
      point.curvature = strains.curvature;
      points.push_back(point);
    }
  }
  return points;
}

}  // namespace

std::vector<ShapePoint> points_along(const Scene& scene, const Configuration& shape, int per_element) {
  check(shape, per_element);
  return scene.dimension == 2 ? points_in<2>(scene, shape, per_element) : points_in<3>(scene, shape, per_element);
}

}  // namespace vlbeam
