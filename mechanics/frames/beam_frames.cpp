// What frames of sections add to a beam with joints.
#include <utility>

#include "mechanics/motion/system/current_beam.hpp"

namespace vlbeam {

template <int D>
void CurrentBeam<D>::take_frames(const ChainState<D>& chain) {
  if constexpr (D == 3) {
    std::erase(acting_, sections_.frames);
    sections_.frames =
        std::make_shared<Frames>(*model_.frames, chain.mesh, chain.rest.empty() ? nullptr : chain.rest.data(),
                                 chain.rest_sections, chain.q.data(), chain.sections);
    acting_.push_back(sections_.frames);
    sections_.rest = chain.rest_sections;
    sections_.rest_triads = chain.rest_triads;
  }
}

template <int D>
void CurrentBeam<D>::turn_sections(const ChainState<D>& before, const Eigen::VectorXd& y, ChainState<D>& after) const {
  if constexpr (D == 3) {
    const double *q = y.data(), *rate = q + coordinates();
    const auto same_node = [&](int k) {
      const auto* const joint = after.joint_at(k);
      for (std::size_t i = 0; i < before.mesh.x.size(); ++i) {
        const auto* const was = before.joint_at(static_cast<int>(i));
        if (joint != nullptr && was != nullptr && joint->index == was->index) return static_cast<int>(i);
        if (joint == nullptr && was == nullptr && after.mesh.x[static_cast<std::size_t>(k)] == before.mesh.x[i]) {
          return static_cast<int>(i);
        }
      }
      return -1;
    };
    std::vector<SectionState> sections, rest_sections;
    double turned = 0;
    for (int k = 0; k <= after.mesh.last(); ++k) {
      const double x = after.mesh.x[static_cast<std::size_t>(k)];
      const double turned_here = sections_.frames->twist_to(q, x);
      if (k > 0) sections.back().ahead = turned_here - turned;
      turned = turned_here;
      if (const int was = same_node(k); was >= 0) {
        sections.push_back(before.sections[static_cast<std::size_t>(was)]);
        rest_sections.push_back(before.rest_sections[static_cast<std::size_t>(was)]);
        continue;
      }
      const Vec<double, 3> t = slope<3>(after.q.data(), k).normalized();
      const TriadReference at = sections_.frames->section_at(q, x);
      const auto* const joint = after.joint_at(k);
      const double spin = sections_.frames->spin_at(q, rate, x, joint != nullptr ? joint->rate : 0);
      sections.push_back({carried<double>(at.t, t, at.d), spin});
      rest_sections.push_back(
          {model_.rest ? sections_.rest_triads->template direction<double>(x, model_.rest->derivatives(x)[1])
                       : before.rest_sections.front().direction});
    }
    sections.back().ahead = 0;
    after.sections = std::move(sections);
    after.rest_sections = std::move(rest_sections);
  }
}

template void CurrentBeam<2>::take_frames(const ChainState<2>&);
template void CurrentBeam<2>::turn_sections(const ChainState<2>&, const Eigen::VectorXd&, ChainState<2>&) const;
template void CurrentBeam<3>::take_frames(const ChainState<3>&);
template void CurrentBeam<3>::turn_sections(const ChainState<3>&, const Eigen::VectorXd&, ChainState<3>&) const;

}  // namespace vlbeam
