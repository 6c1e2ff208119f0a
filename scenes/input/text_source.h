// SPDX-License-Identifier: BSD-3-Clause
//
// Text that strangers wrote: read in pieces from files, pipes and standard input, within limits.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vericone::input {

/// Of a scene, and of one line of cases. What JSON and YAML of this length become in memory stays below 1 GB.
inline constexpr std::size_t kMostBytes = std::size_t(16) << 20;
inline constexpr std::size_t kMostValues = 1'000'000;  // of a scene, aliases counted wherever they stand
inline constexpr std::size_t kMostFields = 100;        // of one mapping
inline constexpr int kMostLevels = 20;                 // of lists and mappings within one another

/// An open file, or standard input for "-". Errors are InputErrors that name the path and say why.
class TextSource {
 public:
  /// `requirement`: what the path should have been.
  TextSource(std::string path, std::string requirement);
  ~TextSource();
  TextSource(const TextSource&) = delete;
  TextSource& operator=(const TextSource&) = delete;

  /// The next line without its end. False after the last one.
  bool next_line(std::string& line);

  /// The whole lines that are at hand, with their ends, once they have `most` bytes; waits where there is
  /// none. The last line may have no end. False after it.
  bool next_lines(std::string& lines, std::size_t most);

  /// All of it.
  std::string whole();

 private:
  bool take_line(std::string& line);
  bool take_rest(std::string& line);
  void read_more();
  /// Whether reading would not wait.
  [[nodiscard]] bool more_at_hand() const;
  [[noreturn]] void refuse_line() const;

  std::string path_, requirement_;
  int file_ = -1;
  bool ended_ = false;
  std::string buffer_;
  std::size_t begin_ = 0, searched_ = 0;  // of what is not taken yet; no line ends before `searched_`
  std::size_t lines_ = 0;
};

}  // namespace vericone::input
