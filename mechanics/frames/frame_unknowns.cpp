#include "mechanics/frames/frame_unknowns.hpp"

#include "mechanics/frames/frame_sections.hpp"

namespace vlbeam {

void FrameUnknowns::take(const ChainState<3>& chain) {
  const FrameSections& sections = sections_of(chain);
  frames_ = std::make_shared<Frames>(*frame_model(beam_.model()), chain.mesh,
                                     chain.rest.empty() ? nullptr : chain.rest.data(), sections.at_rest, chain.q.data(),
                                     sections.now);
  rest_ = sections.at_rest;
  rest_triads_ = sections.rest_triads;
}

void FrameUnknowns::adopt() {
  frames_->let_slide(beam_.places(), beam_.angles(), beam_.model().rest.get(), rest_triads_);
  std::vector<bool> held(beam_.mesh().x.size(), false);
  for (const HeldNode<3>& node : beam_.supports().nodes()) {
    held[static_cast<std::size_t>(node.node)] = node.holds_angle();
  }
  frames_->hold(held);
}

void FrameUnknowns::write(const ChainState<3>& chain, const double* /*old_q*/, const double* /*old_rate*/, double* q,
                          double* rate) const {
  const FrameSections& sections = sections_of(chain);
  for (Eigen::Index k = 0; k < count(); ++k) {
    const SectionState& section = sections.now[static_cast<std::size_t>(k)];
    q[beam_.angles() + k] = section.angle;
    rate[beam_.angles() + k] = section.spin;
  }
}

/// Sections of joints at rest are those of where the joints are.
void FrameUnknowns::read(const double* q, const double* rate, ChainState<3>& chain) const {
  const auto sections = std::make_shared<FrameSections>();
  sections->now = frames_->sections(q, rate);
  sections->at_rest = rest_;
  sections->rest_triads = rest_triads_;
  for (std::size_t i = 0; chain.curved_at_rest() && i < chain.joints.size(); ++i) {
    const int node = chain.joints[i].node;
    sections->at_rest[static_cast<std::size_t>(node)].direction = rest_triads_->direction<double>(
        chain.mesh.x[static_cast<std::size_t>(node)], slope<3>(chain.rest.data(), node));
  }
  chain.kept = sections;
}

bool FrameUnknowns::load(const double* /*q*/, const double* /*rate*/, double* /*a*/,
                         std::vector<JointMotion<3>>& joints) {
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i].x_inertia += frames_->mark_inertia(i, i);
  return true;
}

void FrameUnknowns::observe(const double* q, const double* rate, int /*points*/, Observation<3>& seen) const {
  const Frames::Seen bent = frames_->observe(q, rate);
  seen.energy.kinetic += bent.kinetic;
  seen.energy.bending += bent.bending;
  seen.energy.torsion += bent.torsion;
  seen.angular_momentum += bent.momentum;
  if (seen.extremes) seen.extremes->curvature = bent.curvature;
}

std::unique_ptr<Unknowns<3>> FrameRoom::unknowns(const CurrentBeam<3>& beam, const std::vector<double>& /*x*/) const {
  return std::make_unique<FrameUnknowns>(beam);
}

}  // namespace vlbeam
