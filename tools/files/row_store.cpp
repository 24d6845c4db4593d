#include "tools/files/row_store.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

#include "tools/files/tool_error.hpp"

namespace bladefit {
namespace {

constexpr std::size_t kBlockSize = std::size_t{1} << 18U;

std::string temporary_folder() {
  const char* const folder = std::getenv("TMPDIR");
  return folder != nullptr && *folder != '\0' ? folder : "/var/tmp";
}

/// A file that has lost its name already; -1 where there can be none.
int open_nameless_file() {
  std::string path = temporary_folder() + "/bladefit-XXXXXX";
  const int file = mkostemp(path.data(), O_CLOEXEC);
  if (file >= 0) unlink(path.c_str());
  return file;
}

}  // namespace

RowStore::RowStore(std::size_t row_size)
    : row_size_(row_size), rows_per_block_(std::max<std::size_t>(1, kBlockSize / row_size)) {}

RowStore::~RowStore() { close_file(); }

RowStore::RowStore(RowStore&& other) noexcept
    : row_size_(other.row_size_),
      rows_per_block_(other.rows_per_block_),
      size_(std::exchange(other.size_, 0)),
      file_(std::exchange(other.file_, -1)),
      newest_(std::move(other.newest_)),
      kept_(std::move(other.kept_)),
      read_(std::move(other.read_)),
      read_block_(other.read_block_) {
  other.clear();
}

RowStore& RowStore::operator=(RowStore&& other) noexcept {
  if (this == &other) return *this;
  std::swap(row_size_, other.row_size_);
  std::swap(rows_per_block_, other.rows_per_block_);
  std::swap(size_, other.size_);
  std::swap(file_, other.file_);
  std::swap(newest_, other.newest_);
  std::swap(kept_, other.kept_);
  std::swap(read_, other.read_);
  std::swap(read_block_, other.read_block_);
  other.clear();
  return *this;
}

void RowStore::close_file() {
  if (file_ >= 0) close(std::exchange(file_, -1));
}

void RowStore::clear() {
  close_file();
  size_ = 0;
  newest_.clear();
  kept_.clear();
  read_.clear();
}

void RowStore::add(const void* row) {
  if (newest_.size() == rows_per_block_ * row_size_) put_away();
  const auto* const bytes = static_cast<const std::byte*>(row);
  newest_.insert(newest_.end(), bytes, bytes + row_size_);
  ++size_;
}

/// Makes room for the next block.
void RowStore::put_away() {
  const std::size_t block = size_ / rows_per_block_ - 1;
  if (file_ < 0 && block == 0) file_ = open_nameless_file();
  if (!write_block(block)) kept_.emplace(block, newest_);
  newest_.clear();
}

bool RowStore::write_block(std::size_t block) {
  if (file_ < 0) return false;
  std::size_t done = 0;
  while (done < newest_.size()) {
    const auto place = static_cast<off_t>(block * newest_.size() + done);
    const ssize_t count = pwrite(file_, newest_.data() + done, newest_.size() - done, place);
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

const RowStore::Block& RowStore::block_of(std::size_t block) const {
  if (block == (size_ - 1) / rows_per_block_) return newest_;
  if (const auto kept = kept_.find(block); kept != kept_.end()) return kept->second;
  if (!read_.empty() && read_block_ == block) return read_;
  const std::size_t size = rows_per_block_ * row_size_;
  read_.resize(size);
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = pread(file_, read_.data() + done, size - done, static_cast<off_t>(block * size + done));
    if (count <= 0) {
      read_.clear();
      throw ToolError(fmt::format("{}: a temporary file in it cannot be read back ({}); check the disk, or set TMPDIR",
                                  temporary_folder(), count < 0 ? std::strerror(errno) : "it was cut short"),
                      Failure::Kind::device);
    }
    done += static_cast<std::size_t>(count);
  }
  read_block_ = block;
  return read_;
}

void RowStore::read(std::size_t index, void* row) const {
  const Block& block = block_of(index / rows_per_block_);
  std::memcpy(row, block.data() + index % rows_per_block_ * row_size_, row_size_);
}

}  // namespace bladefit
