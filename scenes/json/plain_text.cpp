// SPDX-License-Identifier: BSD-3-Clause
#include "json/plain_text.h"

#include <cstdio>

namespace vericone {
namespace {

unsigned byte(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

/// Bytes of the character at the front; 0 where there is none. Neither surrogates nor longer forms than
/// needed are characters.
std::size_t length_of_first(std::string_view text) {
  const unsigned first = byte(text, 0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(text, i) & 0xc0) != 0x80) return 0;
  const unsigned second = byte(text, 1);
  const bool good = !(first == 0xe0 && second < 0xa0) && !(first == 0xed && second > 0x9f) &&
                    !(first == 0xf0 && second < 0x90) && !(first == 0xf4 && second > 0x8f);
  return good ? length : 0;
}

bool obeyed(std::string_view character) {
  const unsigned first = byte(character, 0);
  return first < 0x20 || first == 0x7f || (first == 0xc2 && byte(character, 1) < 0xa0);
}

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = length_of_first(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

bool has_control_characters(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = length_of_first(text);
    if (length > 0 && obeyed(text.substr(0, length))) return true;
    text.remove_prefix(length > 0 ? length : 1);
  }
  return false;
}

std::string plain_text(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    const std::size_t length = length_of_first(text), taken = length > 0 ? length : 1;
    if (length > 0 && !obeyed(text.substr(0, length))) {
      plain += text.substr(0, length);
    } else {
      for (std::size_t i = 0; i < taken; ++i) {
        char escaped[8];
        std::snprintf(escaped, sizeof escaped, "\\x%02x", byte(text, i));
        plain += escaped;
      }
    }
    text.remove_prefix(taken);
  }
  return plain;
}

}  // namespace vericone
