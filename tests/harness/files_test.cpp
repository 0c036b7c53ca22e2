#include "io/files.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/error.hpp"
#include "tests/harness/temporary_folder.hpp"

namespace vlbeam {
namespace {

TEST(Files, WritesAndReadsBack) {
  const TemporaryFolder folder;
  write_text(folder / "a/b/report.json", "first");
  write_text(folder / "a/b/report.json", "second\n");
  EXPECT_EQ(read_text(folder / "a/b/report.json"), "second\n");
  EXPECT_EQ(folder.files(), (std::set<std::string>{"a/b/report.json"})) << "no temporary file stays behind";
}

TEST(Files, AFailedWriteLeavesNothingBehind) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "report.json");  // in the way: a folder is not replaced by a file
  EXPECT_THROW(write_text(folder / "report.json", "text"), std::runtime_error);
  EXPECT_TRUE(folder.files().empty());
}

TEST(Files, APartIsNothing) {
  const TemporaryFolder folder;
  write_text(folder / "report.json", "whole");
  EXPECT_THROW(write_file(folder / "report.json",
                          [](const TextSink& sink) {
                            sink("part");
                            throw std::runtime_error("and then?");
                          }),
               std::runtime_error);
  EXPECT_EQ(read_text(folder / "report.json"), "whole");
  EXPECT_EQ(folder.files(), (std::set<std::string>{"report.json"}));
}

TEST(Files, LinksAreFollowed) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("missing/target.json", folder / "link.json");
  EXPECT_NO_THROW(check_writable("--report", folder / "link.json"));
  write_text(folder / "link.json", "text");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.json"));
  EXPECT_EQ(read_text(folder / "missing/target.json"), "text");
  std::filesystem::create_symlink("loop", folder / "loop");
  EXPECT_THROW(check_writable("--report", folder / "loop"), InvalidInput);
}

TEST(Files, WhatCannotBeWrittenIsKnownBefore) {
  const TemporaryFolder folder;
  folder.write("file", "");
  for (const auto& path : {folder.path(), folder / "file/r.json", std::filesystem::path("/proc/none/r.json"),
                           folder / std::string(300, 'x'), std::filesystem::path()}) {
    EXPECT_THROW(check_writable("--report", path), InvalidInput) << path;
  }
  EXPECT_NO_THROW(check_writable("--report", folder / "a/b/r.json"));
  EXPECT_NO_THROW(check_writable("--report", "/dev/null"));
  EXPECT_NO_THROW(check_writable("--report", "-"));
  EXPECT_EQ(folder.files(), (std::set<std::string>{"file"})) << "to look leaves no trace";
}

TEST(Files, TellsWhetherTwoNamesAreOneFile) {
  const TemporaryFolder folder;
  folder.write("a", "");
  folder.write("b", "");
  std::filesystem::create_hard_link(folder / "a", folder / "hard");
  std::filesystem::create_symlink("a", folder / "soft");
  std::filesystem::create_symlink("c", folder / "dangling");
  EXPECT_TRUE(same_file(folder / "a", folder / "./a"));
  EXPECT_TRUE(same_file(folder / "a", folder / "hard"));
  EXPECT_TRUE(same_file(folder / "a", folder / "soft"));
  EXPECT_TRUE(same_file(folder / "c", folder / "dangling"));
  EXPECT_TRUE(same_file(folder / "c", folder / "d/../c"));
  EXPECT_FALSE(same_file(folder / "a", folder / "b"));
  EXPECT_FALSE(same_file(folder / "a", folder / "c"));
  EXPECT_FALSE(same_file("/dev/null", "/dev/null")) << "what is written there does not meet";
}

TEST(Files, WhatCannotBeReadIsBadInput) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_text(folder / "missing.json"), InvalidInput);
  EXPECT_THROW(read_text(folder.path()), InvalidInput);
}

}  // namespace
}  // namespace vlbeam
