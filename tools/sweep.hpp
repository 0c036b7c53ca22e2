#pragma once

#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "io/messages.hpp"

namespace vlbeam {

/// Result of one case of a sweep, or why it failed.
template <class Result>
struct Outcome {
  std::optional<Result> result;  ///< empty where the case failed
  std::string failure;           ///< why
  double seconds = 0;            ///< wall time

  explicit operator bool() const { return result.has_value(); }
  const Result& operator*() const { return *result; }
  const Result* operator->() const { return &*result; }
};

/// Runs task(0) ... task(n - 1) on `jobs` threads, the most costly first, with progress on standard error.
/// `costs` holds one number a task, in any unit. After an interruption no further task is started.
void run_tasks(const std::string& title, const std::vector<double>& costs, int jobs,
               const std::function<void(std::size_t)>& task);

/// Runs `run(case)` for independent cases on `jobs` threads. Outcomes stand in the order of the cases and do not depend
/// on `jobs`. A case that throws, or that an interruption kept from starting, has a failure and no result.
/// `cost(case)` is a rough estimate of its work, so that the longest start first and the remaining time can be
/// estimated.
template <class Case, class Run, class Cost>
auto sweep(const std::string& title, const std::vector<Case>& cases, int jobs, const Run& run, const Cost& cost) {
  using Result = std::invoke_result_t<const Run&, const Case&>;
  std::vector<Outcome<Result>> outcomes(cases.size());
  for (auto& outcome : outcomes) outcome.failure = "interrupted before it started";

  std::vector<double> costs;
  costs.reserve(cases.size());
  for (const Case& item : cases) costs.push_back(static_cast<double>(cost(item)));

  run_tasks(title, costs, jobs, [&](std::size_t i) {
    const auto start = std::chrono::steady_clock::now();
    try {
      outcomes[i].result.emplace(run(cases[i]));
      outcomes[i].failure.clear();
    } catch (const std::exception& error) {
      outcomes[i].failure = explained(error);
    }
    outcomes[i].seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  });
  return outcomes;
}

}  // namespace vlbeam
