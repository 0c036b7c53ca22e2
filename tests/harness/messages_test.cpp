#include "io/messages.hpp"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

namespace vlbeam {
namespace {

TEST(Messages, ControlCharactersDoNothing) {
  EXPECT_EQ(printable("a\x1b[31mred\r\n\t\x7f"), "a\\u001b[31mred\\u000d\\u000a\\u0009\\u007f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\u009b31m")
      << "the other way to write an escape sequence";
  EXPECT_EQ(printable("\xc2\xb5m, \xe6\xa2\x81"), "\xc2\xb5m, \xe6\xa2\x81") << "letters stay";
  EXPECT_EQ(printable("a\nb\r", Lines::several), "a\nb\\u000d");
}

TEST(Messages, WhatUsedUpMemoryMeansIsSaid) {
  EXPECT_NE(explained(std::bad_alloc()).find("out of memory"), std::string::npos);
  EXPECT_EQ(explained(std::runtime_error("broke down")), "broke down");
}

}  // namespace
}  // namespace vlbeam
