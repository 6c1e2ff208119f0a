// SPDX-License-Identifier: BSD-3-Clause
//
// Tables as HDF5, a data set each column; the one place that knows the library. Layout:
// docs/reference/formats.md.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace vericone::rows {

/// Rows that are packed together, and read or written at once.
constexpr std::size_t kBlock = 65'536;

enum class Cell {
  whole,   // a whole number below 2^53 in magnitude
  number,  // a double, NaN where the cell is empty
  word,    // one of few: an enumeration
  text     // `width` bytes, filled with zeros
};

struct ColumnKind {
  std::string name;  // "least distance [m]"
  Cell cell = Cell::whole;
  std::vector<std::string> words = {};  // in order of their first appearance; one may be empty
  std::size_t width = 0;
};

/// Bytes of a row in memory.
std::size_t bytes_of(const std::vector<ColumnKind>& columns);

/// A column's cells from some row on: one of the three has them.
struct Cells {
  std::vector<double> numbers;
  std::vector<std::uint16_t> words;
  std::string text;
};

/// What fits in a file beside the rows (HDF5 holds such in 64 KiB).
constexpr std::size_t kLongestComments = 32'768, kLongestName = 1024, kLongestWords = 32'768;
/// What keeps a block below 128 MiB: bytes_of() of a table's columns.
constexpr std::size_t kLongestRow = 2048;

class Hdf5Writer {
 public:
  /// All throw std::runtime_error naming the file where it cannot be written.
  Hdf5Writer(const std::string& file, const std::string& comments, std::vector<ColumnKind> columns);
  ~Hdf5Writer();
  /// kBlock rows; the last time, fewer.
  void append(const std::vector<Cells>& columns, std::size_t rows);
  void close();

 private:
  struct File;
  std::unique_ptr<File> file_;
};

class Hdf5Reader {
 public:
  /// Throws InputError naming the file, and where one can the column, where it is none that
  /// Hdf5Writer wrote.
  explicit Hdf5Reader(const std::string& file);
  ~Hdf5Reader();
  [[nodiscard]] std::uint64_t rows() const;
  [[nodiscard]] const std::string& comments() const;
  [[nodiscard]] const std::vector<ColumnKind>& columns() const;
  /// The rows from `first`, a multiple of kBlock, on: kBlock or what is left. Throws InputError naming file,
  /// column and rows.
  [[nodiscard]] std::vector<Cells> read(std::uint64_t first) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

[[nodiscard]] bool is_hdf5(const std::string& file);

}  // namespace vericone::rows
