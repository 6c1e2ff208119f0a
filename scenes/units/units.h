// SPDX-License-Identifier: BSD-3-Clause
//
// Numbers with a unit written out, "5 nmi": in the fields that have a unit, which is what they are read in.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "json/json_forward.h"

namespace vericone::input {

/// The number that a text such as "250 kn", "-1.5e3 ft" or "30 deg" says, in the field's unit: where both are
/// defined by whole numbers, the double that is nearest to the exact value (250 kn are 250 · 1852 / 3600
/// m/s); between degrees and radians one product or quotient with pi / 180 in doubles.
/// `words`: the field's unit as refusals have it, " (metres)", " (m/s)"; "" of pure numbers. Throws
/// InputError naming `path`: of no such text, of an unknown unit, of one of another dimension.
double read_quantity(const Json& value, const std::string& path, const char* words);

/// Whether the field may be read as one number: a number, or text.
bool may_be_number(const Json& value);

/// What may be written out where the field's unit is `unit`, "m/s²": its own first. Empty where that is none
/// that is known.
std::vector<std::string_view> units_for(std::string_view unit);

}  // namespace vericone::input
