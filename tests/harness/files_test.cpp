#include "studies/harness/files.hpp"

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

TEST(Files, WhatCannotBeReadIsBadInput) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_text(folder / "missing.json"), InvalidInput);
  EXPECT_THROW(read_text(folder.path()), InvalidInput);
}

}  // namespace
}  // namespace vlbeam
