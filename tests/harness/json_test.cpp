#include "studies/harness/json.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.hpp"

namespace vlbeam {
namespace {

TEST(Json, RefusesAKeyThatStandsTwice) {
  EXPECT_THROW(parse_json(R"({"a": 1, "a": 2})"), InvalidInput);
  EXPECT_THROW(parse_json(R"({"b": [{"a": 1, "a": 2}]})"), InvalidInput);
  EXPECT_NO_THROW(parse_json(R"({"a": {"a": 1}, "b": [{"a": 1}, {"a": 2}]})"));
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

TEST(Json, LongValuesAreCutInMessages) { EXPECT_LT(excerpt(std::string(1000, 'x')).size(), 80U); }

}  // namespace
}  // namespace vlbeam
