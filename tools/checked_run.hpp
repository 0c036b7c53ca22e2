#pragma once

#include <array>

#include "scene/simulate.hpp"

namespace vlbeam {

/// Whether a scene says nothing of how its steps are chosen, so that its runs are checked by default.
bool has_automatic_steps(const Scene& scene);

/// Runs a scene beside companions that tell how far its numbers are off, RunResult::error: two with steps twice and
/// four times as long, two on meshes of half and a quarter of the elements (two thirds and a half where those are too
/// few, none where no coarser mesh stands for the scene). From three runs follows the order at which they approach each
/// other, and from that what is left. Of the mesh the order is taken no better than 2, for locking and events lower it.
///
/// If an automatic run errs more in time than its accuracy allows, it is done again, twice at most, with the tolerance
/// that the order predicts: the result is that of the last run. Not where runs differ as much with shorter steps.
/// Gravity that acts at once on an unstrained beam is compared with what the beam would bear without vibrations. Adds
/// what is to be known as warnings.
///
/// `jobs` runs go on at a time; digits do not depend on it. Of a run that fails or is interrupted nothing is told.
/// Shapes are handed on once the last run has ended. Throws as simulate().
/// `work`, if not null, becomes the steps times elements of all runs over those of the scene run once.
RunResult checked_run(const Scene& scene, const ProgressCallback& progress, const RunOutput& output, int jobs,
                      double* work = nullptr);

/// Error of the finest of three runs.
struct ToldError {
  double error = 0;
  double order = 1;
  bool falls = true;  ///< from run to run; not where the motion magnifies what runs differ by
};
/// Orders that an error is taken to have: no lower, and no better.
struct OrderRange {
  double lowest, best;
};
/// Orders of three runs, by how far one is from the next: the finest one, a second one with steps or elements `ratio`
/// times as large, and a third one with these `next_ratio` times as large again.
class ErrorOrders {
 public:
  ErrorOrders(double ratio, double next_ratio, OrderRange orders);
  /// By the distance of the first run from the second one, and `next`, that of the second one from the third. Without
  /// a third one, `next` < 0, order 1 is taken.
  ToldError told(double distance, double next) const;

 private:
  struct Powers {
    double first, next;  ///< of the two ratios
  };
  static Powers power(double ratio, double next_ratio, double order);
  /// `next` over the distance, of errors that go with the order of these powers.
  static double growth(Powers of);

  double ratio_;
  OrderRange orders_;
  Powers lowest_;
  double least_seen_;
  std::array<Powers, 30> halves_;  ///< of half the range of orders, a quarter of it, and so on
};

}  // namespace vlbeam
