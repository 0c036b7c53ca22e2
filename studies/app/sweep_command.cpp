// `vlbeam sweep`: a scene for many values of its options.
#include <sys/resource.h>

#include <iostream>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "core/error.hpp"
#include "core/pieces.hpp"
#include "io/files.hpp"
#include "io/messages.hpp"
#include "studies/app/command.hpp"
#include "tools/interrupt.hpp"
#include "tools/own_sweep.hpp"
#include "tools/subprocess.hpp"
#include "tools/sweep.hpp"

namespace vlbeam {
namespace {

struct SweepArguments {
  std::string sweep;
  std::string out;          ///< empty: the sweep's name without .json
  int jobs = 0;             ///< processes at a time; 0: one a processor
  std::optional<int> only;  ///< the one case to run, by its number
  bool collect = false;     ///< only join what is there
  bool force = false;       ///< another sweep in the folder may be lost
  double memory = 0;        ///< each case may take [MB]; 0: as much as there is
};

/// Memory beyond that is an error of this process, no trouble of others.
void limit_memory(double megabytes) {
  const rlimit limit{static_cast<rlim_t>(megabytes * 1e6), static_cast<rlim_t>(megabytes * 1e6)};
  if (::setrlimit(RLIMIT_AS, &limit) != 0) throw std::runtime_error("cannot limit the memory of this case");
}

int carry_out(const SweepArguments& arguments) {
  namespace fs = std::filesystem;
  const fs::path out =
      arguments.out.empty() ? fs::path(arguments.sweep).replace_extension("") : fs::path(arguments.out);
  const SweepPlan plan = read_sweep(arguments.sweep);
  for (const char* name : {"plan.json", "sweep.csv", "sweep.json"}) {
    if (!same_file(arguments.sweep, out / name)) continue;
    throw InvalidInput("--out", "\"" + out.string() + "\"",
                       std::string("the sweep file itself stands there as ") + name + ": name another folder");
  }
  const SweepFolder folder(out, plan, arguments.force);
  install_interrupt_handler();
  if (arguments.only) {
    if (*arguments.only < 0 || static_cast<std::size_t>(*arguments.only) >= plan.cases.size()) {
      throw InvalidInput("--case", std::to_string(*arguments.only),
                         "this sweep has cases 0 to " + std::to_string(plan.cases.size() - 1));
    }
    if (arguments.memory > 0) limit_memory(arguments.memory);
    const ThreadLimit alone(1);  // others run beside this one
    const auto i = static_cast<std::size_t>(*arguments.only);
    const bool well = folder.has(i) || folder.run(i);
    if (interrupted()) return interrupted_exit_code();
    return well ? done : computation_failed;
  }
  if (!arguments.collect) {
    const std::vector<std::size_t> missing = folder.missing();
    run_tasks(
        "sweep", std::vector<double>(missing.size(), 1.0), jobs_or_processors(arguments.jobs), [&](std::size_t k) {
          // A process of its own: what becomes of it becomes of no other.
          const std::string number = std::to_string(missing[k]);
          const ProcessResult result = run_process({this_program, "sweep", arguments.sweep, "--out", out.string(),
                                                    "--case", number, "--memory", std::to_string(arguments.memory)},
                                                   interrupted);
          if (folder.has(missing[k]) || interrupted()) return;
          folder.note_crash(missing[k], how_it_ended(result));
        });
    if (interrupted()) {
      std::cerr << "vlbeam: interrupted; " << plan.cases.size() - folder.missing().size() << " of " << plan.cases.size()
                << " cases are there: the same command goes on\n";
      return interrupted_exit_code();
    }
  }
  const std::size_t unwell = folder.collect();
  std::cerr << plan.cases.size() << " cases, "
            << (unwell == 0 ? "all of them ended well" : std::to_string(unwell) + " did not end well")
            << "\n  written         " << printable((out / "sweep.csv").string()) << "\n  written         "
            << printable((out / "sweep.json").string()) << '\n';
  return unwell == 0 ? done : computation_failed;
}

}  // namespace

Command sweep_command() {
  return {.name = "sweep",
          .help = "Run a scene for many values of its options; goes on where it was stopped",
          .options = [](CLI::App& app) -> std::function<int()> {
            const auto arguments = std::make_shared<SweepArguments>();
            app.add_option("sweep", arguments->sweep, "Sweep file, see schema sweep")->required();
            app.add_option("--out", arguments->out,
                           "Folder of what its cases give (default: the file's name without .json)");
            app.add_option("--jobs,-j", arguments->jobs, "Processes at a time (default: one a processor)")
                ->check(CLI::NonNegativeNumber);
            app.add_option("--case", arguments->only, "Run this case only, and join nothing: for job arrays");
            app.add_flag("--collect", arguments->collect, "Run nothing, join the cases that are there");
            app.add_flag("--force", arguments->force, "Start anew where the folder holds another sweep");
            app.add_option("--memory", arguments->memory, "What each case may take [MB] (default: no limit)")
                ->check(CLI::NonNegativeNumber);
            return [arguments] { return carry_out(*arguments); };
          },
          .examples =
              "  vlbeam sweep sweep.json                                   all cases, into sweep/\n"
              "  vlbeam sweep sweep.json --case 3                          one of them, as a job of a cluster\n"
              "  vlbeam sweep sweep.json --collect                         join those that are there\n"};
}

}  // namespace vlbeam
