// What frames of sections add to a beam with joints.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/system/beam_system.hpp"

namespace vlbeam {

template <int D>
void BeamSystem<D>::take_frames(const ChainState<D>& chain) {
  if constexpr (D == 3) {
    std::erase(acting_, frames_);
    frames_ = std::make_shared<Frames>(*model_.frames, chain.mesh, chain.rest.empty() ? nullptr : chain.rest.data(),
                                       chain.rest_sections, chain.q.data(), chain.sections);
    acting_.push_back(frames_);
    rest_sections_ = chain.rest_sections;
    rest_triads_ = chain.rest_triads;
  }
}

template <int D>
void BeamSystem<D>::turn_sections(const ChainState<D>& before, const Eigen::VectorXd& y, ChainState<D>& after) const {
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
      const double turned_here = frames_->twist_to(q, x);
      if (k > 0) sections.back().ahead = turned_here - turned;
      turned = turned_here;
      if (const int was = same_node(k); was >= 0) {
        sections.push_back(before.sections[static_cast<std::size_t>(was)]);
        rest_sections.push_back(before.rest_sections[static_cast<std::size_t>(was)]);
        continue;
      }
      const Vec<double, 3> t = slope<3>(after.q.data(), k).normalized();
      const TriadReference at = frames_->section_at(q, x);
      const auto* const joint = after.joint_at(k);
      const double spin = frames_->spin_at(q, rate, x, joint != nullptr ? joint->rate : 0);
      sections.push_back({carried<double>(at.t, t, at.d), spin});
      rest_sections.push_back({model_.rest ? rest_triads_->template direction<double>(x, model_.rest->derivatives(x)[1])
                                           : before.rest_sections.front().direction});
    }
    sections.back().ahead = 0;
    after.sections = std::move(sections);
    after.rest_sections = std::move(rest_sections);
  }
}

/// Spins tie each joint's x'' to those of all others, but little: by rounds.
template <int D>
std::optional<JointPower> BeamSystem<D>::solve_with_frames(double* force) {
  constexpr int most_rounds = 50;
  constexpr double settled = 1e-14;
  const std::size_t count = places_.size();
  round_forces_ = Eigen::Map<const Eigen::VectorXd>(force, coordinates());
  std::vector<double>& x = round_marks_;
  x.assign(count, 0);

  for (int round = 0; round < most_rounds; ++round) {
    Eigen::Map<Eigen::VectorXd>(force, coordinates()) = round_forces_;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        if (j != i) force[places_[i].mark] -= frames_->mark_inertia(i, j) * x[j];
      }
    }
    const auto power = solve_joints(elements_, motions_, force);
    if (!power) return power;
    double change = 0, largest = 0;
    for (std::size_t i = 0; i < count; ++i) {
      change = std::max(change, std::abs(force[places_[i].mark] - x[i]));
      largest = std::max(largest, std::abs(force[places_[i].mark]));
      x[i] = force[places_[i].mark];
    }
    if (!(change > settled * largest)) return power;
  }
  return std::nullopt;
}

template void BeamSystem<2>::take_frames(const ChainState<2>&);
template void BeamSystem<2>::turn_sections(const ChainState<2>&, const Eigen::VectorXd&, ChainState<2>&) const;
template std::optional<JointPower> BeamSystem<2>::solve_with_frames(double*);
template void BeamSystem<3>::take_frames(const ChainState<3>&);
template void BeamSystem<3>::turn_sections(const ChainState<3>&, const Eigen::VectorXd&, ChainState<3>&) const;
template std::optional<JointPower> BeamSystem<3>::solve_with_frames(double*);

}  // namespace vlbeam
