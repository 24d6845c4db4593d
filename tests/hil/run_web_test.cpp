// A session with a web panel: what is told of it, what is pressed there, what is refused before it begins.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/hil/session.hpp"
#include "tests/support/http_client.hpp"

namespace bladefit::hil {
namespace {

using testing::http_ask;

std::string write_file(const std::string& path, const std::string& text) {
  std::ofstream(path) << text;
  return path;
}

nlohmann::json web_state(std::uint16_t port) {
  return nlohmann::json::parse(http_ask(port, "GET", "/api/state").body, nullptr, false);
}

TEST(RunWeb, ShowsThePointsOfASessionAndFollowsCommands) {
  const ScratchFolder scratch;
  write_file(scratch / "token", "a-token-of-this-test\n");
  const std::string config =
      write_file(scratch / "session.toml", "[panel]\nhttp = \"127.0.0.1:0\"\nhttp_token_file = \"token\"\n");
  SimulatedMachine machine(machine_options(Link::modbus_tcp, "0", kAllPoints, {"--rate", "400"}));
  Process run(run_options(source_of(Link::modbus_tcp, machine.address()), scratch / "session", scratch / "result.json",
                          std::vector<std::string>{"--config", config} + kUntilIdle));
  const std::optional<std::string> rest = run.wait_for("web panel at http://127.0.0.1:", 20s);
  if (!rest) {  // Without Node.js at the build there is no page to serve; then that is refused.
    ASSERT_EQ(run.exit_code(), 2) << run.out() << run.err();
    ASSERT_NE(run.err().find("panel.http 127.0.0.1:0: this program was built without the web panel"), std::string::npos)
        << run.err();
    return;
  }
  const auto port = static_cast<std::uint16_t>(std::stoi(*rest));
  EXPECT_TRUE(eventually([&] { return web_state(port).at("counts").at("points") > 50; }));
  const std::string token = "Authorization: Bearer a-token-of-this-test\r\n";
  ASSERT_EQ(http_ask(port, "POST", "/api/command", "stop", token).status, 200);
  EXPECT_TRUE(eventually([&] { return web_state(port).at("session") == "idle"; }));
  const auto points = web_state(port).at("counts").at("points").get<int>();
  EXPECT_EQ(web_state(port).at("counts").at("points"), points);
  ASSERT_EQ(http_ask(port, "POST", "/api/command", "start", token).status, 200);
  EXPECT_TRUE(eventually([&] { return web_state(port).at("counts").at("points") > points; }));
  ASSERT_EQ(http_ask(port, "POST", "/api/command", "reset", token).status, 200);
  EXPECT_TRUE(eventually([&] { return web_state(port).at("counts").at("points") < points; }));
  run.signal(SIGINT);
  EXPECT_TRUE(run.exit_code().has_value());
}

TEST(RunWeb, WhatIsWrongIsSaidBeforeTheSessionBegins) {
  const ScratchFolder scratch;
  const auto refusal = [&](const std::string& panel, const std::vector<std::string>& more = {}) {
    const std::string config = write_file(scratch / "session.toml", "[panel]\n" + panel);
    Process run(run_options("replay:" + kAllPoints, scratch / "session", scratch / "result.json",
                            std::vector<std::string>{"--config", config, "--headless"} + more));
    EXPECT_EQ(run.exit_code(), 2) << panel;
    return run.err();
  };
  const std::string nonsense = refusal("", {"--http", "nonsense"});
  EXPECT_NE(nonsense.find("--http nonsense: is not an address"), std::string::npos);
  EXPECT_NE(refusal("http = \"8080\"\n").find("panel.http 8080: is not an address"), std::string::npos);
  EXPECT_NE(refusal("http = \"127.0.0.1:0\"\nhttp_token_file = \"none\"\n").find("cannot be read"), std::string::npos);
  write_file(scratch / "short", "secret\n");
  EXPECT_NE(refusal("http = \"127.0.0.1:0\"\nhttp_token_file = \"short\"\n").find("16 characters"), std::string::npos);
}

}  // namespace
}  // namespace bladefit::hil
