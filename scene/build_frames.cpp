#include "scene/build_frames.hpp"

#include <utility>

#include "mechanics/frames/frame_element.hpp"
#include "mechanics/frames/frame_sections.hpp"
#include "mechanics/rooms.hpp"
#include "scene/build.hpp"

namespace vlbeam {

double twist_rate_at(const ChainState<3>& chain, int node) {
  double sum = 0;
  int sides = 0;
  for (const int k : {node - 1, node}) {
    if (k < 0 || k == chain.mesh.elements()) continue;
    const auto i = static_cast<std::size_t>(k);
    const double l = chain.mesh.x[i + 1] - chain.mesh.x[i];
    const auto e = element_nodes<3>(chain.q.data(), k);
    if constexpr (has_room("frames")) {
      const auto& sections = sections_of(chain).now;
      const FrameTable table(l, chain.mesh.weights[i].w);
      const FrameEnds<double> ends{e.r_b - e.r_a,    e.s_a, e.s_b, sections[i].direction, sections[i + 1].direction,
                                   sections[i].ahead};
      sum += FrameElement<double>(table, {}, ends).twist() / l;
    }
    ++sides;
  }
  return sum / sides;
}

double turning_along(const ChainState<3>& chain, const Axis<3>& rest, int node) {
  const double twist = twist_rate_at(chain, node);
  if (!chain.curved_at_rest()) return twist;
  ChainState<3> at_rest = chain;
  at_rest.q = chain.rest;
  own_sections(at_rest).now = sections_of(chain).at_rest;
  const double x = chain.mesh.x[static_cast<std::size_t>(node)];
  const double turning = sections_of(chain).rest_triads->turning(x, rest.derivatives(x))[0];
  return twist + turning - twist_rate_at(at_rest, node);
}

namespace {

std::shared_ptr<const RestTriads> rest_triads(const Scene& scene, const ChainState<3>& chain,
                                              const std::vector<SectionState>& sections) {
  std::vector<TriadReference> at;
  for (int k = 0; k <= chain.mesh.last(); ++k) {
    at.push_back({slope<3>(chain.rest.empty() ? chain.q.data() : chain.rest.data(), k).normalized(),
                  sections[static_cast<std::size_t>(k)].direction});
  }
  return std::make_shared<const RestTriads>(vector_of<3>(scene.beam.section.orientation), chain.mesh.x, std::move(at));
}

std::vector<SectionState> sections_along(const Scene& scene, const ChainState<3>& chain) {
  const Vec<double, 3> given = vector_of<3>(scene.beam.section.orientation);
  std::vector<SectionState> sections;
  for (int k = 0; k <= chain.mesh.last(); ++k) {
    const Vec<double, 3> t = slope<3>(chain.q.data(), k).normalized();
    if (given != Vec<double, 3>::Zero()) {
      sections.push_back({(given - t * t.dot(given)).normalized()});
    } else if (k == 0) {
      sections.push_back({t.unitOrthogonal()});
    } else {
      const Vec<double, 3> before = slope<3>(chain.q.data(), k - 1).normalized();
      sections.push_back({carried<double>(before, t, sections.back().direction)});
    }
  }
  return sections;
}

}  // namespace

void add_frames(const Scene& scene, ChainState<3>& chain) {
  const auto sections = std::make_shared<FrameSections>();
  sections->now = sections->at_rest = sections_along(scene, chain);
  sections->rest_triads = rest_triads(scene, chain, sections->at_rest);
  chain.kept = sections;
}

}  // namespace vlbeam
