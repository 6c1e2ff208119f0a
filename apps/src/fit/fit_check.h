// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

namespace vericone {

/// `vericone fit FILE --check RESULT.json`: repeats the certificate with nothing but the quadrics that are
/// written, the margin and the scan. Returns the exit status: 0 where what the result claims holds, 1 where
/// it does not, or where it claims nothing. With `certificate` what proves it, for programs that check that,
/// is written to the file of that name, where all is inside. Throws InputError naming a file or a field.
int check_fit(const std::string& file, const std::string& result, const std::string& certificate, bool json,
              std::ostream& out);

}  // namespace vericone
