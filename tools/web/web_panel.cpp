#include "tools/web/web_panel.hpp"

#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <thread>

#include "tools/web/client_stream.hpp"
#include "tools/web/feed_json.hpp"
#include "tools/web/live_frames.hpp"
#include "tools/web/page_files.hpp"
#include "tools/web/web_access.hpp"
#include "tools/web/worker_pool.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kLongestTarget = 512, kLongestBody = 1024, kLongestHistory = 200;
constexpr int kBadRequest = 400, kUnauthorized = 401, kForbidden = 403, kNotFound = 404, kUriTooLong = 414,
              kMisdirected = 421, kTooMany = 429, kUnavailable = 503;
constexpr const char* kJson = "application/json";

/// The page may load its own files and ask its own server, and do nothing else.
const httplib::Headers& safe_headers() {
  static const httplib::Headers kHeaders = {
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; base-uri 'none'; "
       "form-action 'none'; frame-ancestors 'none'"},
      {"X-Content-Type-Options", "nosniff"},
      {"Referrer-Policy", "no-referrer"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cache-Control", "no-store"}};
  return kHeaders;
}

class PoolQueue : public httplib::TaskQueue {
 public:
  void enqueue(std::function<void()> work) override { pool_.put(std::move(work)); }
  void shutdown() override { pool_.finish(); }

 private:
  WorkerPool pool_{WebPanel::kWorkers, WebPanel::kQueue};
};

/// Gives every client a ClientStream, and one request a connection.
class BoundedServer : public httplib::Server {
 private:
  bool process_and_close_socket(socket_t descriptor) override {
    ClientStream stream(descriptor);
    bool closed = false;
    // Answers are sent as they are: compressing them here would take longer than sending them.
    return process_request(stream, true, closed,
                           [](httplib::Request& request) { request.headers.erase("Accept-Encoding"); });
  }
};

void answer_text(httplib::Response& response, int status, const std::string& text) {
  response.status = status;
  response.set_content(text + "\n", "text/plain; charset=utf-8");
}

std::uint32_t number_of(const httplib::Request& request, const char* name) {
  const std::string text = request.get_param_value(name);
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? number : 0;
}

}  // namespace

/// The server of the library, what it answers from, and who watches.
struct WebPanel::Server {
  Server(WebSettings wanted, WebSource shown)
      : settings(std::move(wanted)),
        source(std::move(shown)),
        guard(settings.token),
        frames(source, guard.has_token()) {}
  ~Server();

  [[nodiscard]] Failure listen();
  void add_answers();
  [[nodiscard]] bool refuse(const httplib::Request& request, httplib::Response& response) const;
  void add_files();
  void watch(const httplib::Request& request, httplib::Response& response);
  [[nodiscard]] bool send_events(FeedPlace& place, std::uint64_t& state, httplib::DataSink& sink);
  void tell_history(const httplib::Request& request, httplib::Response& response) const;
  void follow(const httplib::Request& request, httplib::Response& response);

  WebSettings settings;
  WebSource source;
  TokenGuard guard;
  LiveFrames frames;
  std::uint16_t port = 0;
  std::atomic<std::size_t> watchers{0};
  BoundedServer http;
  std::thread thread;
};

WebPanel::Server::~Server() {
  http.stop();
  if (thread.joinable()) thread.join();
}

Failure WebPanel::Server::listen() {
  http.new_task_queue = [] { return new PoolQueue; };
  http.set_payload_max_length(kLongestBody);
  http.set_tcp_nodelay(true);
  http.set_socket_options([](socket_t descriptor) {
    const int on = 1;
    setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  });
  http.set_default_headers(safe_headers());
  add_answers();
  errno = 0;
  const int bound = settings.port == 0                                ? http.bind_to_any_port(settings.host)
                    : http.bind_to_port(settings.host, settings.port) ? settings.port
                                                                      : -1;
  if (bound <= 0) {
    return device_failure(
        fmt::format("--http {}:{}: cannot listen there ({}); choose another address or port, port 0 takes any free one",
                    settings.host, settings.port, errno != 0 ? std::strerror(errno) : "no such address here"));
  }
  port = static_cast<std::uint16_t>(bound);
  thread = std::thread([this] { http.listen_after_bind(); });
  // A server that does not run yet cannot be stopped.
  while (!http.is_running()) std::this_thread::yield();
  return {};
}

void WebPanel::Server::add_answers() {
  using Answer = httplib::Server::HandlerResponse;
  http.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    return refuse(request, response) ? Answer::Handled : Answer::Unhandled;
  });
  http.set_exception_handler([](const httplib::Request&, httplib::Response& response, std::exception_ptr) {
    answer_text(response, kUnavailable, "the host could not answer this; try again");
  });
  add_files();
  http.Get("/api/events", [this](const auto& request, auto& response) { watch(request, response); });
  http.Get("/api/state", [this](const auto&, auto& response) {
    // An event holds one line of data.
    const std::string& text = *frames.state().text;
    const std::size_t from = text.find('{');
    response.set_content(text.substr(from, text.rfind('}') + 1 - from), kJson);
  });
  http.Get("/api/design", [this](const auto&, auto& response) { response.set_content(source.design, kJson); });
  http.Get("/api/history", [this](const auto& request, auto& response) { tell_history(request, response); });
  http.Post("/api/command", [this](const auto& request, auto& response) { follow(request, response); });
}

