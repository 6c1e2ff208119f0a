// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/internal/scanning/picture.h>
#include <iosfwd>

namespace vericone::scanning {

/// Everything as JSON for apps/figures/scan_convergence.py and visible_section.py.
void write_json(const Study& study, std::ostream& out);
void write_json(const PlaneSectionPicture& picture, std::ostream& out);

}  // namespace vericone::scanning
