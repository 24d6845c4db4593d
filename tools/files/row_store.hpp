#pragma once
#include <cstddef>
#include <map>
#include <vector>

namespace bladefit {

/// Rows of equal size in the order in which they were added. The newest block of them is in memory, full ones are in a
/// file without a name in the folder of temporary files (TMPDIR, else /var/tmp), so that the memory does not grow with
/// the rows. Where that folder takes no more they stay in memory.
class RowStore {
 public:
  explicit RowStore(std::size_t row_size);
  ~RowStore();
  RowStore(RowStore&& other) noexcept;
  RowStore& operator=(RowStore&& other) noexcept;

  /// Adds the `row_size` bytes at `row`.
  void add(const void* row);

  /// Copies a row out; the index is below size(). Rows in order cost a read of the file for each block. Throws
  /// ToolError (device) where the file cannot be read.
  void read(std::size_t index, void* row) const;

  [[nodiscard]] std::size_t size() const { return size_; }
  void clear();

 private:
  using Block = std::vector<std::byte>;
  void put_away();
  [[nodiscard]] bool write_block(std::size_t block);
  [[nodiscard]] const Block& block_of(std::size_t block) const;
  void close_file();

  std::size_t row_size_, rows_per_block_, size_ = 0;
  int file_ = -1;
  Block newest_;
  std::map<std::size_t, Block> kept_;  ///< full blocks that no file took
  mutable Block read_;                 ///< the block that was read last
  mutable std::size_t read_block_ = 0;
};

}  // namespace bladefit
