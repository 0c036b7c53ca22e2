#pragma once

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

/// Error of the finest of three runs, by how far it is from the second one and that from the third, whose steps or
/// elements are `ratio` and `next_ratio` times as large as those of the run before. Without the third one, `next` < 0,
/// order 1 is taken.
struct ToldError {
  double error = 0;
  double order = 1;
  bool falls = true;  ///< from run to run; not where the motion magnifies what runs differ by
};
/// Orders that an error is taken to have: no lower, and no better.
struct OrderRange {
  double lowest, best;
};
ToldError told_error(double distance, double next, double ratio, double next_ratio, OrderRange orders);

}  // namespace vlbeam
