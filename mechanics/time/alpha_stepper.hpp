#pragma once

#include <vector>

#include "mechanics/time/alpha_step.hpp"
#include "mechanics/time/assign.hpp"
#include "mechanics/time/generalized_alpha.hpp"
#include "mechanics/time/kept_tangent.hpp"
#include "mechanics/time/newton_stop.hpp"
#include "mechanics/time/shorter_steps.hpp"

namespace vlbeam {

/// Generalized-alpha: its step (generalized_alpha.cpp), Newton's iteration in it (alpha_newton.cpp) and what limits it
/// (alpha_errors.cpp).
class GeneralizedAlpha final : public Stepper {
 public:
  GeneralizedAlpha(SecondOrderSystem& system, const GeneralizedAlphaOptions& options, NewtonCounters* counters);

  bool try_step(Ode& /*ode*/, Eigen::VectorXd& y, double& t, double& dt) override;

  bool extrapolate(const Eigen::VectorXd& y, double t, double dt, double tau, Eigen::VectorXd& there) override;

  void reset() override {
    started_ = nearby_ = false;
    solved_h_ = 0;
    tangent_by_a_ = 0;
  }

  void pass_corner() override {}  // its accelerations go on: the step that they are off is one, and short

  void limit(double longest) override { longest_ = std::min(options_.step, longest); }

  void keep_for_event(const Stepper& other, bool at_start) override;

  void exchange(Archive& memory) override;

  void resume(const Stepper& other) override;

  void resume_nearby(const Stepper& other) override;

 private:
  double length(double dt) const { return dt <= longest_ * (1 + 2 * slightly_longer) ? dt : longest_; }

  /// A step from (t, y), of length h.
  void begin(const Eigen::VectorXd& y, double t, double h);

  void start(const Eigen::VectorXd& y, double t, double h);

  void start_control(Eigen::Index n);

  /// Lets the method go on through an event with its accelerations of before. Those of the equations of motion tell, in
  /// all modes, what the event has changed of the forces: a merged element that is 1e-9 m off its shape would throw a
  /// mode faster than the step a million times as far as it will swing, and a method that starts anew in each step,
  /// where events are as frequent, gives such modes energy. Of that change the method takes what its step can follow,
  /// by its own tangent S = K + by_v C + by_a M: in slow modes all but a share of (frequency x step)^2. The
  /// accelerations of before are in step_.end, where those with which it goes on take their place, and those of now in
  /// step_.start. Returns false where it starts anew.
  bool go_on(double t, double h);

  /// The velocity goes on, and the acceleration, too, where that is smooth: else it would throw stiff modes, whose
  /// period is shorter than the step, far off, and Newton would start from a torn mesh.
  void predict(double t, double h);

  /// Whether the end of this step was nearer to the acceleration going on than to the velocity alone. Slopes tell:
  /// stiff modes turn them more than they move nodes.
  bool acceleration_predicts(double h) const;

  /// Newton's iteration for the end of the step, from the predictor. Returns false where it stalls. `nearby`: its
  /// tangent is that of nearly this step.
  bool solve(double t, double h, NewtonKind kind, bool nearby, double& dissipation);

  /// Of a step of length h.
  bool make_tangent(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& a, double t, double h);

  /// What rounding of all that the residual depends on does to the solution.
  void measure_noise(double t, double h);

  void count(double error);

  /// Estimated error of the positions over what the tolerances allow, the largest of all coordinates.
  double error_ratio(double t, double h);

  /// How long the next step may be for what it turns [s]. The error of a turn adds to those before it: that of a step
  /// goes with the square of its angle, and the sum of all so with the logarithm of what has turned, not in proportion.
  double within_turn(double t);