/// What is refused whatever it asks for.
bool WebPanel::Server::refuse(const httplib::Request& request, httplib::Response& response) const {
  if (request.target.size() > kLongestTarget) {
    answer_text(response, kUriTooLong, "the address is too long");
    return true;
  }
  if (!settings.allow.empty() && std::ranges::find(settings.allow, request.remote_addr) == settings.allow.end()) {
    answer_text(response, kForbidden, "your address is not among those that panel.allow names");
    return true;
  }
  const bool one_host = request.get_header_value_count("Host") == 1;
  if (one_host && is_own_host(request.get_header_value("Host"), settings.host, port)) return false;
  answer_text(response, kMisdirected, "this host answers only by its own numeric address, or as localhost");
  return true;
}

void WebPanel::Server::add_files() {
  for (const PageFile& file : page_files()) {
    http.Get(std::string(file.path), [&file](const auto&, auto& response) {
      response.set_header("Content-Encoding", "gzip");
      response.set_content(reinterpret_cast<const char*>(file.gzip.data()), file.gzip.size(), std::string(file.type));
    });
  }
}

void WebPanel::Server::watch(const httplib::Request& request, httplib::Response& response) {
  if (watchers.fetch_add(1) >= kWatchers) {
    watchers.fetch_sub(1);
    return answer_text(response, kUnavailable, fmt::format("{} pages watch already; close one", kWatchers));
  }
  const std::string last = request.get_header_value("Last-Event-ID");
  const auto place =
      std::make_shared<FeedPlace>(frames.place_of(last.empty() ? request.get_param_value("from") : last));
  const auto state = std::make_shared<std::uint64_t>(0);
  response.set_chunked_content_provider(
      "text/event-stream",
      [this, place, state](std::size_t, httplib::DataSink& sink) { return send_events(*place, *state, sink); },
      [this](bool) { watchers.fetch_sub(1); });
}

/// What is new since the client was told last, or nothing; then waits for the time to look again.
bool WebPanel::Server::send_events(FeedPlace& place, std::uint64_t& state, httplib::DataSink& sink) {
  if (!sink.is_writable()) return false;
  const auto send = [&sink](const std::string& text) { return sink.write(text.data(), text.size()); };
  if (state == 0 && !send(frames.hello())) return false;
  const LiveFrames::State shown = frames.state();
  if (shown.number != state && !send(*shown.text)) return false;
  state = shown.number;
  const LiveFrames::Points points = frames.points(place);
  if (points.text && !send(*points.text)) return false;
  place = points.next;
  if (!points.more) std::this_thread::sleep_until(LiveFrames::next_tick());
  return true;
}

void WebPanel::Server::tell_history(const httplib::Request& request, httplib::Response& response) const {
  std::vector<FedVerdict> verdicts(kLongestHistory);
  const std::uint32_t sequence = number_of(request, "sequence");
  verdicts.resize(source.feed->history(sequence, verdicts));
  if (verdicts.empty()) return answer_text(response, kNotFound, "no such point is remembered");
  response.set_content(history_json(sequence, verdicts), kJson);
}

void WebPanel::Server::follow(const httplib::Request& request, httplib::Response& response) {
  switch (guard.check(request.get_header_value("Authorization"))) {
    case TokenGuard::Answer::accepted:
      break;
    case TokenGuard::Answer::refused:
      response.set_header("WWW-Authenticate", "Bearer");
      return answer_text(response, kUnauthorized, "this is not the token");
    case TokenGuard::Answer::too_many:
      return answer_text(response, kTooMany, "too many wrong tokens; wait ten seconds");
    case TokenGuard::Answer::no_commands:
      return answer_text(response, kForbidden, "read only: no token is set, see http_token_file");
  }
  const std::string& name = request.body;
  const PanelCommands commands{
      .start = name == "start", .stop = name == "stop", .reset = name == "reset", .acknowledge = name == "acknowledge"};
  const bool any = commands.start || commands.stop || commands.reset || commands.acknowledge;
  if (!any && name != "check") return answer_text(response, kBadRequest, "no such command");
  if (any) source.press(commands);
  response.set_content("{}", kJson);
}

WebPanel::WebPanel() = default;
WebPanel::~WebPanel() = default;

bool WebPanel::has_page() { return !page_files().empty(); }

Failure WebPanel::open(const WebSettings& settings, WebSource source) {
  server_ = std::make_unique<Server>(settings, std::move(source));
  return server_->listen();
}

std::string WebPanel::address() const {
  const std::string& host = server_->settings.host;
  const bool v6 = host.find(':') != std::string::npos;
  return fmt::format("http://{}{}{}:{}/", v6 ? "[" : "", host, v6 ? "]" : "", server_->port);
}

std::uint16_t WebPanel::port() const { return server_->port; }

}  // namespace bladefit
