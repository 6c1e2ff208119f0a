// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/internal/files/xml.h>
#include <filesystem>

namespace vericone::robot {

using xml::Element, xml::refuse;

/// The outermost element of a file of at most 16 MiB. Throws InputError of refuse().
Element read_xml(const std::filesystem::path& file);

}  // namespace vericone::robot
