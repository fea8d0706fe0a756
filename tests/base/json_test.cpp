#include "core/base/json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace zerodrift {
namespace {

Status read(const char* text, std::vector<std::string>& warnings, const std::function<void(JsonObject&)>& reader) {
  const auto document = parse_json(text, "a.json");
  if (!document) return fail(document.error());
  return read_object(*document, "a.json", &warnings, reader);
}

}  // namespace

TEST(Json, SyntaxErrorNamesLineAndColumn) {
  const auto document = parse_json("{\n  \"a\": 1,\n  \"b\" 2\n}", "a.json");
  ASSERT_FALSE(document.has_value());
  EXPECT_EQ(document.error().code, ErrorCode::json_syntax);
  EXPECT_EQ(document.error().context.at("line"), "3");
}

// A damaged file may hold a whole picture in one value.
TEST(Json, OnlyTheBeginningOfALongValueIsShown) {
  const std::string picture(2000, 'A');
  const auto open = parse_json("{\"picture\": \"" + picture, "a.json");
  ASSERT_FALSE(open);
  EXPECT_LT(open.error().context.at("detail").size(), 200U);
  EXPECT_NE(open.error().context.at("detail").find("AAA...'"), std::string::npos);
  std::vector<std::string> warnings;
  const auto word = read(("{\"a\": \"" + picture + "\"}").c_str(), warnings, [](JsonObject& o) {
    o.word("a", {"yes", "no"});
  });
  ASSERT_FALSE(word);
  EXPECT_EQ(word.error().context.at("found"), std::string(57, 'A') + "...");
  EXPECT_EQ(shortened(std::string(58, 'A') + "\u00b5m"), std::string(57, 'A') + "...");
  EXPECT_EQ(shortened(std::string(56, 'A') + "\u00b5mmmm"), std::string(56, 'A') + "...");
}

TEST(Json, MissingKeyNamesItsPath) {
  std::vector<std::string> warnings;
  const auto status = read(R"({"steps": [{"a": 1}]})", warnings, [](JsonObject& o) {
    for (auto& step : o.objects("steps")) step.number("duration_s", positive);
  });
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error().code, ErrorCode::json_missing_key);
  EXPECT_EQ(status.error().context.at("key"), "steps[0].duration_s");
  EXPECT_EQ(status.error().context.at("expected"), "a number above 0");
}

TEST(Json, OutOfRangeAndWrongTypeAreErrors) {
  std::vector<std::string> warnings;
  EXPECT_FALSE(read(R"({"a": -1})", warnings, [](JsonObject& o) { o.number("a", positive); }).has_value());
  EXPECT_FALSE(read(R"({"a": "1"})", warnings, [](JsonObject& o) { o.number("a"); }).has_value());
  EXPECT_FALSE(read(R"({"a": 1.5})", warnings, [](JsonObject& o) { o.integer("a", 0, 9); }).has_value());
  EXPECT_FALSE(read(R"([1])", warnings, [](JsonObject&) {}).has_value());
}

TEST(Json, UnknownKeysWarnAtEveryDepth) {
  std::vector<std::string> warnings;
  ASSERT_TRUE(read(R"({"a": 1, "zz": 2, "o": {"yy": 3}})", warnings, [](JsonObject& o) {
                o.number("a");
                o.object("o");
              }).has_value());
  EXPECT_EQ(warnings.size(), 2U);
}

// Walking through a document that is deep enough would end the stack.
TEST(Json, BracketsWithinBracketsHaveAnEnd) {
  const std::string deep = "{\"a\":\n" + std::string(100000, '[') + std::string(100000, ']') + "}";
  const auto refused = parse_json(deep, "deep.json");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::json_syntax);
  EXPECT_EQ(refused.error().context.at("line"), "2");
  EXPECT_TRUE(parse_json("{\"a\": \"" + std::string(1000, '[') + "\\\"\"}", "text.json"));
  EXPECT_TRUE(parse_json(std::string(150, '[') + std::string(150, ']'), "fits.json"));
}

}  // namespace zerodrift
