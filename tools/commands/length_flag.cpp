#include "tools/commands/length_flag.hpp"

#include "tools/files/tool_error.hpp"

namespace bladefit {

CLI::Option* add_length_flag(CLI::App& command, const std::string& flag, const std::function<void(const Length&)>& take,
                             const std::string& help) {
  const auto take_text = [flag, take](const std::string& text) {
    Length length;
    if (const Failure error = parse_length(text, length)) throw ToolError(flag + ": " + error.message);
    take(length);
  };
  return command.add_option_function<std::string>(flag, take_text, help)->allow_extra_args(false)->type_name("LENGTH");
}

}  // namespace bladefit
