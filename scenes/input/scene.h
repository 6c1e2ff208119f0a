// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "input/body.h"
#include "input/field_table.h"

namespace vericone::input {

/// What a file is, told by its outermost fields; of cases, by its lines (command/cases.h).
enum class FileKind { unknown, scene, scenario, pursuit, paper, body, cases };

FileKind kind_of_file(const Json& fields);

/// "a scenario"; empty where the kind is unknown.
const char* name_of(FileKind kind);

/// Throws InputError naming the path where the fields are plainly of another kind, and says who reads that.
void require_kind(const Json& fields, FileKind kind, const std::string& path);

/// The fields of a scene file as they stand, unchecked but for the limits of text_source.h and for text that
/// is no UTF-8 or that a terminal would obey.
Json read_scene_fields(const std::string& path);

/// The two in steps: a pipe can be read only once. `path` is named in errors, and files are relative to it.
std::string read_scene_text(const std::string& path);
Json scene_fields(const std::string& text, const std::string& path);
Scene scene_of(const Json& fields, const std::string& path);

/// What a scene's file has beside the fields of an engagement.
const Fields<Scene>& scene_file_fields();

}  // namespace vericone::input
