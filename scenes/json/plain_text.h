// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace vericone {

bool is_utf8(std::string_view text);

/// Whether UTF-8 has characters that a terminal obeys instead of showing them: C0, DEL and C1.
bool has_control_characters(std::string_view text);

/// The text with such characters, and bytes that are no UTF-8, as \xNN: fit for a terminal and for JSON.
std::string plain_text(std::string_view text);

}  // namespace vericone
