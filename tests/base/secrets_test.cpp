#include "core/base/secrets.h"

#include <gtest/gtest.h>

namespace zerodrift {

TEST(Secrets, AddressesLoseNamesAndPasswords) {
  EXPECT_EQ(without_secrets("rtsp://admin:p@ss@10.0.0.5:554/live"), "rtsp://removed@10.0.0.5:554/live");
  EXPECT_EQ(without_secrets(R"({"url": "http://u:p@h/a.mjpg?x=1&token=abc&y=2", "b": 1})"),
            R"({"url": "http://removed@h/a.mjpg?x=1&token=removed&y=2", "b": 1})");
  EXPECT_EQ(without_secrets("see http://h/a@b and mail@host"), "see http://h/a@b and mail@host");
  EXPECT_EQ(without_secrets("cut off ://"), "cut off ://");
}

TEST(Secrets, KeysThatNameASecretLoseTheirValue) {
  EXPECT_EQ(without_secrets(R"({"password": "a\"b", "port": 502})"), R"({"password": "removed", "port": 502})");
  EXPECT_EQ(without_secrets(R"({"API-Key":12345,"x":1})"), R"({"API-Key":"removed","x":1})");
  EXPECT_EQ(without_secrets(R"({"camera_password":null})"), R"({"camera_password":null})");
  EXPECT_EQ(without_secrets(R"({"a": "password", "b": "token: x"})"), R"({"a": "password", "b": "token: x"})");
  EXPECT_EQ(without_secrets(R"({"tokens": ["a]", "b"], "x": 1})"), R"({"tokens": "removed", "x": 1})");
  EXPECT_EQ(without_secrets(R"({"credentials": {"user": "a", "pass": ["}"]}, "x": 1})"),
            R"({"credentials": "removed", "x": 1})");
  EXPECT_EQ(without_secrets("broken \"password"), "broken \"password");
}

TEST(Secrets, WithoutASecretNothingChanges) {
  const std::string text = R"({"T1_C": [1.0, -2.5e-3], "note": "µm \"quoted\"", "empty": {}})";
  EXPECT_EQ(without_secrets(text), text);
}

}  // namespace zerodrift
