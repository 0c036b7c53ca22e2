// `vlbeam study`, `gate`, `claims`: what CI runs.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>

#include "core/error.hpp"
#include "core/pieces.hpp"
#include "io/files.hpp"
#include "io/messages.hpp"
#include "scene/names.hpp"
#include "studies/app/command.hpp"
#include "studies/app/registry.hpp"
#include "studies/harness/claims.hpp"
#include "studies/harness/source_folder.hpp"
#include "tools/interrupt.hpp"
#include "tools/kept_runs.hpp"
#include "tools/subprocess.hpp"

namespace vlbeam {
namespace {

constexpr const char* studies_help =
    "Folder studies/ with data, gates and scripts (default: beside the program, else where it was built)";

/// The folder of the studies; says so where it is not the one that came along with the program.
std::filesystem::path studies_folder(const std::string& given, const std::string& study) {
  const SourceFolder folder = find_source_folder("studies", given, study + "/gates.json");
  if (folder.of_the_build) {
    std::cerr << "vlbeam: studies are read from " << printable(folder.path.string())
              << ", which this program was built from; --studies names another folder\n";
  }
  return folder.path;
}

struct StudyArguments {
  std::string name;
  std::string profile = "full";
  std::string out;      ///< empty: reports, or build/reports-ci
  std::string studies;  ///< empty: the one beside the program, or it was built from
  int jobs = 0;         ///< 0: one a processor
  bool force = false;   ///< a study that failed may replace an earlier completed one
};

int carry_out(const StudyArguments& arguments) {
  const Study& study = find_study(arguments.name);
  const auto profile = from_string<Profile>(arguments.profile);
  if (!profile) throw InvalidInput("--profile", arguments.profile, "it must be ci or full");
  std::string out = arguments.out;
  if (out.empty()) out = *profile == Profile::full ? "reports" : "build/reports-ci";
  install_interrupt_handler();
  const StudyVerdict verdict = run_study(study, {.profile = *profile,
                                                 .out = out,
                                                 .sources = studies_folder(arguments.studies, study.name),
                                                 .jobs = jobs_or_processors(arguments.jobs),
                                                 .force = arguments.force,
                                                 .program = this_program});
  if (verdict.status == "interrupted") {
    std::cerr << "vlbeam: study " << study.name << " interrupted; nothing in " << printable(out)
              << " has changed; the same command goes on\n";
    return interrupted_exit_code();
  }
  std::cout << gates_text(study.name + " (" + arguments.profile + "): " + verdict.status, verdict.gates);
  if (verdict.status != "completed") {
    std::cerr << "vlbeam: study " << study.name << " " << verdict.status << ": "
              << printable(verdict.failure, Lines::several) << "\n  written to " << printable(verdict.report.string())
              << '\n';
    return computation_failed;
  }
  return all_passed(verdict.gates) ? done : gate_failed;
}

/// One run of a study, for the study's process: see KeptRuns.
int answer_kept_run(const std::string& folder) {
  const ThreadLimit alone(1);  // others run beside this one
  install_interrupt_handler();
  end_with_parent();
  write_text("-", answer_of_kept_run(folder, read_text("-"), StudyContext::until_interrupted()));
  return interrupted() ? interrupted_exit_code() : done;
}

struct GateArguments {
  std::vector<std::string> reports;  ///< empty: reports/<study>.json of every study
  std::string studies;               ///< as of StudyArguments
  bool update = false;               ///< the reports get the verdicts of now
};

int carry_out(const GateArguments& arguments) {
  std::vector<std::string> paths = arguments.reports;
  if (paths.empty()) {
    for (const Study& study : all_studies()) paths.push_back("reports/" + study.name + ".json");
  }
  const std::filesystem::path sources = studies_folder(arguments.studies, all_studies().front().name);
  std::vector<GateVerdict> all;
  std::string text;
  for (const std::string& path : paths) {
    Json report = read_json(path);
    const auto verdicts = naming_file(path, [&] { return judge_report(report, sources); });
    if (arguments.update) {
      report["gate_kinds"] = kinds_to_json(verdicts);
      report["gates"] = gates_to_json(verdicts);
      write_text(path, pretty(report));
    }
    text += gates_text(printable(path), verdicts);
    all.insert(all.end(), verdicts.begin(), verdicts.end());
  }
  const auto failed = std::ranges::count_if(all, [](const GateVerdict& verdict) { return !verdict.passed; });
  std::cout << text << "All reports: " << all.size() << " gates evaluated, " << failed << " failed: " << kinds_text(all)
            << '\n';
  return failed == 0 ? done : gate_failed;
}

struct ClaimsArguments {
  std::string reports = "reports";
  std::string studies;  ///< as of StudyArguments
  bool write = false;   ///< the documents get the numbers of the reports
};

int carry_out(const ClaimsArguments& arguments) {
  namespace fs = std::filesystem;
  const fs::path sources = studies_folder(arguments.studies, all_studies().front().name);
  std::vector<fs::path> files;
  for (const char* const name : {"claims.json", "papers.claims.json"}) {  // of documents of several studies
    if (fs::exists(sources / name)) files.push_back(sources / name);
  }
  for (const Study& study : all_studies()) {
    if (const fs::path file = sources / study.name / "claims.json"; fs::exists(file)) files.push_back(file);
  }
  ReportFolder reports(arguments.reports);
  std::size_t numbers = 0, failures = 0;
  for (const fs::path& file : files) {
    const Json claims = read_json(file);
    const fs::path document = file.parent_path() / claims.value("document", "README.md");
    const std::string text = read_text(document);
    const ClaimsVerdict verdict = naming_file(file, [&] { return check_claims(claims, text, reports); });
    for (const std::string& failure : verdict.failures) {
      std::cout << printable(document.lexically_normal().string()) << ": " << printable(failure) << '\n';
    }
    numbers += verdict.numbers;
    failures += verdict.failures.size();
    if (!arguments.write) continue;
    if (verdict.document != text) write_text(document, verdict.document);
    if (const std::string anew = claims_text(verdict.claims); anew != read_text(file)) write_text(file, anew);
  }
  std::cout << "Documents: " << numbers << " numbers compared with reports, " << failures << " differences"
            << (arguments.write && failures > 0 ? "; numbers written anew, read what stands around them" : "") << '\n';
  return failures == 0 ? done : gate_failed;
}

}  // namespace

Command study_command() {
  return {.name = "study",
          .help = "Run a study and write its report, tables and figures",
          .options = [](CLI::App& app) -> std::function<int()> {
            const auto arguments = std::make_shared<StudyArguments>();
            app.add_option("name", arguments->name, "Name of the study, see list")->required();
            app.add_option("--profile", arguments->profile, "full, or ci for the small one")->capture_default_str();
            app.add_option("--out", arguments->out, "Folder to write to (default: reports, with ci build/reports-ci)");
            app.add_option("--jobs,-j", arguments->jobs, "Runs at a time (default: one a processor)")
                ->check(CLI::NonNegativeNumber);
            app.add_flag("--force", arguments->force, "A study that fails may replace an earlier report");
            app.add_option("--studies", arguments->studies, studies_help);
            return [arguments] { return carry_out(*arguments); };
          },
          .examples =
              "  vlbeam study falling_beam                                 as its figures in reports/ are made\n"
              "  vlbeam study falling_beam --profile ci                    the small one\n"};
}

Command kept_run_command() {
  return {.name = "kept-run",
          .help = "",
          .options = [](CLI::App& app) -> std::function<int()> {
            const auto folder = std::make_shared<std::string>();
            app.add_option("folder", *folder, "")->required();
            return [folder] { return answer_kept_run(*folder); };
          },
          .examples = {}};
}

Command gate_command() {
  return {.name = "gate",
          .help = "Judge reports of studies by their gates",
          .options = [](CLI::App& app) -> std::function<int()> {
            const auto arguments = std::make_shared<GateArguments>();
            app.add_option("reports", arguments->reports, "Report files (default: reports/NAME.json of every study)");
            app.add_flag("--update", arguments->update, "Write the verdicts into the reports");
            app.add_option("--studies", arguments->studies, studies_help);
            return [arguments] { return carry_out(*arguments); };
          },
          .examples = "  vlbeam gate                                               the reports in reports/\n"};
}

Command claims_command() {
  return {.name = "claims",
          .help = "Compare the numbers in the READMEs with the reports",
          .options = [](CLI::App& app) -> std::function<int()> {
            const auto arguments = std::make_shared<ClaimsArguments>();
            app.add_option("--reports", arguments->reports, "Folder of the reports")->capture_default_str();
            app.add_flag("--write", arguments->write, "Write the reports' numbers into the READMEs");
            app.add_option("--studies", arguments->studies, studies_help);
            return [arguments] { return carry_out(*arguments); };
          },
          .examples = "  vlbeam claims\n"};
}

}  // namespace vlbeam
