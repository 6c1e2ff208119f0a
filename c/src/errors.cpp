// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/sound_arithmetic.h>
#include <array>
#include <cstring>

#include "common.h"

namespace vericone::c {
namespace {

thread_local std::array<char, 512> said{};

}  // namespace

int32_t failed(int32_t status, const char* text) noexcept {
  const std::size_t length = std::min(std::strlen(text), said.size() - 1);
  std::memcpy(said.data(), text, length);
  said[length] = '\0';
  return status;
}

}  // namespace vericone::c

using namespace vericone;
using namespace vericone::c;

extern "C" {

const char* vericone_error(void) { return said.data(); }
const char* vericone_version(void) { return VERICONE_VERSION; }
int32_t vericone_sound_arithmetic(void) {
  return answered([] {
    require_sound_arithmetic();
    return int32_t{VERICONE_OK};
  });
}

}  // extern "C"
