#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

namespace bladefit {

/// A value of a JSON file together with the way to it, so that an error can name it. Every check throws ToolError
/// (bad_input) that names file and field.
class JsonField {
 public:
  /// `value` and `file` must outlive it.
  JsonField(const nlohmann::json& value, const std::string& file, std::string name)
      : value_(value), file_(file), name_(std::move(name)) {}

  /// A member, which must be there.
  [[nodiscard]] JsonField operator[](const char* key) const;
  /// Whether there is such a member, and it is not null.
  [[nodiscard]] bool has(const char* key) const;

  [[nodiscard]] JsonField element(std::size_t index) const;
  /// The number of elements of a list.
  [[nodiscard]] std::size_t size() const;
  void need_size(std::size_t wanted) const;

  [[nodiscard]] bool is_null() const { return value_.is_null(); }
  [[nodiscard]] double number() const;
  [[nodiscard]] std::uint32_t whole() const;
  [[nodiscard]] std::string text() const;

  [[noreturn]] void refuse(const std::string& what) const { fail(name_, what); }

 private:
  [[noreturn]] void fail(const std::string& name, const std::string& what) const;

  const nlohmann::json& value_;
  const std::string& file_;
  std::string name_;
};

/// Parses `text`, the content of the file `path`. Throws ToolError that names the line.
[[nodiscard]] nlohmann::json parse_json(const std::string& path, const std::string& text);

}  // namespace bladefit
