#include "scene/friction_watch.hpp"

#include <algorithm>
#include <cmath>

namespace vlbeam {
namespace {

// Of which forces are added up as vectors: longer than a period of what an integrator resolves, shorter than what the
// curve turns in.
constexpr int steps_together = 32;

}  // namespace

template <int D>
FrictionWatch<D>::FrictionWatch(const BeamModel<D>& model) {
  for (const ModelJoint<D>& joint : model.joints) {
    joints_.emplace_back().watched = joint.law.friction && !joint.support && joint.law.mass > 0;
  }
}

template <int D>
bool FrictionWatch<D>::watches() const {
  return std::ranges::any_of(joints_, &Joint::watched);
}

template <int D>
void FrictionWatch<D>::step(const BeamSystem<D>& system, const Eigen::VectorXd& y, double t) {
  const double h = t - t_;
  t_ = t;
  const double *const q = y.data(), *const rate = q + system.coordinates();
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    Joint& joint = joints_[i];
    const int index = static_cast<int>(i);
    if (!joint.watched || !system.on_beam(index) || system.loose() != nullptr) continue;
    const JointPlace& place = system.place_of(index);
    const Vector v = position<D>(rate, place.node), s = slope<D>(q, place.node);
    if (joint.velocity && h > 0) {
      const double stretch = s.norm(), way = std::abs(rate[place.mark]) * stretch * h;
      const Vector pull = system.model().joints[i].law.mass * ((v - *joint.velocity) / h - system.gravity(t));
      const Vector across = pull - s * (s.dot(pull) / (stretch * stretch));
      joint.sum += way * across;
      joint.size += way * across.norm();
      joint.all.way += way;
      if (++joint.steps == steps_together) close(joint);
    }
    joint.velocity = v;
  }
}

template <int D>
void FrictionWatch<D>::event() {
  for (Joint& joint : joints_) joint.velocity.reset();
}

template <int D>
void FrictionWatch<D>::close(Joint& joint) const {
  joint.all.size += joint.size;
  joint.all.mean += joint.sum.norm();
  joint.sum.setZero();
  joint.size = 0;
  joint.steps = 0;
}

template <int D>
std::vector<FrictionPressure> FrictionWatch<D>::pressures() const {
  std::vector<FrictionPressure> result;
  for (Joint joint : joints_) {
    close(joint);
    FrictionPressure& all = joint.all;
    if (all.way > 0) all = {all.size / all.way, all.mean / all.way, all.way};
    result.push_back(all);
  }
  return result;
}

template class FrictionWatch<2>;
template class FrictionWatch<3>;

}  // namespace vlbeam
