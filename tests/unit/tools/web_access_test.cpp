// Who may ask the web panel, by what name, and with which token.
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/support/reference_design.hpp"
#include "tools/batch/tip_radius.hpp"
#include "tools/web/design_json.hpp"
#include "tools/web/json_text.hpp"
#include "tools/web/web_access.hpp"

namespace bladefit {
namespace {

TEST(WebAccess, AHostIsNamedByItsOwnAddressAndPort) {
  EXPECT_TRUE(is_own_host("127.0.0.1:8080", "127.0.0.1", 8080));
  EXPECT_TRUE(is_own_host("localhost:8080", "127.0.0.1", 8080));
  EXPECT_TRUE(is_own_host("[::1]:8080", "::1", 8080));
  EXPECT_TRUE(is_own_host("192.168.0.7:80", "192.168.0.7", 80));
  EXPECT_TRUE(is_own_host("192.168.0.7", "192.168.0.7", 80));
  EXPECT_TRUE(is_own_host("192.168.0.7:8080", "0.0.0.0", 8080));
  EXPECT_TRUE(is_own_host("[fe80::1]:8080", "::", 8080));
  for (const char* const other : {"", "rebound.example:8080", "127.0.0.1:8081", "127.0.0.1", "127.0.0.1:8080:8080",
                                  "192.168.0.8:8080", "localhost.example:8080", "0:8080"})
    EXPECT_FALSE(is_own_host(other, "127.0.0.1", 8080)) << other;
  EXPECT_FALSE(is_own_host("localhost:8080", "192.168.0.7", 8080));
  EXPECT_FALSE(is_own_host("rebound.example:8080", "0.0.0.0", 8080));
}

TEST(WebAccess, ASecretIsTheSameInFullOnly) {
  const std::string secret = "0123456789abcdef";
  EXPECT_TRUE(same_secret(secret, secret));
  EXPECT_FALSE(same_secret(secret + secret, secret));
  EXPECT_FALSE(same_secret("", secret));
  EXPECT_FALSE(same_secret("", ""));
  EXPECT_FALSE(same_secret(secret.substr(1), secret));
  for (std::size_t k = 0; k < secret.size(); ++k) {
    std::string other = secret;
    other[k] = '#';
    EXPECT_FALSE(same_secret(other, secret)) << k;
  }
}

TEST(WebAccess, WrongTokensAreCounted) {
  TokenGuard guard("0123456789abcdef");
  EXPECT_EQ(guard.check("Bearer 0123456789abcdef"), TokenGuard::Answer::accepted);
  EXPECT_EQ(guard.check("0123456789abcdef"), TokenGuard::Answer::refused);
  for (int k = 1; k < TokenGuard::kMostWrong; ++k) EXPECT_EQ(guard.check("Bearer x"), TokenGuard::Answer::refused);
  EXPECT_EQ(guard.check("Bearer 0123456789abcdef"), TokenGuard::Answer::too_many);
  TokenGuard without("");
  EXPECT_EQ(without.check("Bearer "), TokenGuard::Answer::no_commands);
}

TEST(WebJson, TextsComeBackAsTheyWere) {
  for (const std::string text : {"plain", "a \"quoted\" back\\slash", "line\nand\ttab", "\x01", "µm"})
    EXPECT_EQ(nlohmann::json::parse(json_text(text)), text);
  EXPECT_EQ(json_number(0.25), "0.25");
  EXPECT_EQ(json_number(std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(json_list(std::array{1.0, 2.5}, json_number), "[1,2.5]");
}

TEST(WebDesign, HoldsTheFacesAndTheZoneOfTheLeadingEdge) {
  const Surface& surface = testing::reference_design("dtmb4119").surface();
  ToleranceMap map;
  map.boxes[map.box_count++] = {0, 0.4, 0.6, 0, 1};
  const ShaftAxis axis;
  const double tip = tip_radius_of(surface, axis);
  const nlohmann::json told = nlohmann::json::parse(design_json(surface, map, axis, tip, "blade \"1\""));
  EXPECT_EQ(told.at("name"), "blade \"1\"");
  EXPECT_NEAR(told.at("tip").get<double>(), tip, 1e-4);
  ASSERT_EQ(told.at("faces").size(), 1U);
  ASSERT_EQ(told.at("zones").size(), 1U);
  const nlohmann::json& face = told.at("faces")[0];
  const std::size_t points = face.at("rows").get<std::size_t>() * face.at("columns").get<std::size_t>();
  // Base 64 holds three bytes in four letters.
  constexpr std::size_t kBytesOfPlace = 12;
  EXPECT_EQ(face.at("places").get<std::string>().size(), (points * kBytesOfPlace + 2) / 3 * 4);
  EXPECT_EQ(face.at("inside").get<std::string>().size(), (points + 2) / 3 * 4);
}

}  // namespace
}  // namespace bladefit
