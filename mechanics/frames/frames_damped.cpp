// How the material of a beam with frames resists what changes its bending and its twist.
#include "core/element/active.hpp"
#include "core/element/shape_functions.hpp"
#include "mechanics/frames/frame_damping.hpp"
#include "mechanics/frames/frames.hpp"

namespace vlbeam {
namespace {

template <int N>
Eigen::Matrix<double, N, N> tangent_of(const FrameDamping& damping, const Eigen::Matrix<double, N, 1>& q,
                                       const Eigen::Matrix<double, N, 1>& rate, const TangentWeights& by) {
  const auto answer = damping.at<Active<N>, N>(varied(q, by.q), varied(rate, by.v));
  Eigen::Matrix<double, N, N> result;
  for (int i = 0; i < N; ++i) result.row(i) = answer.force[i].derivatives().transpose();
  return result;
}

}  // namespace

FrameDamping Frames::damping_of(const FrameTable& table, const double* q, int k) const {
  const auto i = static_cast<std::size_t>(k);
  FrameDamping damping{references_[i], references_[i + 1], table, model_.section, turned(q, k), {}, {}};
  if (!slides(k)) return damping;
  for (std::size_t e = 0; e < 2; ++e) {
    const auto f = rational_shape(weights_[i], static_cast<double>(e));
    damping.bends[e] = {f[2][2], f[1][2], f[3][2]};
  }
  if (rest_curve_ != nullptr) {
    damping.rest = frame_rest_rates(table, model_.section, rest_ends(k), damping.bends, *along_);
  }
  return damping;
}

FrameVector Frames::gathered(const double* q, int k) const {
  FrameVector result;
  result << position<3>(q, k), slope<3>(q, k), q[angle(k)], position<3>(q, k + 1), slope<3>(q, k + 1), q[angle(k + 1)];
  return result;
}

double Frames::add_sliding_damping(const double* q, const double* rate, double* force) const {
  double lost = 0;
  for (const Sliding& sliding : sliding_) {
    const auto answer = damping_of(sliding.unit, q, sliding.element)
                            .at<double, 16>(gathered(sliding, q, false), gathered(sliding, rate, true));
    lost += answer.power;
    scatter(sliding, -answer.force, force);
  }
  return lost;
}

void Frames::add_damping_tangent(const Motion<3>& motion, const TangentWeights& by, BeamMatrix<3>& tangent) const {
  const double *q = motion.beam.q, *rate = motion.beam.rate;
  for (int k = 0; k < elements(); ++k) {
    if (slides(k)) continue;
    const FrameDamping damping = damping_of(tables_[static_cast<std::size_t>(k)], q, k);
    tangent.add_turning_element(k, tangent_of<14>(damping, gathered(q, k), gathered(rate, k), by));
  }
  for (const Sliding& sliding : sliding_) {
    const FrameDamping damping = damping_of(sliding.unit, q, sliding.element);
    tangent.add_turning_at_joints(
        sliding.element, tangent_of<16>(damping, gathered(sliding, q, false), gathered(sliding, rate, true), by),
        sliding.joints);
  }
}

}  // namespace vlbeam
