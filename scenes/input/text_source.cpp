// SPDX-License-Identifier: BSD-3-Clause
#include "input/text_source.h"

#include <fcntl.h>
#include <unistd.h>
#include <vericone/geometry/error.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace vericone::input {
namespace {

std::string why(int error) { return std::generic_category().message(error); }

std::string megabytes() { return std::to_string(kMostBytes >> 20) + " MiB"; }

}  // namespace

TextSource::TextSource(std::string path, std::string requirement)
    : path_(std::move(path)), requirement_(std::move(requirement)) {
  file_ = path_ == "-" ? STDIN_FILENO : open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ >= 0) return;
  const int error = errno;
  throw InputError(path_, error == ENOENT ? "no such file" : "a file that cannot be read: " + why(error),
                   requirement_);
}

TextSource::~TextSource() {
  if (file_ > STDIN_FILENO) close(file_);
}

bool TextSource::take_line(std::string& line) {
  const std::size_t end = buffer_.find('\n', searched_);
  if (end == std::string::npos) {
    searched_ = buffer_.size();
    if (buffer_.size() - begin_ > kMostBytes)
      throw InputError(path_ + ":" + std::to_string(lines_ + 1), "a line of more than " + megabytes(),
                       "lines of at most " + megabytes());
    return false;
  }
  line.assign(buffer_, begin_, end - begin_);
  begin_ = searched_ = end + 1;
  ++lines_;
  return true;
}

bool TextSource::take_rest(std::string& line) {
  if (begin_ == buffer_.size()) return false;
  line.assign(buffer_, begin_);
  begin_ = searched_ = buffer_.size();
  ++lines_;
  return true;
}

void TextSource::read_more() {
  constexpr std::size_t kPiece = std::size_t(1) << 16;
  buffer_.erase(0, begin_);
  searched_ -= begin_;
  begin_ = 0;
  const std::size_t before = buffer_.size();
  buffer_.resize(before + kPiece);
  ssize_t got = 0;
  do got = read(file_, buffer_.data() + before, kPiece);
  while (got < 0 && errno == EINTR);
  const int error = errno;
  buffer_.resize(before + (got > 0 ? std::size_t(got) : 0));
  if (got < 0) throw InputError(path_, "a file that cannot be read: " + why(error), requirement_);
  ended_ = got == 0;
}

std::string TextSource::whole() {
  while (!ended_) {
    read_more();
    if (buffer_.size() > kMostBytes)
      throw InputError(path_, "more than " + megabytes(), requirement_ + " of at most " + megabytes());
  }
  return std::exchange(buffer_, {});
}

}  // namespace vericone::input
