// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vericone {

/// From here on std::cout throws std::system_error, with the reason, where standard output cannot be written.
/// On a terminal every line is shown at once.
void require_standard_output();

}  // namespace vericone
