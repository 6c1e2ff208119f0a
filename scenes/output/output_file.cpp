// SPDX-License-Identifier: BSD-3-Clause
#include "output/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace vericone {

OutputFile::OutputFile(std::filesystem::path path, Start start)
    : path_(std::move(path)),
      file_(open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (start == Start::anew ? O_TRUNC : O_APPEND),
                 0666)) {
  if (file_ < 0) fail(errno);
}

OutputFile::~OutputFile() {
  if (file_ >= 0) ::close(file_);
}

void OutputFile::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file_, text.data(), text.size());
    if (written >= 0)
      text.remove_prefix(std::size_t(written));
    else if (errno != EINTR)
      fail(errno);
  }
}

void OutputFile::close() {
  // Some things that are written to, such as pipes, have no disk.
  if (fsync(file_) != 0 && errno != EINVAL && errno != EROFS) fail(errno);
  if (::close(std::exchange(file_, -1)) != 0 && errno != EINTR) fail(errno);
}

void OutputFile::fail(int error) const {
  throw std::system_error(error, std::generic_category(), "could not write " + path_.string());
}

void write_whole(const std::filesystem::path& path, std::string_view content) {
  OutputFile file(path);
  file.write(content);
  file.close();
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void sync_to_disk(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  fsync(file);
  close(file);
}

}  // namespace vericone
