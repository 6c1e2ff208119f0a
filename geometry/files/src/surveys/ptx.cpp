// SPDX-License-Identifier: BSD-3-Clause
//
// PTX (Leica): scans of terrestrial scanners as text. Each begins with its numbers of columns and rows, where
// the scanner stood and how it was turned (four lines, of vectors), and a 4x4 matrix as four lines, of which
// the last is the shift: a point is a row times it. Then a line for each point, in the scanner's frame: x y
// z, an intensity, a colour; 0 0 0 where nothing came back.
#include <Eigen/Core>
#include <array>
#include <limits>

#include "../source.h"
#include "../text.h"

namespace vericone::files {
namespace {

class PtxReader {
 public:
  explicit PtxReader(const Source& source) : source_(source), lines_(source) {}

  Parsed read() {
    parsed_.format = "PTX";
    bool more = lines_.next();
    if (!more) source_.refuse("no line", "the number of columns of a scan");
    for (; more; more = lines_.next()) read_scan();
    if (scans_ == 1 && columns_ > 1) {  // a column after the other
      parsed_.width = rows_;
      parsed_.height = columns_;
    }
    return std::move(parsed_);
  }

 private:
  /// The numbers of the line at hand, no more than there are places for.
  template <std::size_t N>
  std::size_t numbers(std::array<double, N>& all, const char* what) {
    Words words(lines_.text());
    std::size_t count = 0;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      if (count == N) refuse_line(what);
      all[count++] = lines_.number(word);
    }
    return count;
  }
  [[noreturn]] void refuse_line(const char* what) const {
    source_.refuse(lines_.where() + ": " + in_quotes(lines_.text()), what);
  }
  void next(const char* what) {
    if (!lines_.next()) source_.refuse("end of file after line " + std::to_string(lines_.read()), what);
  }

  std::size_t size(const char* what) {
    Words words(lines_.text());
    const std::int64_t size = lines_.integer(words.next());
    if (size < 1 || !words.next().empty()) refuse_line(what);
    return std::size_t(size);
  }

  void read_scan() {
    columns_ = size("the number of columns of a scan, alone in its line");
    next("the number of rows of the scan");
    rows_ = size("the number of rows of a scan, alone in its line");
    std::array<double, 3> vector{};
    for (int i = 0; i < 4; ++i) {
      constexpr const char* kWhere = "three numbers, of where the scanner stood and how it was turned";
      next(kWhere);
      if (numbers(vector, kWhere) != 3) refuse_line(kWhere);
    }
    Eigen::Matrix3d turn;
    Eigen::Vector3d shift;
    for (Eigen::Index i = 0; i < 4; ++i) {
      constexpr const char* kRow = "four finite numbers, the last of them 0, in the fourth line 1";
      next(kRow);
      std::array<double, 4> row{};
      if (numbers(row, kRow) != 4 || row[3] != (i == 3 ? 1 : 0)) refuse_line(kRow);
      const Eigen::Vector3d image(row[0], row[1], row[2]);
      if (!image.allFinite()) refuse_line(kRow);
      if (i < 3)
        turn.col(i) = image;
      else
        shift = image;
    }
    // A point's line has six bytes or more.
    const std::size_t left = lines_.rest().size() / 6 + 1;
    if (columns_ > left || rows_ > left / columns_)
      source_.refuse(lines_.where() + ": a scan of " + std::to_string(columns_) + " columns of " +
                         std::to_string(rows_) + " points",
                     "no more than the " + std::to_string(lines_.rest().size()) + " bytes left can hold");
    read_points(columns_ * rows_, turn, shift);
    ++scans_;
  }

  void read_points(std::size_t count, const Eigen::Matrix3d& turn, const Eigen::Vector3d& shift) {
    constexpr const char* kPoint = "x y z, an intensity, and a colour or none: 3, 4 or 7 numbers";
    for (std::size_t i = 0; i < count; ++i) {
      if (!lines_.next())
        source_.refuse("end of file after " + std::to_string(i) + " points of a scan",
                       std::to_string(count) + " points, as its columns and rows say");
      std::array<double, 7> x{};
      const std::size_t numbers_of_it = numbers(x, kPoint);
      if (numbers_of_it != 3 && numbers_of_it != 4 && numbers_of_it != 7) refuse_line(kPoint);
      const Eigen::Vector3d point(x[0], x[1], x[2]);
      // What did not come back is no place: left out, and counted, with those that are not finite.
      constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
      Eigen::Vector3d place = Eigen::Vector3d::Constant(kNone);
      if (!point.isZero(0)) place = turn * point + shift;
      parsed_.points.push_back(place);
    }
  }

  const Source& source_;
  Lines lines_;
  Parsed parsed_;
  std::size_t columns_ = 0, rows_ = 0, scans_ = 0;
};

}  // namespace

Parsed parse_ptx(const Source& source) { return PtxReader(source).read(); }

}  // namespace vericone::files
