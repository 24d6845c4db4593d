#include "tools/panel/keyboard.hpp"

#include <unistd.h>

namespace bladefit {

Keyboard::Keyboard() {
  // Who is not in the foreground would be stopped for changing the terminal.
  if (tcgetpgrp(STDIN_FILENO) != getpgrp() || tcgetattr(STDIN_FILENO, &before_) != 0) return;
  termios keys = before_;
  keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  keys.c_cc[VMIN] = 0;
  keys.c_cc[VTIME] = 0;
  works_ = tcsetattr(STDIN_FILENO, TCSANOW, &keys) == 0;
}

Keyboard::~Keyboard() {
  if (works_) tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

char Keyboard::next() {
  char key = 0;
  return works_ && read(STDIN_FILENO, &key, 1) == 1 ? key : '\0';
}

}  // namespace bladefit
