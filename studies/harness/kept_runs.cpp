#include "studies/harness/kept_runs.hpp"

#include <array>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "studies/harness/checkpoint_file.hpp"
#include "studies/harness/scene_json.hpp"

namespace vlbeam {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> current;  // set before threads start, and gone after their end

/// Two scenes of one name do no harm: a checkpoint of another scene is refused.
fs::path file_of(const Scene& scene) {
  std::array<char, 2 * sizeof(std::size_t) + 1> name{};
  std::snprintf(name.data(), name.size(), "%zx", std::hash<std::string>()(scene_to_json(scene).dump()));
  return *current / (std::string(name.data()) + ".checkpoint");
}

}  // namespace

KeptRuns::KeptRuns(fs::path folder) { current = std::move(folder); }
KeptRuns::~KeptRuns() { current.reset(); }

void KeptRuns::discard() const {
  std::error_code ignored;
  fs::remove_all(*current, ignored);
}

RunResult simulate_kept(const Scene& scene, const ProgressCallback& progress) {
  if (!current || scene.analysis == Analysis::statics || of_sundials(scene.integrator.type)) {
    return simulate(scene, progress);
  }
  const fs::path file = file_of(scene);
  Checkpoints checkpoints;
  std::error_code error;
  if (fs::exists(file, error)) {
    try {
      checkpoints.from = read_checkpoint(file, scene);
    } catch (const InvalidInput&) {
      // of another build: the run starts anew
    }
  }
  checkpoints.every = scene.duration;
  checkpoints.keep = [&](const Checkpoint& checkpoint) {
    try {
      fs::create_directories(*current);
      write_checkpoint(file, scene, checkpoint);
    } catch (const std::exception&) {
      // a run is not lost because the next one cannot spare it
    }
  };
  return simulate(scene, progress, &checkpoints);
}

}  // namespace vlbeam
