#include "scene/on_elements.hpp"

#include <string>

#include "core/error.hpp"

namespace vlbeam {

int renumbered(int node, int from, int to, const std::string& field) {
  const long scaled = static_cast<long>(node) * to;
  if (scaled % from != 0) {
    throw InvalidInput(field, std::to_string(node), "it must be a node of " + std::to_string(to) + " elements, too");
  }
  return static_cast<int>(scaled / from);
}

Scene on_elements(const Scene& scene, int elements) {
  Scene changed = scene;
  const int from = scene.beam.elements;
  changed.beam.elements = elements;
  if (changed.flow) {
    for (auto& guide : changed.flow->nodes) guide.node = renumbered(guide.node, from, elements, "/flow/nodes");
  }
  if (changed.spin) {
    for (auto& drive : changed.spin->drives) drive.node = renumbered(drive.node, from, elements, "/spin/drives");
  }
  for (LoadSpec& load : changed.loads) {
    if (load.at == LoadPlace::node) load.node = renumbered(load.node, from, elements, "/loads");
  }
  for (PointMassSpec& mass : changed.point_masses) {
    if (!mass.position) mass.node = renumbered(mass.node, from, elements, "/point_masses");
  }
  return changed;
}

}  // namespace vlbeam
