#pragma once
#include <cstddef>
#include <iterator>
#include <type_traits>

#include "tools/files/row_store.hpp"

namespace bladefit {

/// A list of rows that may be longer than memory allows: beyond some hundreds of kilobytes it is in a temporary file
/// (RowStore). Rows are given by value, and read fastest in their order. Move only.
template <typename Row>
class Rows {
  static_assert(std::is_trivially_destructible_v<Row>, "rows are copied as bytes, and must own nothing");

 public:
  using value_type = Row;

  /// Passes over the rows; the list must outlive it and stay as it is.
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = Row;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = Row;

    Iterator() = default;
    Iterator(const Rows& rows, std::size_t index) : rows_(&rows), index_(index) {}
    [[nodiscard]] Row operator*() const { return (*rows_)[index_]; }
    Iterator& operator++() {
      ++index_;
      return *this;
    }
    Iterator operator++(int) { return {*rows_, index_++}; }
    [[nodiscard]] bool operator==(const Iterator& other) const { return index_ == other.index_; }

   private:
    const Rows* rows_ = nullptr;
    std::size_t index_ = 0;
  };

  void push_back(const Row& row) { store_.add(&row); }

  /// The index is below size(). Throws as RowStore::read() does.
  [[nodiscard]] Row operator[](std::size_t index) const {
    Row row;
    store_.read(index, &row);
    return row;
  }
  [[nodiscard]] Row front() const { return (*this)[0]; }
  [[nodiscard]] Row back() const { return (*this)[size() - 1]; }

  /// Puts what `changed` makes of each row in its place.
  template <typename Change>
  void change_each(const Change& changed) {
    Rows others;
    for (const Row& row : *this) others.push_back(changed(row));
    *this = std::move(others);
  }

  void clear() { store_.clear(); }
  [[nodiscard]] std::size_t size() const { return store_.size(); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size()}; }

 private:
  RowStore store_{sizeof(Row)};
};

}  // namespace bladefit
