#include "tools/gnuplot.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "io/files.hpp"
#include "tests/harness/temporary_folder.hpp"
#include "tools/subprocess.hpp"

namespace vlbeam {
namespace {

constexpr const char* script = "set terminal svg\nset output output\nset datafile separator comma\nplot data\n";

TEST(Gnuplot, DrawsTheSameFigureTwice) {
  const TemporaryFolder folder;
  folder.write("plot.gp", script);
  folder.write("it's data.csv", "0,0\n1,1\n");
  const GnuplotVariables variables{{"data", folder / "it's data.csv"}};
  draw_figure(folder / "plot.gp", folder / "figures/a.svg", variables);
  draw_figure(folder / "plot.gp", folder / "figures/b.svg", variables);
  EXPECT_NE(read_text(folder / "figures/a.svg").find("</svg>"), std::string::npos);
  EXPECT_EQ(read_text(folder / "figures/a.svg"), read_text(folder / "figures/b.svg"));
  EXPECT_EQ(folder.files().size(), 4U) << "no temporary file stays behind";
}

TEST(Gnuplot, WhatGnuplotCannotDrawIsAnError) {
  const TemporaryFolder folder;
  folder.write("plot.gp", script);
  folder.write("broken.gp", "set output output\nplott x\n");
  folder.write("nothing.gp", "set terminal svg\n");
  folder.write("cut.gp", "set print output\nprint '<svg>'\n");
  EXPECT_THROW(draw_figure(folder / "plot.gp", folder / "a.svg", {{"data", folder / "missing.csv"}}),
               std::runtime_error);
  EXPECT_THROW(draw_figure(folder / "broken.gp", folder / "a.svg"), std::runtime_error);
  EXPECT_THROW(draw_figure(folder / "nothing.gp", folder / "a.svg"), std::runtime_error);
  EXPECT_THROW(draw_figure(folder / "cut.gp", folder / "a.svg"), std::runtime_error);
  EXPECT_THROW(draw_figure(folder / "missing.gp", folder / "a.svg"), std::runtime_error);
  EXPECT_EQ(folder.files().count("a.svg"), 0U);
}

TEST(Subprocess, GivesOutputErrorAndExitCode) {
  const ProcessResult result = run_process({"sh", "-c", "echo out; echo err >&2; exit 3"});
  EXPECT_EQ(result.output, "out\n");
  EXPECT_EQ(result.error, "err\n");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(run_process({"no-such-program-here"}).exit_code, 127);
}

}  // namespace
}  // namespace vlbeam
