// Secrets do not get out of the program, whatever the URL looks like.

#include "core/base/redact.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace zerodrift {

TEST(Redact, TakesThePasswordAndLeavesTheRest) {
  const std::pair<const char*, const char*> cases[] = {
      {"http://cam:8080/stream", "http://cam:8080/stream"},
      {"http://ann:s3cret@cam:8080/stream", "http://ann:***@cam:8080/stream"},
      {"http://ann@cam/stream", "http://ann@cam/stream"},
      {"rtsp://ann:s3c/ret@cam/1", "rtsp://ann:***@cam/1"},
      {"rtsp://ann:s3c@ret@cam/1", "rtsp://ann:***@cam/1"},
      {"http://ann:s3c:ret@cam/1", "http://ann:***@cam/1"},
      {"http://cam/v?user=ann&Password=s3cret&size=2", "http://cam/v?user=ann&Password=***&size=2"},
      {"http://cam/v?token=s3cret", "http://cam/v?token=***"},
      {"http://cam/v?key=s3cret#top", "http://cam/v?key=***#top"},
      {"http://ann:s3cret?x@cam/1", "http://ann:***@cam/1"},
      {"at http://a:s3cret@b/ and http://c:s3cret@d/.", "at http://a:***@b/ and http://c:***@d/."},
      {"no address at all: a:b@c", "no address at all: a:b@c"},
      {"://", "://"},
      {"", ""}};
  for (const auto& [given, expected] : cases) EXPECT_EQ(without_secrets(given), expected);
}

TEST(Redact, DocumentsAtEveryDepth) {
  const nlohmann::json document = {{"cameras", {{{"url", "http://a:s3cret@b/"}, {"password", "s3cret"}, {"width", 3}}}},
                                   {"key", "X"},
                                   {"pin", "PA7"}};
  const auto clean = document_without_secrets(document);
  EXPECT_EQ(clean.dump().find("s3cret"), std::string::npos);
  EXPECT_EQ(clean["cameras"][0]["width"], 3);
  EXPECT_EQ(clean["key"], "X");
  EXPECT_EQ(clean["pin"], "PA7");
  EXPECT_TRUE(lacks_secret(clean["cameras"][0]["url"].get<std::string>()));
}

TEST(Redact, AddressesInDocuments) {
  EXPECT_EQ(without_secrets("rtsp://admin:p@ss@10.0.0.5:554/live"), "rtsp://admin:***@10.0.0.5:554/live");
  EXPECT_EQ(without_secrets(R"({"url": "http://u:p@h/a.mjpg?x=1&token=abc&y=2", "b": 1})"),
            R"({"url": "http://u:***@h/a.mjpg?x=1&token=***&y=2", "b": 1})");
  EXPECT_EQ(without_secrets("see http://h/a@b and mail@host"), "see http://h/a@b and mail@host");
  EXPECT_EQ(without_secrets("cut off ://"), "cut off ://");
}

TEST(Redact, KeysThatNameASecretLoseTheirValue) {
  EXPECT_EQ(without_secrets(R"({"password": "a\"b", "port": 502})"), R"({"password": "***", "port": 502})");
  EXPECT_EQ(without_secrets(R"({"API-Key":12345,"x":1})"), R"({"API-Key":"***","x":1})");
  EXPECT_EQ(without_secrets(R"({"camera_password":null})"), R"({"camera_password":null})");
  EXPECT_EQ(without_secrets(R"({"a": "password", "b": "token: x"})"), R"({"a": "password", "b": "token: x"})");
  EXPECT_EQ(without_secrets(R"({"tokens": ["a]", "b"], "x": 1})"), R"({"tokens": "***", "x": 1})");
  EXPECT_EQ(without_secrets(R"({"credentials": {"user": "a", "pass": ["}"]}, "x": 1})"),
            R"({"credentials": "***", "x": 1})");
  EXPECT_EQ(without_secrets("broken \"password"), "broken \"password");
}

TEST(Redact, WithoutASecretNothingChanges) {
  const std::string text = R"({"T1_C": [1.0, -2.5e-3], "note": "µm \"quoted\"", "empty": {}})";
  EXPECT_EQ(without_secrets(text), text);
}

}  // namespace zerodrift
