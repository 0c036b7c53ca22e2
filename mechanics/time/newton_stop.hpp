#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "mechanics/time/archive.hpp"
#include "mechanics/time/fields.hpp"

namespace vlbeam {

inline constexpr double slow_contraction = 0.1;  // of an iteration that gains little
inline constexpr double newton_rounding = 4 * std::numeric_limits<double>::epsilon();

/// The largest of all fields, |x| over |q|: of dimensionless fields over 1, of others over a length, if those are
/// larger.
double relative_to_coordinates(const std::vector<FieldRun>& fields, const Eigen::VectorXd& x, const Eigen::VectorXd& q);

/// When the Newton iteration of a step ends, and when it is worth a new tangent. The error that is left is estimated by
/// theta/(1 - theta) times the last correction, theta the slowest contraction from one correction to the next with the
/// same tangent: where stiff directions converge faster than soft ones, the last one tells of the stiff. It is compared
/// with the step's own increment, what the iteration had to find: so it does not matter in which units the coordinates
/// are, nor how short the step is, and what is left cannot add up to more than its share over many steps. Each field
/// has its own norm. A correction as small as what rounding of the coordinates does to the solution says nothing any
/// more; how much that is, is measured where corrections stop falling.
class NewtonStop {
 public:
  enum class Verdict {
    go_on,
    done,
    slow,       ///< a new tangent may be worth its cost
    stagnates,  ///< slow, and perhaps by rounding alone: where negligible(), measure it (set_noise()) and settle()
  };

  void set_fields(std::vector<FieldRun> fields) {
    fields_ = std::move(fields);
    forget_noise();
  }
  const std::vector<FieldRun>& fields() const { return fields_; }

  /// Before the first iteration of a step. Where that goes on with the tangent of the step before, from its end, the
  /// contraction of that one, slowest(), is expected, and what the tangent is wrong by in the length of the step.
  void begin_step(double expected_contraction = 0) {
    error_ = 0;
    corrections_ = 0;
    of_tangent_ = slowest_ = expected_contraction;
    first_of_tangent_ = false;
    if (++noise_age_ > noise_lifetime) forget_noise();
  }
  /// The next correction is the first one of a new tangent.
  void new_tangent() {
    of_tangent_ = 0;
    first_of_tangent_ = true;
  }
  /// The length of the step, or the equations, are other ones.
  void forget_noise() { noise_known_ = false; }

  /// After the correction `r`, with which the increment has become `d`. The least relative error [-] that is good
  /// enough is `tolerance`; theta > `slow` is slow.
  Verdict judge(const Eigen::VectorXd& r, const Eigen::VectorXd& d, double tolerance, double slow);

  /// Whether corrections are rounding, with the noise now known.
  bool settle() const { return relative_error(settled) == 0; }

  /// Whether the last correction is so small against the coordinates q that, not falling, it may be rounding. Far from
  /// the solution rounding is large, too, and says nothing.
  bool negligible(const Eigen::VectorXd& q) const;

  /// Whether the last corrections of some field are still falling; one alone may be.
  bool falls() const;

  /// Whether a correction that may not be rounding is more than `limit` times the one before, in its field.
  bool grows(double limit, const Eigen::VectorXd& q) const;

  /// Changes each number of `x` by a rounding error.
  static void perturb(Eigen::VectorXd& x);
  /// `change` is what a perturbation of all that the residual depends on does to the solution, near q.
  void set_noise(const Eigen::VectorXd& change, const Eigen::VectorXd& q);

  /// Writes or reads all but the fields.
  void exchange(Archive& memory) {
    for (FieldNorms* norms : {&correction_, &before_, &increment_, &noise_}) memory(*norms);
    memory(noise_known_);
    memory(noise_age_);
    memory(error_);
    memory(contraction_);
    memory(slowest_);
    memory(corrections_);
  }

  double error() const { return error_; }  ///< last correction over the increment, the largest of all fields
  double contraction() const { return contraction_; }  ///< from the correction before; 0 after the first
  double slowest() const { return slowest_; }          ///< contraction of this step
  /// What error() will be after so many more iterations, if corrections go on falling as they do.
  double error_after(int iterations) const {
    double error = error_;
    for (int i = 0; i < iterations; ++i) error *= contraction_;
    return error;
  }

 private:
  static constexpr double settled = 4;  // times the noise: corrections that do not fall are not exactly alike

  static constexpr int noise_lifetime = 32;  // steps, in which forces do not change by much

  /// What may be taken for rounding at the coordinates q, and no more.
  FieldNorms largest_rounding(const Eigen::VectorXd& q) const;
  /// Of the fields whose correction exceeds `times` the noise.
  double relative_error(double times) const;

  std::vector<FieldRun> fields_;
  FieldNorms correction_{}, before_{}, increment_{}, noise_{};
  bool noise_known_ = false;
  int noise_age_ = 0;  ///< [steps]
  double error_ = 0, contraction_ = 0, slowest_ = 0;
  double of_tangent_ = 0;  ///< slowest contraction with this tangent, since corrections last grew
  bool first_of_tangent_ = false;
  int corrections_ = 0;  ///< in this step
};

}  // namespace vlbeam
