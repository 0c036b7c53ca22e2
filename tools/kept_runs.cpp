#include "tools/kept_runs.hpp"

#include <array>
#include <cstdio>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "io/checkpoint_file.hpp"
#include "io/run_outcome.hpp"
#include "io/scene_json.hpp"
#include "tools/subprocess.hpp"

namespace vlbeam {
namespace {

namespace fs = std::filesystem;

struct Current {
  fs::path folder;
  std::string program;
};
std::optional<Current> current;  // set before threads start, and gone after their end

/// Two scenes of one name do no harm: a checkpoint of another scene is refused.
fs::path file_of(const Scene& scene) {
  std::array<char, 2 * sizeof(std::size_t) + 1> name{};
  std::snprintf(name.data(), name.size(), "%zx", std::hash<std::string>()(scene_to_json(scene).dump()));
  return current->folder / (std::string(name.data()) + ".checkpoint");
}

/// Beside the scene goes what its options do not say: who has chosen the integrator, for which accuracy.
RunResult simulate_apart(const Scene& scene, const ProgressCallback& progress) {
  const Json asked{{"scene", scene_to_json(scene)},
                   {"automatic", scene.integrator.automatic},
                   {"accuracy", scene.integrator.accuracy},
                   {"assumed", scene.assumed}};
  const ProcessResult process = run_process(
      {current->program, "kept-run", current->folder.string()}, [&progress] { return progress && !progress(0); },
      asked.dump());
  const bool stopped = process.exit_code != 0 && progress && !progress(0);
  if (stopped && process.output.empty()) throw std::runtime_error("interrupted");
  if (process.exit_code != 0 && !stopped) throw std::runtime_error("its process " + how_it_ended(process));
  return outcome_from_bytes(process.output).get();
}

}  // namespace

KeptRuns::KeptRuns(fs::path folder, std::string program) { current = Current{std::move(folder), std::move(program)}; }
KeptRuns::~KeptRuns() { current.reset(); }

void KeptRuns::discard() const {
  std::error_code ignored;
  fs::remove_all(current->folder, ignored);
}

RunResult simulate_kept(const Scene& scene, const ProgressCallback& progress) {
  if (current && !current->program.empty()) return simulate_apart(scene, progress);
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
      fs::create_directories(current->folder);
      write_checkpoint(file, scene, checkpoint);
    } catch (const std::exception&) {
      // a run is not lost because the next one cannot spare it
    }
  };
  return simulate(scene, progress, &checkpoints);
}

std::string answer_of_kept_run(const fs::path& folder, const std::string& asked, const ProgressCallback& progress) {
  const KeptRuns kept(folder);
  return to_bytes(RunOutcome::of([&] {
    const Json json = parse_json(asked);
    Scene scene = scene_from_json(json.at("scene"));
    scene.integrator.automatic = json.at("automatic");
    scene.integrator.accuracy = json.at("accuracy");
    scene.assumed = json.at("assumed");
    return simulate_kept(scene, progress);
  }));
}

}  // namespace vlbeam
