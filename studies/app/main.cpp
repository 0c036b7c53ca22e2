#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/error.hpp"
#include "io/messages.hpp"
#include "io/nearest.hpp"
#include "io/provenance.hpp"
#include "studies/app/command.hpp"
#include "tools/interrupt.hpp"

namespace vlbeam {

int processors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

int jobs_or_processors(int jobs) { return jobs > 0 ? jobs : processors(); }

}  // namespace vlbeam

namespace {

constexpr const char* exit_codes =
    "Exit codes: 0 done and gates held, 1 a gate failed or the error wanted was not reached, 2 bad input,\n"
    "3 the computation failed or a file could not be written, 128 + n stopped by signal n (130 for Ctrl-C)";

/// Says which command was meant where the first word is none.
void check_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  const std::string word = argv[1];
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == word) return;
    if (!command->get_group().empty()) known.push_back(command->get_name());
  }
  vlbeam::refuse(
      "command", "\"" + word + "\"",
      "the nearest is \"" + vlbeam::nearest_of(word, known) + "\" (there are: " + vlbeam::quoted_list(known) + ")");
}

/// Says which option was meant where one is none of its command's.
void check_options(const CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands()) {
    std::vector<std::string> known;
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
    for (const std::string& word : command->remaining()) {
      if (!word.starts_with("--")) continue;
      const std::string name = word.substr(0, word.find('='));
      vlbeam::refuse("option", "\"" + name + "\"",
                     "the nearest of " + command->get_name() + " is \"" + vlbeam::nearest_of(name, known) + "\"");
    }
  }
}

std::string footer(const std::string& examples) { return "Examples:\n" + examples + "\n" + exit_codes; }

int dispatch(int argc, char** argv) {
  CLI::App app("vlbeam: beams along which something slides, and how far their numbers can be trusted");
  app.set_version_flag("--version", vlbeam::provenance().at("program").get<std::string>());
  app.require_subcommand(1);
  app.footer(
      footer("  vlbeam scene falling_beam > scene.json                    print a scene to change\n"
             "  vlbeam run scene.json --report r.json --csv r.csv         run it\n"
             "  vlbeam plot r.json -o shapes.svg                          draw it\n"
             "  vlbeam converge scene.json --quantity end.y --error 1e-3  how far can that be trusted?\n"
             "  vlbeam schema scene --text                                every key, its unit, range and default\n"
             "  vlbeam COMMAND --help                                     options of a command, and examples\n"));
  std::vector<std::pair<const CLI::App*, std::function<int()>>> commands;
  for (const vlbeam::Command& command :
       {vlbeam::run_command(), vlbeam::study_command(), vlbeam::kept_run_command(), vlbeam::list_command(),
        vlbeam::scene_command(), vlbeam::converge_command(), vlbeam::import_command(), vlbeam::influence_command(),
        vlbeam::sweep_command(), vlbeam::compare_command(), vlbeam::score_command(), vlbeam::plot_command(),
        vlbeam::gate_command(), vlbeam::claims_command(), vlbeam::schema_command()}) {
    CLI::App* const added = app.add_subcommand(command.name, command.help);
    commands.emplace_back(added, command.options(*added));
    if (command.examples.empty()) {
      added->group("");
    } else {
      added->footer(footer(command.examples));
    }
  }
  check_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    check_options(app);
    return app.exit(error) == 0 ? vlbeam::done : vlbeam::bad_input;
  }
  const auto asked = std::ranges::find_if(commands, [](const auto& command) { return command.first->parsed(); });
  return asked->second();
}

int answer(int argc, char** argv) {
  try {
    return dispatch(argc, argv);
  } catch (const vlbeam::InvalidInput& error) {
    std::cerr << "vlbeam: " << vlbeam::printable(error.what()) << '\n';
    return vlbeam::bad_input;
  } catch (const std::exception& error) {
    std::cerr << "vlbeam: " << vlbeam::printable(vlbeam::explained(error), vlbeam::Lines::several) << '\n';
  }
  return vlbeam::computation_failed;
}

/// Gives the standard streams that the caller has closed something to read from or to fail on: a file opened later
/// would else take their place.
void open_standard_streams() {
  for (int descriptor = ::open("/dev/null", O_RDONLY); descriptor >= 0; descriptor = ::open("/dev/null", O_RDONLY)) {
    if (descriptor <= STDERR_FILENO) continue;
    ::close(descriptor);
    return;
  }
}

bool is_closed(int descriptor) { return (::fcntl(descriptor, F_GETFL) & O_ACCMODE) == O_RDONLY; }

/// Whether all that was sent to a standard stream has arrived.
bool arrived(std::ostream& stream, std::FILE* file) {
  return static_cast<bool>(stream.flush()) && std::fflush(file) == 0 && std::ferror(file) == 0;
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_streams();
  vlbeam::ignore_file_size_signal();
  const int code = answer(argc, argv);
  if (!arrived(std::cout, stdout)) {
    std::cerr << "vlbeam: cannot write to standard output\n";
    return code == vlbeam::done ? vlbeam::computation_failed : code;
  }
  const bool unheard = !is_closed(STDERR_FILENO) && !arrived(std::cerr, stderr);
  return code == vlbeam::done && unheard ? vlbeam::computation_failed : code;
}
