#include "io/json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace vlbeam {
namespace {

std::string message_of(std::string_view text) {
  try {
    parse_json(text);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Json, RefusesAKeyThatStandsTwice) {
  EXPECT_THAT(message_of(R"({"a": 1, "a": 2})"), testing::StartsWith("/a: a second key"));
  EXPECT_THAT(message_of(R"({"b": [0, {"c/d": 1, "c/d": 2}]})"), testing::StartsWith("/b/1/c~1d: a second key"));
  EXPECT_THAT(message_of(R"([[], {"x": {"a": {}, "a": 2}}])"), testing::StartsWith("/1/x/a: a second key"));
  EXPECT_NO_THROW(parse_json(R"({"a": {"a": 1}, "b": [{"a": 1}, {"a": 2}]})"));
}

TEST(Json, SaysWhereATextIsNoJson) {
  EXPECT_THAT(message_of("{\n  \"a\": NaN\n}"), testing::StartsWith("line 2, column 8: \"NaN\" is not allowed"));
  EXPECT_THAT(message_of("[1e999]"),
              testing::StartsWith("line 1, column 2: \"1e999\" is not allowed; it must be within"));
  EXPECT_THAT(message_of("{\"a\": 1"), testing::StartsWith("line 1, column 8: the end of the text"));
  EXPECT_THAT(message_of(""), testing::StartsWith("line 1, column 1: the end of the text"));
}

TEST(Json, ReadsWhatTheParserReads) {
  const char* text = R"({"z": [1, -2, 3.5, 18446744073709551615, true, null, "\u00b5"], "a": {"b": {}, "c": []}})";
  EXPECT_EQ(parse_json(text), Json::parse(text));
}

TEST(Json, RefusesWhatIsTooDeepToFollow) {
  const std::string deep(100000, '[');
  EXPECT_THAT(message_of(deep), testing::HasSubstr("nested more than 100 deep"));
  const std::string allowed = std::string(100, '[') + std::string(100, ']');
  EXPECT_NO_THROW(parse_json(allowed));
}

TEST(Json, PrettyTextReadsBackToTheLastDigit) {
  const Json value = {{"z", 0.1 + 0.2},      {"a", {1, 2, 3}},           {"o", {{"x", 1e-300}}},
                      {"e", Json::object()}, {"rows", {{1, 2}, {3, 4}}}, {"text", "µ\"\n"}};
  EXPECT_EQ(parse_json(pretty(value)), value);
  EXPECT_EQ(pretty({{"z", {1, 2}}, {"a", {{"b", 0.1}}}}), "{\n  \"z\": [1,2],\n  \"a\": {\n    \"b\": 0.1\n  }\n}\n");
}

TEST(Json, WhatIsNoNumberBecomesNull) {
  EXPECT_EQ(pretty(std::numeric_limits<double>::quiet_NaN()), "null\n");
  EXPECT_EQ(pretty(std::numeric_limits<double>::infinity()), "null\n");
}

TEST(Json, LongValuesAreCutInMessages) {
  EXPECT_LT(excerpt(std::string(1000, 'x')).size(), 80U);
  EXPECT_LT(excerpt(Json(std::vector<int>(1000, 7))).size(), 80U);
  std::string letters = "x";
  for (int i = 0; i < 100; ++i) letters += "\xc2\xb5";
  EXPECT_EQ(excerpt(letters).find("\xc2..."), std::string::npos) << "not within a letter";
  EXPECT_EQ(excerpt({{"a", {1, "b"}}}), R"({"a":[1,"b"]})");
}

}  // namespace
}  // namespace vlbeam
