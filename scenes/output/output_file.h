// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace vericone {

/// A file that is written from its start, or from its end on. What fails is told at once, as
/// std::system_error naming the path and the reason.
class OutputFile {
 public:
  enum class Start { anew, at_end };

  explicit OutputFile(std::filesystem::path path, Start start = Start::anew);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  /// Returns once the content is on the disk.
  void close();

 private:
  [[noreturn]] void fail(int error) const;

  std::filesystem::path path_;
  int file_;
};

/// A file of this content. Throws std::system_error naming the path and the reason.
void write_whole(const std::filesystem::path& path, std::string_view content);

/// What a file holds; nothing where it cannot be read.
std::string content_of(const std::filesystem::path& path);

/// Returns once a file, or the names in a folder, are on the disk.
void sync_to_disk(const std::filesystem::path& path);

}  // namespace vericone