  /// Whether the step is short enough to tell what it loses. A damper that sets in within it, as where a mass lands,
  /// may stop the mass within a small part of it: positions are right to the tolerance then, but the power at the end
  /// of the step says nothing of what it loses, nor does that of the next step's middle. Such a step is to lose no
  /// more, by its end, than a small share of the largest kinetic energy so far.
  bool follows_loss(const Eigen::VectorXd& y, double t, double h, double dissipation);

  /// What Newton's iteration may leave in the next step, of its increment: a share of the error that the method itself
  /// makes, as it was in this step.
  void choose_tolerance();

  /// Whether the unfiltered error is no error of a step any more. Newton's iteration may find another solution than the
  /// one that goes on from the start, a rod turned round for one; it is as if stiff modes had thrown the beam there,
  /// and filter_error() would leave nothing of that.
  bool is_torn() const;

  /// By the tangent: of fast modes, which the step does not follow, it counts next to nothing. The residual is linear
  /// in the accelerations, and next to 0 at the end of the step: with more acceleration it is the inertia of this.
  void filter_error(double t, double h, Eigen::Index count);

  /// The longest step that is thought to follow the motion, whatever the duration of the run: what tolerances make of
  /// positions and their rates [s].
  double longest_followed() const;

  /// Of the tolerances, by the largest displacement so far, or that of a part of the longest step at the largest speed:
  /// what starts with a jolt will move farther than it has, and vibrations that turn back before do not count in full.
  /// At an event nodes become others: what they move from then on is added to the largest before.
  double share_of_motion();

  /// A step of next to no length, up to an event or a sample: the last accelerations go on.
  void drift(Eigen::VectorXd& y, double& t, double h);

  void accept(Eigen::VectorXd& y, double& t, double h, double dissipation);

  /// Accelerations where the next step starts.
  EndAccelerations& here() { return repeats_start_ ? step_.start : step_.end; }
  const EndAccelerations& here() const { return repeats_start_ ? step_.start : step_.end; }

  SecondOrderSystem& system_;
  GeneralizedAlphaOptions options_;
  NewtonCounters* counters_;
  AlphaRule rule_;
  double longest_ = options_.step;  ///< [s], of the next steps
  bool started_ = false;
  bool stalled_ = false;  ///< Newton's iteration has asked for the shorter step
  ShorterSteps shorter_;  ///< since Newton's iteration failed
  KeptTangent kept_;
  bool is_smooth_ = false;   ///< the motion, so that its acceleration is worth carrying on
  bool nearby_ = false;      ///< step_.d and the tangent are of nearly the same step, `solved_h_` long
  double solved_h_ = 0;      ///< [s]; 0 for none
  double tolerance_;         ///< of Newton's iteration, of the increment
  int calm_ = 0;             ///< steps that may not be longer than the one before
  double usual_;             ///< [s], length that the error last allowed: next to it a step has next to no length
  double turned_ = 0;        ///< [rad], so far
  double turned_until_ = 0;  ///< [s]
  double tangent_by_a_ = 0;  ///< what the factored tangent was made for; 0 for none
  TangentPoint tangent_;     ///< where checkpoints are kept
  AlphaStep step_;
  double energy_ = 0;           ///< [J], the largest kinetic one so far that follows_loss() has seen, or lost in a step
  bool repeats_start_ = false;  ///< the next step starts where the last one did
  Eigen::VectorXd r_;           ///< residual and correction, then the estimated error of the positions
  Eigen::VectorXd other_;       ///< working memory of one function at a time
  NewtonStop stop_;
  Eigen::VectorXd allowed_;                     ///< absolute tolerances of the coordinates
  bool crosses_event_ = false;                  ///< the next start is behind an event: step_.end goes on through it
  Eigen::VectorXd from_q_;                      ///< where the coordinates started, or were at the last event
  double motion_ = 0, motion_until_event_ = 0;  ///< [m], largest displacement so far
  double noise_step_ = 0;                       ///< [s], that its noise belongs to
  std::vector<double> history_;                 ///< corrections of the current step, relative to its increment
};

}  // namespace vlbeam
