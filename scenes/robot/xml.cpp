// SPDX-License-Identifier: BSD-3-Clause
#include "robot/xml.h"

#include "input/text_source.h"

namespace vericone::robot {

Element read_xml(const std::filesystem::path& file) {
  return xml::parse(input::TextSource(file.string(), "a robot, URDF or SDF").whole());
}

}  // namespace vericone::robot
