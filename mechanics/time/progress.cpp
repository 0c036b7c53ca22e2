#include "mechanics/time/progress.hpp"

#include <array>
#include <sstream>

#include "core/error.hpp"

namespace vlbeam {
namespace {

constexpr double crawl = 1e-2;  // of the usual step
constexpr double most = 1e8;    // steps that are worth waiting for

}  // namespace

void Progress::look(double t, const std::function<std::string()>& where) {
  const auto tried = static_cast<double>(tries_);
  const double gained = t - t_before_;
  if (gained < crawl * usual_ * tried && gained * most < (t_end_ - t) * tried) {
    constexpr std::array<const char*, step_limits> limits{"the longest step allowed", "the error tolerance",
                                                          "Newton's iteration", "events"};
    std::ostringstream what;
    what << "the run does not get on: its last " << tries_ << " steps took it " << six_digits(gained)
         << " s further, with ";
    bool first = true;
    const StepsByLimit now = so_far();
    for (std::size_t i = 0; i < limits.size(); ++i) {
      const std::size_t by = now[i] - before_[i];
      if (by == 0) continue;
      what << (first ? "" : ", ") << by << " held short by " << limits[i];
      first = false;
    }
    const std::string fastest = where();
    if (!fastest.empty()) what << "; " << fastest;
    throw ComputationFailed(what.str(), t);
  }
  before_ = so_far();
  t_before_ = t;
  tries_ = 0;
}

}  // namespace vlbeam
