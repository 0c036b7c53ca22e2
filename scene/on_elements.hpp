#pragma once

#include "scene/scene.hpp"

namespace vlbeam {

/// The scene with so many elements: what stands at a node keeps its place. Of several beams all have elements in
/// proportion. Throws InvalidInput where there is no node.
Scene on_elements(const Scene& scene, int elements);

/// The number of a node of `from` elements among those of `to`; `field` names it where it has none.
int renumbered(int node, int from, int to, const std::string& field);

}  // namespace vlbeam
