#include "scene/shape.hpp"

#include <stdexcept>

#include "scene/assembly.hpp"
#include "scene/run_support.hpp"
#include "scene/section_forces.hpp"

namespace vlbeam {
namespace {

template <int D>
std::vector<ShapePoint> points_in(const Scene& scene, const Configuration& shape, int per_element) {
  const SectionForces<D> sections(scene, shape);
  const ShapeElements<D>& elements = sections.elements();
  std::vector<ShapePoint> points;
  for (std::size_t k = 0; k < elements.count(); ++k) {
    const auto element = elements.element(k);
    for (int i = 0; i <= per_element; ++i) {
      const double u = static_cast<double>(i) / per_element;
      const auto at = element.at(u);
      ShapePoint point;
      point.element = k;
      point.x = element.x(u);
      point.r = point_of<D>(at.r);
      point.r_x = point_of<D>(at.r_x);
      point.v = point_of<D>(at.v);
      const StrainExtremes here = elements.strains(element, u, at);
      point.curvature = here.curvature;
      const auto axial = elements.axial(element, u, here);
      point.strain = axial.strain;
      point.force = sections.at(k, u);
      // what swings inside the elements of a beam that bends is theirs
      point.tension = elements.section().bends() ? point.force.axial : axial.tension;
      points.push_back(point);
    }
  }
  return points;
}

}  // namespace

std::vector<ShapePoint> points_along(const Scene& scene, const Configuration& shape, int per_element) {
  if (per_element < 1) throw std::invalid_argument("an element has at least one interval of points");
  if (scene.assembly && !shape.beam.empty()) return points_along(scene_of_beam(scene, shape.beam), shape, per_element);
  return scene.dimension == 2 ? points_in<2>(scene, shape, per_element) : points_in<3>(scene, shape, per_element);
}

}  // namespace vlbeam
