// The server of the web panel over real sockets: what it tells, whom it refuses, what clients may use of it.
#include <gtest/gtest.h>

#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/support/http_client.hpp"
#include "tests/support/panel_state.hpp"
#include "tests/support/process.hpp"
#include "tools/web/web_panel.hpp"

namespace bladefit {
namespace {

using testing::http_ask;
using testing::HttpAnswer;
using testing::HttpConnection;
using namespace std::chrono_literals;
using WebJson = nlohmann::json;

const std::string kTestToken = "0123456789abcdef";

std::string bearer(const std::string& token) { return "Authorization: Bearer " + token + "\r\n"; }

Verdict shown_point(std::uint32_t sequence, double distance) {
  Verdict made;
  made.sequence = sequence;
  made.state = PointState::out;
  made.action = Action::cut;
  made.region = Region::leading_edge;
  made.tolerance_mm = 0.15;
  made.foot.distance = distance;
  made.foot.point = Vec3(1, 2, 3);
  made.foot.normal = Vec3::UnitZ();
  return made;
}

/// A panel of a session that is made up.
class WebPanelTest : public ::testing::Test {
 protected:
  void SetUp() override { open(kTestToken); }

  void open(const std::string& token, const std::vector<std::string>& allow = {}) {
    panel = std::make_unique<WebPanel>();
    const Failure failure = panel->open({.host = "127.0.0.1", .port = 0, .token = token, .allow = allow},
                                        {.state =
                                             [this] {
                                               const std::lock_guard lock(mutex);
                                               return state;
                                             },
                                         .feed = &feed,
                                         .press =
                                             [this](const PanelCommands& commands) {
                                               const std::lock_guard lock(mutex);
                                               pressed.push_back(commands);
                                             },
                                         .design = R"({"name":"made up"})"});
    ASSERT_FALSE(failure) << failure.message;
  }

  [[nodiscard]] std::uint16_t port() const { return panel->port(); }

  /// A request for events that has been answered.
  [[nodiscard]] std::unique_ptr<HttpConnection> watcher(const std::string& from = "") const {
    auto connection = std::make_unique<HttpConnection>(port());
    connection->send("GET /api/events?from=" + from + " HTTP/1.1\r\nHost: localhost:" + std::to_string(port()) +
                     "\r\n\r\n");
    return connection;
  }

