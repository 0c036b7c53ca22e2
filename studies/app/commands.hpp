#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tools/diagram.hpp"

namespace vlbeam {

/// What the program answers to its caller; where it was asked to stop, interrupted_exit_code().
enum ExitCode {
  done = 0,
  gate_failed = 1,
  bad_input = 2,
  computation_failed = 3,
};

struct RunArguments {
  std::string scene;                  ///< "-" is standard input
  std::optional<std::string> report;  ///< "-" is standard output
  std::optional<std::string> csv;
  std::string shape;                ///< points along the axis; empty for none
  std::string vtk;                  ///< folder of a ParaView series; empty for none
  std::string checkpoint, restart;  ///< files to go on from, to be written and to be read; empty for none
  std::optional<double> every;      ///< [s] between checkpoints; without it there is one of a run that is interrupted
  int points = 8;                   ///< intervals an element of these
  int frames = 0;                   ///< shapes to keep besides those of the scene, evenly in time
  int threads = 0;                  ///< at work on a long beam; 0: one a processor, four at most
  std::optional<bool> check;        ///< run companions that tell its error; else where the integrator is automatic
  bool extremes = false;            ///< of all quantities over all steps, whatever the scene says
  bool force = false;               ///< a run that did not end well may replace an earlier result
  bool quiet = false;               ///< no summary on standard error
};

struct StudyArguments {
  std::string name;
  std::string profile = "full";
  std::string out;      ///< empty: reports, or build/reports-ci
  std::string studies;  ///< empty: the one beside the program, or it was built from
  int jobs = 0;         ///< 0: one a processor
  bool force = false;   ///< a study that failed may replace an earlier completed one
};

struct GateArguments {
  std::vector<std::string> reports;  ///< empty: reports/<study>.json of every study
  std::string studies;               ///< as of StudyArguments
  bool update = false;               ///< the reports get the verdicts of now
};

struct ClaimsArguments {
  std::string reports = "reports";
  std::string studies;  ///< as of StudyArguments
  bool write = false;   ///< the documents get the numbers of the reports
};

struct ConvergeArguments {
  std::string scene;  ///< "-" is standard input
  std::string quantity;
  double error = 0;
  bool relative = false;
  std::optional<double> at;
  bool horizon = false;
  std::string report, csv, figure;                         ///< empty for none; "-" is standard output
  int jobs = 0;                                            ///< 0: one a processor
  double limit = std::numeric_limits<double>::infinity();  ///< wall time [s]
  bool quiet = false;                                      ///< nothing while it computes
};

struct ImportArguments {
  std::string format, file;  ///< "-" is standard input
  std::string out = "-";     ///< "-" is standard output
};

struct InfluenceArguments {
  std::string scene;                    ///< "-" is standard input
  std::vector<std::string> quantities;  ///< at least one
  std::optional<double> force;          ///< [N]
  std::vector<double> direction;        ///< empty: along gravity
  int intervals = 1;                    ///< an element
  std::string csv, figure;              ///< empty for none; "-" is standard output
  int jobs = 0;                         ///< 0: one a processor
};

struct SweepArguments {
  std::string sweep;
  std::string out;          ///< empty: the sweep's name without .json
  int jobs = 0;             ///< processes at a time; 0: one a processor
  std::optional<int> only;  ///< the one case to run, by its number
  bool collect = false;     ///< only join what is there
  bool force = false;       ///< another sweep in the folder may be lost
  double memory = 0;        ///< each case may take [MB]; 0: as much as there is
};

struct CompareArguments {
  std::string a, b;           ///< reports of runs
  std::optional<double> tol;  ///< [m]
  std::string report;         ///< empty for none; "-" is standard output
};

struct ScoreArguments {
  std::string name;  ///< of the case, or a folder of trajectories; empty to list the cases
  std::string csv;   ///< empty for a folder
  std::string kit;   ///< folder to write scenes and answers into; empty for none
  std::vector<std::string> columns;  ///< "ours=theirs"
  std::string report;                ///< as of CompareArguments
  std::string references;            ///< empty: the folder beside the program, or it was built from
};

struct PlotArguments {
  std::string report;
  std::string what;                     ///< empty: the shapes, or the quantities
  std::vector<std::string> quantities;  ///< against time
  std::string figure;
  Look look;
};

struct SchemaArguments {
  std::string of;
  std::string part;   ///< JSON pointer; empty: all of it
  bool text = false;  ///< to read, in place of JSON
};

/// The commands of the program; each returns its exit code. They throw InvalidInput for what is not understood, before
/// any file is written.
int run_command(const RunArguments& arguments);
int study_command(const StudyArguments& arguments);
/// One run of a study, for the study's process: see KeptRuns.
int kept_run_command(const std::string& folder);
int gate_command(const GateArguments& arguments);
int claims_command(const ClaimsArguments& arguments);
int list_command(bool names_only, const std::string& scenes);
int scene_command(const std::string& name, const std::string& scenes);
int converge_command(const ConvergeArguments& arguments);
int import_command(const ImportArguments& arguments);
int influence_command(const InfluenceArguments& arguments);
int sweep_command(const SweepArguments& arguments);
int compare_command(const CompareArguments& arguments);
int score_command(const ScoreArguments& arguments);
int plot_command(const PlotArguments& arguments);
int schema_command(const SchemaArguments& arguments);

}  // namespace vlbeam
