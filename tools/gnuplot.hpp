#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace vlbeam {

/// Variables a gnuplot script finds set, all of them strings.
using GnuplotVariables = std::map<std::string, std::string>;

/// Runs a gnuplot script that draws one figure, an SVG, PNG, PDF or GIF by its name's ending; the script finds `output`
/// set to the file it must write, and chooses the terminal itself. The figure appears only once it is whole. Throws
/// std::runtime_error with gnuplot's words if gnuplot fails, skips data, or draws nothing.
void draw_figure(const std::filesystem::path& script, const std::filesystem::path& figure,
                 GnuplotVariables variables = {});

/// The same of a script and the data it draws, which are no files yet: it finds `data` set to the name of one.
void draw_figure_of(const std::string& script, const std::string& data, const std::filesystem::path& figure,
                    GnuplotVariables variables = {});

/// Makes a film (.mp4): runs a script that draws a GIF of `data`, and has ffmpeg convert it. Throws InvalidInput if
/// ffmpeg is not installed.
void draw_film_of(const std::string& script, const std::string& data, const std::filesystem::path& film);

}  // namespace vlbeam
