// SPDX-License-Identifier: BSD-3-Clause
#include "output/standard_output.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <iostream>
#include <streambuf>
#include <string_view>
#include <system_error>

namespace vericone {
namespace {

class StandardOutput : public std::streambuf {
 public:
  StandardOutput() { setp(buffer_.data(), buffer_.data() + buffer_.size()); }

 protected:
  int_type overflow(int_type c) override {
    sync();
    if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
  }

  std::streamsize xsputn(const char* text, std::streamsize size) override {
    if (size > epptr() - pptr()) sync();
    if (size > epptr() - pptr()) {
      write({text, std::size_t(size)});
    } else {
      traits_type::copy(pptr(), text, std::size_t(size));
      pbump(int(size));
      if (terminal_ && traits_type::find(text, std::size_t(size), '\n')) sync();
    }
    return size;
  }

  int sync() override {
    const std::string_view text(pbase(), std::size_t(pptr() - pbase()));
    setp(buffer_.data(), buffer_.data() + buffer_.size());  // what fails is not tried again
    write(text);
    return 0;
  }

 private:
  static void write(std::string_view text) {
    while (!text.empty()) {
      const ssize_t written = ::write(STDOUT_FILENO, text.data(), text.size());
      if (written >= 0) {
        text.remove_prefix(std::size_t(written));
      } else if (errno == EAGAIN) {
        pollfd full{STDOUT_FILENO, POLLOUT, 0};
        poll(&full, 1, -1);
      } else if (errno != EINTR) {
        throw std::system_error(errno, std::generic_category(), "could not write to standard output");
      }
    }
  }

  std::array<char, std::size_t(1) << 16> buffer_{};
  bool terminal_ = isatty(STDOUT_FILENO) != 0;
};

}  // namespace

void require_standard_output() {
  static auto* const buffer = new StandardOutput;  // std::cout writes to it until the very end
  std::cout.rdbuf(buffer);
  std::cout.exceptions(std::ios::badbit);
  std::cerr.tie(nullptr);  // a message about standard output does not write to it
}

}  // namespace vericone
