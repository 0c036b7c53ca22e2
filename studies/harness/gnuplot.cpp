#include "studies/harness/gnuplot.hpp"

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include "studies/harness/subprocess.hpp"

namespace vlbeam {
namespace {

/// A gnuplot string literal; in single quotes only the quote itself is special, and is doubled.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

bool ends_as_svg(const std::filesystem::path& file) {
  constexpr std::string_view end = "</svg>";
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const auto last = text.find_last_not_of(" \n");
  return last != std::string::npos && std::string_view(text).substr(0, last + 1).ends_with(end);
}

}  // namespace

void draw_figure(const std::filesystem::path& script, const std::filesystem::path& figure, GnuplotVariables variables) {
  namespace fs = std::filesystem;
  if (figure.has_parent_path()) fs::create_directories(figure.parent_path());
  fs::path temporary = figure;
  temporary += "." + std::to_string(::getpid()) + ".part";

  variables["output"] = temporary.string();
  std::string assignments;
  for (const auto& [name, value] : variables) assignments += name + " = " + quoted(value) + "; ";
  const ProcessResult gnuplot = run_process({"gnuplot", "-e", assignments, script.string()});

  std::error_code error;
  const bool drawn = ends_as_svg(temporary);  // gnuplot's exit code tells nothing of a full disk
  // gnuplot takes a missing or empty data file for a warning.
  const bool skipped = gnuplot.error.find("Skipping data file") != std::string::npos;
  if (gnuplot.exit_code != 0 || !drawn || skipped) {
    fs::remove(temporary, error);
    throw std::runtime_error("gnuplot could not draw " + figure.string() + " from " + script.string() + ":\n" +
                             gnuplot.error);
  }
  fs::rename(temporary, figure);
}

}  // namespace vlbeam
