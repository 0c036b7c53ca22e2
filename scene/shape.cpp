#include "scene/shape.hpp"

#include <algorithm>
#include <array>

#include <stdexcept>

#include "core/element/moving_kinematics.hpp"
#include "core/element/rest_strain.hpp"
#include "core/element/strain_extremes.hpp"
#include "scene/build.hpp"
#include "scene/build_flow.hpp"
#include "scene/run_support.hpp"

namespace vlbeam {
namespace {

void check(const Configuration& shape, int per_element) {
  const std::size_t nodes = shape.x.size();
  const bool whole =
      nodes >= 2 && shape.r.size() == nodes && shape.r_x.size() == nodes && shape.weights.size() + 1 == nodes &&
      shape.rates.x.size() == nodes && shape.rates.v.size() == nodes && shape.rates.r_x.size() == nodes &&
      shape.rest.r.size() == shape.rest.r_x.size() && (shape.rest.r.empty() || shape.rest.r.size() == nodes) &&
      std::all_of(shape.kinks.begin(), shape.kinks.end(), [&](const auto& kink) { return kink.node < nodes; });
  if (!whole) throw std::invalid_argument("a configuration has one entry a node, and one of weights an element");
  if (per_element < 1) throw std::invalid_argument("an element has at least one interval of points");
}

template <int D>
std::vector<ShapePoint> points_in(const Scene& scene, const Configuration& shape, int per_element) {
  const BeamSection section = build_section(scene);
  const bool curved = has_rest_shape(scene), sampled = axial_strain(scene) == AxialStrain::lobatto;
  Configuration::Rest rest = shape.rest;
  if (curved && rest.r.empty()) {  // nodes that stand where they were built
    const Axis<D> axis = build_axis<D>(scene);
    for (const double x : shape.x) {
      rest.r.push_back(point_of<D>(axis.position(x)));
      rest.r_x.push_back(point_of<D>(axis.tangent(x)));
    }
  }

  // A node travels along the beam: it moves with v + r_x x_rate.
  const auto position_rate = [&shape](std::size_t node) -> Vec<double, D> {
    return vector_of<D>(shape.rates.v[node]) + shape.rates.x[node] * vector_of<D>(shape.r_x[node]);
  };
  std::vector<ShapePoint> points;
  for (std::size_t k = 0; k + 1 < shape.x.size(); ++k) {
    const auto* const kink = shape.kink_at(k);
    const Point& slope = kink != nullptr ? kink->r_x : shape.r_x[k];
    const Point& slope_rate = kink != nullptr ? kink->r_x_rate : shape.rates.r_x[k];
    const MovingCoordinates<double, D> q{
        {vector_of<D>(shape.r[k]), vector_of<D>(slope), vector_of<D>(shape.r[k + 1]), vector_of<D>(shape.r_x[k + 1])},
        shape.x[k],
        shape.x[k + 1]};
    const MovingCoordinates<double, D> rate{
        {position_rate(k), vector_of<D>(slope_rate), position_rate(k + 1), vector_of<D>(shape.rates.r_x[k + 1])},
        shape.rates.x[k],
        shape.rates.x[k + 1]};
    const WeightFunction weights{shape.weights[k], q.x_a, q.x_b};
    const MovingKinematics<double, D> kinematics(q, rate, weight_transport(scene), weights);
    const auto strains_at = [&](double u) {
      const auto at = kinematics.at(u, rational_shape(kinematics.weights(), u));
      StrainExtremes strains;
      if (curved) {
        const NodalCubic<double, D> e{vector_of<D>(rest.r[k]), vector_of<D>(rest.r_x[k]), vector_of<D>(rest.r[k + 1]),
                                      vector_of<D>(rest.r_x[k + 1])};
        const auto from = rest_strain<D>(combine_nodes(at.s_x, e), combine_nodes(at.s_xx, e), section);
        strains.add(section, at, &from);
      } else {
        strains.add(section, at, nullptr);
      }
      return strains;
    };
    std::array<StrainExtremes, 3> samples;
    if (sampled) samples = {strains_at(0), strains_at(0.5), strains_at(1)};
    for (int i = 0; i <= per_element; ++i) {
      const double u = static_cast<double>(i) / per_element;
      const auto at = kinematics.at(u, rational_shape(kinematics.weights(), u));
      ShapePoint point{.element = k, .x = q.x_a + u * (q.x_b - q.x_a)};
      point.r = point_of<D>(at.r);
      point.r_x = point_of<D>(at.r_x);
      point.v = point_of<D>(at.v);
      const StrainExtremes here = strains_at(u);
      point.curvature = here.curvature;
      point.strain = here.strain.largest;
      point.tension = here.force.largest;
      if (sampled) {  // the parabola through the points of the axial strain
        const std::array<double, 3> share{(1 - u) * (1 - 2 * u), 4 * u * (1 - u), u * (2 * u - 1)};
        point.strain = point.tension = 0;
        for (std::size_t n = 0; n < 3; ++n) {
          point.strain += share[n] * samples[n].strain.largest;
          point.tension += share[n] * samples[n].force.largest;
        }
      }
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
