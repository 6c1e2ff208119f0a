// SPDX-License-Identifier: BSD-3-Clause
//
// Puts the parts of a command's rows together: their tables become those of one run that was interrupted when
// all rows were there, and the command itself goes on from them.
#include <unistd.h>
#include <vericone/geometry/error.h>
#include <vericone/work/staged_folder.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "command/output_line.h"
#include "commands.h"
#include "json/json_value.h"
#include "output/output_file.h"
#include "output/part.h"
#include "work/file_hash.h"
#include "work/interrupt.h"

namespace vericone {
namespace {

namespace fs = std::filesystem;

struct PartTable {
  std::string file, settings, sha256;  // settings: of the part
};

struct FinishedPart {
  std::string folder;
  Part part;
  std::string version, commit;
  std::vector<std::string> words;  // from the command's name on
  std::vector<PartTable> tables;
  std::map<std::string, std::string> inputs;  // SHA-256 by file
};

FinishedPart read_part(const std::string& folder) {
  const auto refuse = [&]() -> InputError {
    return {"part", folder, "a folder in which a command with --part has finished"};
  };
  const fs::path file = fs::path(folder) / "provenance.json";
  if (!fs::is_regular_file(file)) throw refuse();
  try {
    const Json origin = Json::parse(content_of(file));
    const Json& part = origin.at("part");
    FinishedPart found{.folder = folder,
                       .part = {part.at("number").get<std::uint64_t>(), part.at("of").get<std::uint64_t>()},
                       .version = origin.at("version").get<std::string>(),
                       .commit = origin.at("commit").get<std::string>(),
                       .words = part.at("words").get<std::vector<std::string>>(),
                       .tables = {},
                       .inputs = {}};
    for (const Json& input : origin.at("inputs"))
      if (input.at("sha256").is_string()) found.inputs[input.at("file")] = input.at("sha256");
    for (const Json& table : part.at("tables"))
      found.tables.push_back({table.at("file").get<std::string>(), table.at("settings").get<std::string>(),
                              table.at("sha256").get<std::string>()});
    const bool whole = std::all_of(found.tables.begin(), found.tables.end(), [](const PartTable& table) {
      return fs::path(table.file).filename() == table.file;
    });
    if (found.words.empty() || found.tables.empty() || !whole) throw refuse();
    return found;
  } catch (const Json::exception&) {
    throw refuse();
  }
}

/// What the settings are without the part; empty where they are not those of this part.
std::string settings_of_all(const PartTable& table, const Part& part) {
  const std::size_t end = table.settings.rfind(", part " + part.text() + " of ");
  return end == std::string::npos ? "" : table.settings.substr(0, end);
}

/// The parts in order. Throws InputError naming the one that does not belong to the first, or is missing.
std::vector<FinishedPart> parts_of(const std::vector<std::string>& folders) {
  std::map<std::uint64_t, FinishedPart> parts;
  for (const std::string& folder : folders) {
    FinishedPart part = read_part(folder);
    if (!parts.empty()) {
      const FinishedPart& first = parts.begin()->second;
      const auto same = [&](bool is, const std::string& what, const std::string& got) {
        if (!is) throw InputError("part", folder + " with " + got, "of " + what + ", as " + first.folder);
      };
      const auto text = [](const std::vector<std::string>& words) {
        std::string all;
        for (const std::string& word : words) all += (all.empty() ? "" : " ") + word;
        return all;
      };
      same(part.version == first.version && part.commit == first.commit,
           "version " + first.version + " " + first.commit, "version " + part.version + " " + part.commit);
      same(part.words == first.words, "\"" + text(first.words) + "\"", "\"" + text(part.words) + "\"");
      same(part.part.of == first.part.of, std::to_string(first.part.of) + " parts",
           std::to_string(part.part.of) + " parts");
      same(part.tables.size() == first.tables.size(), std::to_string(first.tables.size()) + " tables",
           std::to_string(part.tables.size()) + " tables");
      for (std::size_t i = 0; i < part.tables.size(); ++i) {
        const std::string one = settings_of_all(first.tables[i], first.part),
                          other = settings_of_all(part.tables[i], part.part);
        same(one == other, "\"" + one + "\"", "\"" + other + "\"");
      }
    }
    const std::uint64_t number = part.part.number;
    if (const auto there = parts.find(number); there != parts.end())
      throw InputError(
          "part", folder,
          "another one than " + there->second.part.text() + ", which is in " + there->second.folder);
    parts.emplace(number, std::move(part));
  }
  const std::uint64_t of = parts.begin()->second.part.of;
  for (std::uint64_t number = 1; number <= of; ++number)
    if (!parts.contains(number))
      throw InputError("part", std::to_string(parts.size()) + " folders",
                       "all " + std::to_string(of) + " parts; " + Part{number, of}.text() + " is missing");
  std::vector<FinishedPart> all;
  for (auto& [number, part] : parts) all.push_back(std::move(part));
  return all;
}

/// The command reads its files again. Throws InputError naming the one that is not what the parts were made
/// of.
void require_inputs(const std::vector<FinishedPart>& parts) {
  std::map<std::string, std::string> now;
  for (const FinishedPart& part : parts)
    for (const auto& [file, then] : part.inputs) {
      if (!now.contains(file)) now[file] = fs::is_regular_file(file) ? sha256_of_file(file) : "";
      if (now[file] != then)
        throw InputError(file, now[file].empty() ? "nothing" : "another content",
                         "what " + part.folder + " was made of, SHA-256 " + then + ": merge reads it again");
    }
}

/// Adds the rows of a part's table; of the first one the lines before them too.
void add_rows(const FinishedPart& part, const PartTable& table, bool first, OutputFile& out) {
  const fs::path file = fs::path(part.folder) / table.file;
  std::ifstream in(file, std::ios::binary);
  std::string settings, header;
  if (!std::getline(in, settings) || !std::getline(in, header) || settings != table.settings ||
      sha256_of_file(file) != table.sha256)
    throw InputError("part", file.string(), "the table that its provenance.json tells of");
  if (first) out.write(settings_of_all(table, part.part) + "\n" + header + "\n");
  std::string piece(std::size_t{1} << 20, '\0');
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0)
    out.write(std::string_view(piece.data(), static_cast<std::size_t>(in.gcount())));
  if (in.bad()) throw std::runtime_error(file.string() + ": could not be read");
}

void merge_tables(const std::vector<FinishedPart>& parts, const std::string& out) {
  for (const FinishedPart& part : parts) {
    std::error_code none;
    if (fs::equivalent(part.folder, out, none))
      throw InputError("--out", out, "another folder than those of the parts");
  }
  work::StagedFolder folder(out, "--out");
  for (std::size_t i = 0; i < parts.front().tables.size(); ++i) {
    const PartTable& of_first = parts.front().tables[i];
    const fs::path whole = folder.resumable(of_first.file);
    std::ifstream unfinished(whole);
    std::string settings;
    if (std::getline(unfinished, settings) && settings != settings_of_all(of_first, parts.front().part))
      throw InputError("--out", out,
                       "a folder without the unfinished run of other settings that " +
                           whole.filename().string() + " holds; delete that file to give it up");
    OutputFile rows(whole, OutputFile::Start::anew);
    for (const FinishedPart& part : parts) {
      checkpoint();
      add_rows(part, part.tables[i], &part == &parts.front(), rows);
    }
    rows.close();
  }
}

/// The command that made the parts, of all rows: it finds them done.
[[noreturn]] void go_on(std::vector<std::string> words) {
  std::vector<char*> arguments;
  std::string program = "vericone";
  arguments.push_back(program.data());
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv("/proc/self/exe", arguments.data());
  throw std::runtime_error("could not start vericone " + words.front());
}

}  // namespace

int merge_command(CommandLine& line) {
  OutputOptions options;
  std::vector<std::string> folders;
  line.option("part", folders, "Folders of all parts of one command, in any order").required().words(1, -1);
  read_output_line(line, options);
  const std::vector<FinishedPart> parts = parts_of(folders);
  require_inputs(parts);
  merge_tables(parts, options.out);
  std::vector<std::string> words = parts.front().words;
  words.insert(words.end(), {"--out", options.out, "--threads", std::to_string(options.threads)});
  if (!options.figures) words.emplace_back("--no-figures");
  if (options.quiet) words.emplace_back("--quiet");
  if (options.json) words.emplace_back("--json");
  go_on(std::move(words));
}

}  // namespace vericone
