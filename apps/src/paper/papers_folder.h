// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vericone::paper {

/// The folder of a paper: `given` itself, or the folder of that name among our papers; papers/dhal2022 where
/// nothing is given. Ours stand where VERICONE_PAPERS says, next to the sources in a build, in the data
/// folder when installed. Throws InputError naming --paper.
std::filesystem::path paper_folder(const std::string& given);

/// A small paper that works, with comments, to begin a new one with.
std::filesystem::path template_folder();

/// The files that all its claims and figures are made of, by name.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& paper);

}  // namespace vericone::paper