  std::mutex mutex;
  PanelState state = testing::known_state();
  PointFeed feed;
  std::vector<PanelCommands> pressed;
  std::unique_ptr<WebPanel> panel;
};

TEST_F(WebPanelTest, ServesThePageUnderAPolicyThatAllowsItsOwnFilesOnly) {
  const HttpAnswer page = http_ask(port(), "GET", "/");
  const int files = WebPanel::has_page() ? 200 : 404;  // without Node.js at the build there are none
  EXPECT_EQ(page.status, files);
  EXPECT_EQ(page.head.find("Content-Encoding: gzip") != std::string::npos, WebPanel::has_page());
  EXPECT_NE(page.head.find("default-src 'none'; script-src 'self'; style-src 'self'"), std::string::npos);
  EXPECT_EQ(page.head.find("unsafe"), std::string::npos);
  EXPECT_EQ(http_ask(port(), "GET", "/page.js").status, files);
  EXPECT_EQ(http_ask(port(), "GET", "/page.css").status, files);
  EXPECT_EQ(http_ask(port(), "GET", "/../etc/passwd").status, 404);
  EXPECT_EQ(http_ask(port(), "GET", "/api/design").body, R"({"name":"made up"})");
}

TEST_F(WebPanelTest, TellsTheStateThatThePanelShows) {
  const WebJson told = WebJson::parse(http_ask(port(), "GET", "/api/state").body);
  EXPECT_EQ(told.at("counts").at("points"), state.points);
  EXPECT_EQ(told.at("counts").at("edge_out"), state.leading_edge_out);
  EXPECT_EQ(told.at("worst").at("edge_sequence"), state.worst_leading_edge_sequence);
  EXPECT_NEAR(told.at("fit").at("rms").get<double>(), static_cast<double>(state.rms), 1e-6);
  EXPECT_EQ(told.at("verdict"), word_of(state.verdict));
  EXPECT_EQ(told.at("blade").at("defects").size(), BladeView::kDefects);
  EXPECT_EQ(told.at("blade").at("edge").size(), BladeView::kCells);
  EXPECT_EQ(told.at("commands"), true);
}

TEST_F(WebPanelTest, SendsPointsAsTheyComeAndGoesOnWhereAClientStopped) {
  feed.judged(shown_point(1, 0.25));
  const auto first = watcher();
  const std::string begun = first->receive("\"rows\":[0,1,", 5s);
  ASSERT_NE(begun.find("event: hello"), std::string::npos);
  ASSERT_NE(begun.find("\"afresh\":true"), std::string::npos) << begun;
  feed.judged(shown_point(2, 0.5));
  const std::string more = first->receive("\"rows\":[1,2,1.000,2.000,3.000,0.000,0.000,1.000,0.5000,0.15,42,", 5s);
  ASSERT_NE(more.find("\"rows\":[1,2,1.000,2.000,3.000,0.000,0.000,1.000,0.5000,0.15,42,"), std::string::npos) << more;
  const std::size_t at = more.rfind("id: ") + 4;
  const std::string id = more.substr(at, more.find('\n', at) - at);
  feed.judged(shown_point(3, 0.75));
  const auto second = watcher(id);
  const std::string rest = second->receive("\"rows\":[2,3,", 5s);
  EXPECT_NE(rest.find("\"rows\":[2,3,"), std::string::npos) << rest;
  EXPECT_EQ(rest.find("\"afresh\":true"), std::string::npos);
  const auto stranger = watcher("of-another-run-1-2-3");
  EXPECT_NE(stranger->receive("\"afresh\":true", 5s).find("\"afresh\":true"), std::string::npos);
}

TEST_F(WebPanelTest, TellsWhatAPointWasJudged) {
  feed.judged(shown_point(7, 0.25));
  feed.judged(shown_point(7, 0.125));
  const WebJson told = WebJson::parse(http_ask(port(), "GET", "/api/history?sequence=7").body);
  ASSERT_EQ(told.at("history").size(), 2U);
  EXPECT_EQ(told.at("history")[0].at("distance"), 0.125);
  EXPECT_EQ(http_ask(port(), "GET", "/api/history?sequence=8").status, 404);
  EXPECT_EQ(http_ask(port(), "GET", "/api/history?sequence=nonsense").status, 404);
}

TEST_F(WebPanelTest, RefusesAHostNameThatIsNotItsOwn) {
  const std::string colon = ":" + std::to_string(port());
  EXPECT_EQ(http_ask(port(), "GET", "/api/state", "", "", "localhost" + colon).status, 200);
  EXPECT_EQ(http_ask(port(), "GET", "/api/state", "", "", "rebound.example" + colon).status, 421);
  EXPECT_EQ(http_ask(port(), "GET", "/api/state", "", "", "127.0.0.1:1").status, 421);
  EXPECT_EQ(http_ask(port(), "GET", "/api/state", "", "", "127.0.0.1").status, 421);
  EXPECT_EQ(http_ask(port(), "POST", "/api/command", "stop", bearer(kTestToken), "rebound.example" + colon).status,
            421);
  EXPECT_TRUE(pressed.empty());
}

TEST_F(WebPanelTest, FollowsCommandsOfThoseWhoKnowTheToken) {
  EXPECT_EQ(http_ask(port(), "POST", "/api/command", "stop").status, 401);
  EXPECT_EQ(http_ask(port(), "POST", "/api/command", "stop", bearer("0123456789abcdeX")).status, 401);
  EXPECT_EQ(http_ask(port(), "POST", "/api/command", "stop", bearer("0123456789abcde")).status, 401);
  EXPECT_EQ(http_ask(port(), "POST", "/api/command", "explode", bearer(kTestToken)).status, 400);
  EXPECT_EQ(http_ask(port(), "POST", "/api/command", "check", bearer(kTestToken)).status, 200);
  EXPECT_EQ(http_ask(port(), "GET", "/api/command", "stop", bearer(kTestToken)).status, 404);
  EXPECT_TRUE(pressed.empty());
  EXPECT_EQ(http_ask(port(), "POST", "/api/command", "stop", bearer(kTestToken)).status, 200);
  ASSERT_EQ(pressed.size(), 1U);
  EXPECT_TRUE(pressed[0].stop && !pressed[0].start && !pressed[0].reset && !pressed[0].acknowledge);
  for (int k = 0; k < 10; ++k) static_cast<void>(http_ask(port(), "POST", "/api/command", "stop", bearer("wrong")));
  EXPECT_EQ(http_ask(port(), "POST", "/api/command", "stop", bearer(kTestToken)).status, 429);
  EXPECT_EQ(pressed.size(), 1U);
}

TEST_F(WebPanelTest, WithoutATokenNothingCanBePressed) {
  open("");
  EXPECT_EQ(http_ask(port(), "POST", "/api/command", "stop").status, 403);
  EXPECT_EQ(http_ask(port(), "POST", "/api/command", "stop", bearer("")).status, 403);
  EXPECT_EQ(WebJson::parse(http_ask(port(), "GET", "/api/state").body).at("commands"), false);
  EXPECT_TRUE(pressed.empty());
}

TEST_F(WebPanelTest, AnswersAllowedAddressesOnly) {
  open("", {"192.168.0.7"});
  EXPECT_EQ(http_ask(port(), "GET", "/api/state").status, 403);
  open("", {"192.168.0.7", "127.0.0.1"});
  EXPECT_EQ(http_ask(port(), "GET", "/api/state").status, 200);
}

TEST_F(WebPanelTest, BoundsWhatAClientMaySend) {
  EXPECT_EQ(http_ask(port(), "GET", "/" + std::string(600, 'x')).status, 414);
  EXPECT_EQ(http_ask(port(), "POST", "/api/command", std::string(5000, 'x'), bearer(kTestToken)).status, 413);
  // A header without an end: the connection is closed, and others are answered.
  const HttpConnection endless(port());
  endless.send("GET / HTTP/1.1\r\nHost: " + std::string(100000, 'x'));
  EXPECT_TRUE(endless.closes(10s));
  EXPECT_EQ(http_ask(port(), "GET", "/api/state").status, 200);
}

TEST_F(WebPanelTest, ClientsThatDawdleLockNobodyOut) {
  std::vector<std::unique_ptr<HttpConnection>> dawdlers;
  for (std::size_t k = 0; k < WebPanel::kWorkers; ++k) {
    dawdlers.push_back(std::make_unique<HttpConnection>(port()));
    dawdlers.back()->send("GET / HT");
  }
  // They have five seconds for a request, whatever they trickle.
  EXPECT_EQ(http_ask(port(), "GET", "/api/state").status, 200);
}

TEST_F(WebPanelTest, WatchersHavePlacesAndTheNextOneIsRefused) {
  std::vector<std::unique_ptr<HttpConnection>> watching;
  for (std::size_t k = 0; k < WebPanel::kWatchers; ++k) {
    watching.push_back(watcher());
    ASSERT_NE(watching.back()->receive("event: state", 5s).find("event: state"), std::string::npos) << k;
  }
  EXPECT_NE(watcher()->receive("close one", 5s).find("503"), std::string::npos);
  EXPECT_EQ(http_ask(port(), "GET", "/api/state").status, 200);
  watching.pop_back();
  // The place is free once it is seen that its owner has gone.
  EXPECT_TRUE(hil::eventually(
      [this] { return watcher()->receive("event: state", 1s).find("event: state") != std::string::npos; }));
}

TEST_F(WebPanelTest, EndsAtOnceWhileClientsWatch) {
  const auto watching = watcher();
  ASSERT_NE(watching->receive("event: state", 5s).find("event: state"), std::string::npos);
  const auto begun = std::chrono::steady_clock::now();
  panel.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begun, 3s);
  EXPECT_TRUE(watching->closes(1s));
}

TEST_F(WebPanelTest, SaysInOneLineThatAPortIsInUse) {
  WebPanel second;
  const Failure failure =
      second.open({.host = "127.0.0.1", .port = port(), .token = "", .allow = {}},
                  {.state = [] { return PanelState(); }, .feed = &feed, .press = {}, .design = "{}"});
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure.kind, Failure::Kind::device);
  EXPECT_NE(failure.message.find("--http 127.0.0.1:" + std::to_string(port())), std::string::npos) << failure.message;
}

}  // namespace
}  // namespace bladefit
