#include "tools/sweep.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <optional>
#include <thread>

#include "core/pieces.hpp"
#include "tools/interrupt.hpp"
#include "tools/progress.hpp"

namespace vlbeam {

void run_tasks(const std::string& title, const std::vector<double>& costs, int jobs,
               const std::function<void(std::size_t)>& task) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&costs](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });

  const double all = std::accumulate(costs.begin(), costs.end(), 0.0);
  Progress progress(title);
  const auto in_words = [&order](std::size_t finished) {
    return [&order, finished] { return std::to_string(finished) + "/" + std::to_string(order.size()) + " runs"; };
  };
  std::atomic<std::size_t> next{0};
  std::atomic<std::size_t> finished{0};
  std::atomic<double> done{0};
  const std::size_t threads = std::min(static_cast<std::size_t>(std::max(jobs, 1)), order.size());
  std::optional<ThreadLimit> alone;  // a run's own threads would be in the way of other runs
  if (threads > 1) alone.emplace(1);
  const auto work = [&] {
    for (std::size_t i = next++; i < order.size() && !interrupted(); i = next++) {
      task(order[i]);
      const double so_far = done += costs[order[i]];
      progress.update(all > 0 ? so_far / all : 0, in_words(++finished));
    }
  };

  progress.update(0, in_words(0));
  std::vector<std::jthread> others;
  for (std::size_t i = 1; i < threads; ++i) others.emplace_back(work);
  work();
}

}  // namespace vlbeam
