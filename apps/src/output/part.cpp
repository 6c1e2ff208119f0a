// SPDX-License-Identifier: BSD-3-Clause
#include "output/part.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <ostream>
#include <tuple>

#include "output/output_file.h"
#include "work/file_hash.h"

namespace vericone {
namespace {

std::optional<std::uint64_t> count_of(const std::string& text) {
  constexpr std::size_t kMostDigits = 9;
  const bool digits = !text.empty() && text.size() <= kMostDigits &&
                      std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  return digits ? std::optional<std::uint64_t>(std::stoull(text)) : std::nullopt;
}

/// The words that say what the rows are: not where they go, or how.
std::vector<std::string> that_matter(const std::vector<std::string>& words) {
  return words_without(words, {"--out", "--part", "--threads"}, {"--quiet", "--json", "--no-figures"});
}

}  // namespace

std::vector<std::string> words_without(const std::vector<std::string>& words,
                                       std::initializer_list<std::string_view> with_value,
                                       std::initializer_list<std::string_view> flags) {
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string name = words[i].substr(0, words[i].find('='));
    if (std::find(flags.begin(), flags.end(), name) != flags.end()) continue;
    if (std::find(with_value.begin(), with_value.end(), name) == with_value.end())
      kept.push_back(words[i]);
    else if (name == words[i])
      ++i;
  }
  return kept;
}

std::string Part::text() const { return std::to_string(number) + "/" + std::to_string(of); }

std::optional<Part> part_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::size_t slash = text.find('/');
  const auto number = count_of(text.substr(0, slash)),
             of = slash == std::string::npos ? std::nullopt : count_of(text.substr(slash + 1));
  if (!number || !of || *number < 1 || *number > *of)
    throw InputError("--part", text, "K/N, the K-th of N parts, such as 3/8");
  return Part{*number, *of};
}

std::pair<std::uint64_t, std::uint64_t> share_of(std::uint64_t count, const Part& part) {
  const std::uint64_t each = count / part.of, more = count % part.of;
  const auto begin = [&](std::uint64_t parts) { return parts * each + std::min(parts, more); };
  return {begin(part.number - 1), begin(part.number)};
}

work::ResumableTable rows_of_part(work::ResumableTable table, const Part& part) {
  table.settings += ", part " + part.text() + " of " + std::to_string(table.count) + " rows";
  std::tie(table.first, table.count) = share_of(table.count, part);
  return table;
}

void require_no_other_result(const OutputOptions& options, const work::StagedFolder& folder,
                             const Part& part) {
  const std::filesystem::path file = folder.published(folder.path() / "provenance.json");
  if (!std::filesystem::exists(file)) return;
  const Json origin = Json::parse(content_of(file), nullptr, false);
  const Json* const there = origin.is_object() && origin.contains("part") ? &origin["part"] : nullptr;
  if (there && there->is_object() && there->value("number", 0U) == part.number &&
      there->value("of", 0U) == part.of && there->value("words", Json()) == that_matter(options.words))
    return;
  throw InputError(
      "--out", options.out,
      "a folder without another result, whose provenance.json is there; delete it to give that up");
}

int publish_part(const OutputOptions& options, work::StagedFolder& folder,
                 const std::vector<work::ResumableTable>& tables, Json origin, std::ostream& out) {
  const Part part = part_of(options.part).value();
  Json& kept = origin["part"] = {{"number", part.number},
                                 {"of", part.of},
                                 {"words", that_matter(options.words)},
                                 {"tables", Json::array()}};
  for (const work::ResumableTable& table : tables)
    kept["tables"].push_back({{"file", table.name},
                              {"settings", rows_of_part(table, part).settings},
                              {"sha256", sha256_of_file(folder.resumable(table.name))}});
  write_whole(folder.path() / "provenance.json", origin.dump(1) + "\n");
  folder.publish();
  if (options.json)
    out << kept.dump(1) << '\n';
  else
    out << "part " << part.text() << " is in " << options.out << "; vericone merge puts all parts together\n";
  return 0;
}

}  // namespace vericone
