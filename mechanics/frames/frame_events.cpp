#include "mechanics/frames/frame_events.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "mechanics/frames/frame_sections.hpp"

namespace vlbeam {
namespace {

/// The node of `before` that is node k of `after`; -1 for none.
int same_node(const ChainState<3>& before, const ChainState<3>& after, int k) {
  if (const auto* const joint = after.joint_at(k)) {
    const auto was = std::ranges::find(before.joints, joint->index, &ChainState<3>::Joint::index);
    return was == before.joints.end() ? -1 : was->node;
  }
  const double x = after.mesh.x[static_cast<std::size_t>(k)];
  for (auto at = std::ranges::lower_bound(before.mesh.x, x); at != before.mesh.x.end() && *at == x; ++at) {
    const int node = static_cast<int>(at - before.mesh.x.begin());
    if (before.joint_at(node) == nullptr) return node;
  }
  return -1;
}

}  // namespace

void FrameEvents::add_guards(const Eigen::VectorXd& y, double /*t*/, Guards& guards) const {
  guards.push_back({0, 0, frames_of(beam_)->turned_away(y.data())});
}

bool FrameEvents::settles(const Guard& /*guard*/, Eigen::VectorXd& y) {
  accelerations_.last_event().forget();  // angles count from elsewhere now
  frames_of(beam_)->follow(y.data(), y.data() + beam_.coordinates());
  return true;
}

std::vector<PendingEvent> FrameEvents::due(const Guard& /*first*/, const Eigen::VectorXd& /*y*/, double /*t*/) const {
  throw std::logic_error("frames that follow are no event");
}

std::vector<MergedWeights> FrameEvents::apply(const std::vector<PendingEvent>& /*dues*/, ChainState<3>& /*chain*/,
                                              Eigen::VectorXd& /*y*/, double /*t*/) {
  throw std::logic_error("frames that follow are no event");
}

void FrameEvents::complete(const ChainState<3>& before, const Eigen::VectorXd& y, ChainState<3>& after) const {
  const double *q = y.data(), *rate = q + beam_.coordinates();
  const Frames& frames = *frames_of(beam_);
  const auto& rest = beam_.model().rest;
  const std::vector<double> turned = frames.twists_to(q, after.mesh.x);
  const FrameSections& was_so = sections_of(before);
  const auto kept = std::make_shared<FrameSections>();
  kept->rest_triads = was_so.rest_triads;
  std::vector<SectionState>&sections = kept->now, &rest_sections = kept->at_rest;
  for (int k = 0; k <= after.mesh.last(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (k > 0) sections.back().ahead = turned[i] - turned[i - 1];
    if (const int was = same_node(before, after, k); was >= 0) {
      sections.push_back(was_so.now[static_cast<std::size_t>(was)]);
      rest_sections.push_back(was_so.at_rest[static_cast<std::size_t>(was)]);
      continue;
    }
    const double x = after.mesh.x[i];
    const Vec<double, 3> t = slope<3>(after.q.data(), k).normalized();
    const TriadReference at = frames.section_at(q, x);
    const auto* const joint = after.joint_at(k);
    const double spin = frames.spin_at(q, rate, x, joint != nullptr ? joint->rate : 0);
    sections.push_back({carried<double>(at.t, t, at.d), spin});
    rest_sections.push_back(
        {rest ? was_so.rest_triads->direction<double>(x, rest->derivatives(x)[1]) : was_so.at_rest.front().direction});
  }
  sections.back().ahead = 0;
  after.kept = kept;
}

void FrameEvents::transfer(const Eigen::VectorXd& old, Eigen::VectorXd& y) const {
  if (!(frame_model(beam_.model())->section.rhoIp > 0)) return;
  const Eigen::Index before = (old.size() - beam_.dofs().balance.count()) / 2;
  frames_of(beam_)->project_spins(*before_, old.data(), old.data() + before, y.data(), y.data() + beam_.coordinates());
}

void FrameRoom::add_sources(const BeamInside<3>& inside, EventSources<3>& sources) const {
  sources.push_back(std::make_unique<FrameEvents>(inside));
}

}  // namespace vlbeam
