#pragma once
#include <termios.h>

namespace bladefit {

/// Single keys from the terminal at standard input, without waiting for the end of a line; no keys where there is no
/// terminal, or it belongs to another program. Ctrl-C and the like do what they always do. The terminal is as it was
/// when the keyboard goes.
class Keyboard {
 public:
  Keyboard();
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  [[nodiscard]] bool works() const { return works_; }

  /// The next key that was pressed; 0 = none.
  [[nodiscard]] char next();

 private:
  termios before_{};
  bool works_ = false;
};

}  // namespace bladefit
