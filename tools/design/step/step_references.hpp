#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bladefit {

/// Which instance of a STEP file refers to which.
class StepReferences {
 public:
  explicit StepReferences(const std::string& file) : file_(file) {}

  /// Instance `number` is defined on `line`; what is referred to from now on it refers to.
  void define(std::uint32_t number, std::size_t line);
  void refer(std::uint32_t number, std::size_t line);

  /// Throws ToolError naming the line where an instance is given twice, refers to one that is not there, or, over
  /// whatever others, to itself.
  void check() const;

 private:
  struct Instance {
    std::uint32_t number;
    std::size_t line, first_reference;
  };
  struct Reference {
    std::uint32_t number;
    std::size_t line;
  };

  [[noreturn]] void fail(std::size_t line, const std::string& what) const;

  const std::string& file_;
  std::vector<Instance> instances_;
  std::vector<Reference> references_;
};

}  // namespace bladefit
