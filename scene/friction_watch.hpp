#pragma once

#include <optional>
#include <vector>

#include "mechanics/motion/system/beam_system.hpp"
#include "scene/result.hpp"

namespace vlbeam {

/// Watches, step by step, the force across the beam by which the friction of what slides freely goes. A sample now and
/// then would not see a vibration of the beam.
template <int D>
class FrictionWatch {
 public:
  explicit FrictionWatch(const BeamModel<D>& model);

  /// Whether anything slides so.
  bool watches() const;
  /// After a step that ended at (t, y).
  void step(const BeamSystem<D>& system, const Eigen::VectorXd& y, double t);
  /// Velocities may have jumped.
  void event();
  std::vector<FrictionPressure> pressures() const;

 private:
  using Vector = Vec<double, D>;
  struct Joint {
    bool watched = false;
    std::optional<Vector> velocity;  ///< at the end of the last step
    Vector sum = Vector::Zero();     ///< of the last steps, force times way [J]
    double size = 0;                 ///< the same of its sizes
    int steps = 0;
    FrictionPressure all;  ///< [J], and the way in place of a mean
  };

  void close(Joint& joint) const;

  std::vector<Joint> joints_;
  double t_ = 0;
};

extern template class FrictionWatch<2>;
extern template class FrictionWatch<3>;

}  // namespace vlbeam
