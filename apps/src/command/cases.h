// SPDX-License-Identifier: BSD-3-Clause
//
// Files of cases: one JSON object a line in, one answer a line out.
#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

#include "json/json_forward.h"
#include "output/part.h"

namespace vericone {

/// The fields of an answer to a case; InputError where the case is bad. Called from several threads.
using Answer = std::function<Json(const Json&)>;

/// Answers in the order of the lines, each with the case's `id`, or with `error`. Returns the exit status: 0,
/// or 2 if any line was bad. Blank lines have no answer. `path`: "-" for standard input, where what is there
/// is answered before more is waited for. `threads`: that answer; memory does not grow with the file. `part`:
/// of the lines that begin in this part of the file's bytes alone; answers of all parts, one after the other,
/// are those of the file. Throws InputError naming --part where the path is no file.
int answer_cases(const std::string& path, const Answer& answer, std::ostream& out, int threads = 1,
                 const std::optional<Part>& part = {});

/// One line of a file of cases. Throws InputError naming the line.
Json parse_case(const std::string& line, std::size_t number);

}  // namespace vericone
