#include "scene/shape_elements.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/element/rest_strain.hpp"
#include "scene/build.hpp"
#include "scene/build_flow.hpp"
#include "scene/derived.hpp"
#include "scene/run_support.hpp"
#include "scene/sections.hpp"

namespace vlbeam {
namespace {

constexpr double at_end = 1e-9;  // of an element: where its section is its own, and not its neighbour's

void check(const Configuration& shape) {
  const std::size_t nodes = shape.x.size();
  const bool whole =
      nodes >= 2 && shape.r.size() == nodes && shape.r_x.size() == nodes && shape.weights.size() + 1 == nodes &&
      shape.rates.x.size() == nodes && shape.rates.v.size() == nodes && shape.rates.r_x.size() == nodes &&
      shape.rest.r.size() == shape.rest.r_x.size() && (shape.rest.r.empty() || shape.rest.r.size() == nodes) &&
      std::all_of(shape.kinks.begin(), shape.kinks.end(), [&](const auto& kink) { return kink.node < nodes; });
  if (!whole) throw std::invalid_argument("a configuration has one entry a node, and one of weights an element");
}

}  // namespace

template <int D>
ShapeElements<D>::ShapeElements(const Scene& scene, const Configuration& shape)
    : shape_(shape),
      section_(build_section(scene)),
      pieces_(build_pieces(scene)),
      transport_(weight_transport(scene)),
      curved_(has_rest_shape(scene)),
      sampled_(axial_strain(scene) == AxialStrain::lobatto),
      rest_(shape.rest) {
  check(shape);
  if (!curved_ || !rest_.r.empty()) return;  // else nodes stand where they were built
  const Axis<D> axis = build_axis<D>(scene);
  for (const double x : shape.x) {
    rest_.r.push_back(point_of<D>(axis.position(x)));
    rest_.r_x.push_back(point_of<D>(axis.tangent(x)));
  }
}

template <int D>
typename ShapeElements<D>::Point ShapeElements<D>::Element::bent(double u) const {
  const auto f = rational_shape(kinematics.weights(), u);
  const double l = kinematics.length(), per_length = 1 / l;
  Point point;
  for (std::size_t i = 0; i < 4; ++i) {
    const double unit = i % 2 == 0 ? 1 : l;
    point.s_x[i] = unit * per_length * f[i][1];
    point.s_xx[i] = unit * per_length * per_length * f[i][2];
  }
  const NodalCubic<double, D>& e = kinematics.coordinates().e;
  point.r_x = combine_nodes(point.s_x, e);
  point.r_xx = combine_nodes(point.s_xx, e);
  point.v_x.setZero();
  point.v_xx.setZero();
  return point;
}

template <int D>
typename ShapeElements<D>::Element ShapeElements<D>::element(std::size_t k) const {
  // A node travels along the beam: it moves with v + r_x x_rate.
  const auto position_rate = [this](std::size_t node) -> Vec<double, D> {
    return vector_of<D>(shape_.rates.v[node]) + shape_.rates.x[node] * vector_of<D>(shape_.r_x[node]);
  };
  const auto* const kink = shape_.kink_at(k);
  const vlbeam::Point& slope = kink != nullptr ? kink->r_x : shape_.r_x[k];
  const vlbeam::Point& slope_rate = kink != nullptr ? kink->r_x_rate : shape_.rates.r_x[k];
  const MovingCoordinates<double, D> q{
      {vector_of<D>(shape_.r[k]), vector_of<D>(slope), vector_of<D>(shape_.r[k + 1]), vector_of<D>(shape_.r_x[k + 1])},
      shape_.x[k],
      shape_.x[k + 1]};
  const MovingCoordinates<double, D> rate{
      {position_rate(k), vector_of<D>(slope_rate), position_rate(k + 1), vector_of<D>(shape_.rates.r_x[k + 1])},
      shape_.rates.x[k],
      shape_.rates.x[k + 1]};
  Element result{k, {q, rate, transport_, WeightFunction{shape_.weights[k], q.x_a, q.x_b}}, {}, {}};
  if (curved_) {
    result.rest = NodalCubic<double, D>{vector_of<D>(rest_.r[k]), vector_of<D>(rest_.r_x[k]),
                                        vector_of<D>(rest_.r[k + 1]), vector_of<D>(rest_.r_x[k + 1])};
  }
  if (sampled_) {
    for (std::size_t n = 0; n < 3; ++n) {
      const double u = 0.5 * static_cast<double>(n);
      result.sampled[n] = strains(result, u, section_.damping > 0 ? result.at(u) : result.bent(u));
    }
  }
  return result;
}

template <int D>
StrainExtremes ShapeElements<D>::strains(const Element& element, double u, const Point& at) const {
  StrainExtremes strains;
  const double x_a = element.x(0), x_b = element.x(1), inside = std::clamp(u, at_end, 1 - at_end);
  const BeamSection section = section_at(x_a + inside * (x_b - x_a));
  if (element.rest) {
    const auto from =
        rest_strain<D>(combine_nodes(at.s_x, *element.rest), combine_nodes(at.s_xx, *element.rest), section);
    strains.add(section, at, &from);
  } else {
    strains.add(section, at, nullptr);
  }
  return strains;
}

template <int D>
typename ShapeElements<D>::Axial ShapeElements<D>::axial(const Element& element, double u,
                                                         const StrainExtremes& there) const {
  if (!sampled_) return {there.strain.largest, there.force.largest};
  const std::array<double, 3> share{(1 - u) * (1 - 2 * u), 4 * u * (1 - u), u * (2 * u - 1)};
  Axial sum{0, 0};
  for (std::size_t n = 0; n < 3; ++n) {
    sum.strain += share[n] * element.sampled[n].strain.largest;
    sum.tension += share[n] * element.sampled[n].force.largest;
  }
  return sum;
}

template class ShapeElements<2>;
template class ShapeElements<3>;

}  // namespace vlbeam
