#include "tools/gnuplot.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/files.hpp"
#include "tools/subprocess.hpp"

namespace vlbeam {
namespace {

/// A gnuplot string literal; in single quotes only the quote itself is special, and is doubled.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

/// Whether a figure ends as a whole one of its format does.
bool is_whole(const std::filesystem::path& file, const std::string& format) {
  using namespace std::string_view_literals;
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (format == ".png") return text.ends_with("IEND\xae\x42\x60\x82"sv);
  if (format == ".pdf")
    return text.starts_with("%PDF"sv) &&
           text.find("%%EOF"sv, text.size() - std::min<std::size_t>(text.size(), 32)) != std::string::npos;
  if (format == ".gif") return text.starts_with("GIF"sv) && text.ends_with(";"sv);
  const auto last = text.find_last_not_of(" \n");
  return last != std::string::npos && std::string_view(text).substr(0, last + 1).ends_with("</svg>"sv);
}

/// A folder that is there as long as this is.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "vlbeam-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder like " + name);
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

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
  const bool drawn =
      is_whole(temporary, figure.extension().string());  // gnuplot's exit code tells nothing of a full disk
  // gnuplot takes a missing or empty data file for a warning.
  const bool skipped = gnuplot.error.find("Skipping data file") != std::string::npos;
  if (gnuplot.exit_code != 0 || !drawn || skipped) {
    fs::remove(temporary, error);
    throw std::runtime_error("gnuplot could not draw " + figure.string() + " from " + script.string() + ":\n" +
                             gnuplot.error);
  }
  fs::rename(temporary, figure);
}

void draw_figure_of(const std::string& script, const std::string& data, const std::filesystem::path& figure,
                    GnuplotVariables variables) {
  const ScratchFolder folder;
  write_text(folder.path() / "figure.gp", script);
  write_text(folder.path() / "data", data);
  variables["data"] = (folder.path() / "data").string();
  draw_figure(folder.path() / "figure.gp", figure, std::move(variables));
}

void draw_film_of(const std::string& script, const std::string& data, const std::filesystem::path& film) {
  if (run_process({"ffmpeg", "-version"}).exit_code != 0) {
    throw InvalidInput("-o", "\"" + film.string() + "\"",
                       "an .mp4 takes ffmpeg, which is not installed (apt install ffmpeg); a .gif does without");
  }
  const ScratchFolder folder;
  const std::string frames = folder.path() / "frames.gif", made = folder.path() / "film.mp4";
  draw_figure_of(script, data, frames);
  // These pixels and the index in front are what browsers and slides play.
  const ProcessResult ffmpeg =
      run_process({"ffmpeg", "-v", "error", "-i", frames, "-pix_fmt", "yuv420p", "-movflags", "+faststart", made});
  if (ffmpeg.exit_code != 0) throw std::runtime_error("ffmpeg could not make " + film.string() + ":\n" + ffmpeg.error);
  write_text(film, read_text(made));
}

}  // namespace vlbeam
