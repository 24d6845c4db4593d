#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "drivers/source/failure.hpp"
#include "tools/web/web_settings.hpp"
#include "tools/web/web_source.hpp"

namespace bladefit {

/// Serves the page, and what it shows, over HTTP/1.1 in threads of its own. What a client may use of them is bounded:
/// places, time for a request, its size. Nothing that is asked waits for the host, nor the host for it.
class WebPanel {
 public:
  static constexpr std::size_t kWatchers = 16;  ///< clients that get events
  static constexpr std::size_t kWorkers = 24;   ///< threads; each serves a client
  static constexpr std::size_t kQueue = 64;     ///< connections that wait for one

  WebPanel();
  ~WebPanel();
  WebPanel(const WebPanel&) = delete;
  WebPanel& operator=(const WebPanel&) = delete;

  /// Whether the program was built with the page.
  [[nodiscard]] static bool has_page();

  /// Starts to listen. device: the port is in use, or there is no such address here.
  [[nodiscard]] Failure open(const WebSettings& settings, WebSource source);

  /// What to type in a browser: http://HOST:PORT/. After open().
  [[nodiscard]] std::string address() const;

  /// The port listened at, after open().
  [[nodiscard]] std::uint16_t port() const;

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace bladefit
