#pragma once
#include <fmt/format.h>

#include <cstdio>
#include <utility>

namespace bladefit::simulate {

/// What the machine does, one line each on standard error, if the user wants to see it.
class Log {
 public:
  explicit Log(bool verbose) : verbose_(verbose) {}

  template <typename... Arguments>
  void operator()(fmt::format_string<Arguments...> format, Arguments&&... arguments) const {
    if (verbose_) fmt::print(stderr, "simulate: {}\n", fmt::format(format, std::forward<Arguments>(arguments)...));
  }

 private:
  bool verbose_;
};

}  // namespace bladefit::simulate
