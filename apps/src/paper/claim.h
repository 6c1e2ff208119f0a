// SPDX-License-Identifier: BSD-3-Clause
//
// What a source prints, and what we get (docs/reference/papers.md, "Claims").
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "json/json_value.h"
#include "paper/text.h"

namespace vericone::paper {

enum class Verdict : std::uint8_t {
  given,         // goes into the run and was read back from it as printed
  reproduced,    // ours agrees within the tolerance
  fitted,        // it agrees because a value that is not printed was chosen so: consistent, no more
  not_engaged,   // nothing was commanded against that obstacle: what happened says nothing about the law
  not_decided,   // it does not agree, and ours rests on values that the source does not print
  differs,       // it does not agree, and what is printed decides
  source_wrong,  // what is printed contradicts itself or is shown wrong
};
inline constexpr Verdict kVerdicts[] = {Verdict::given,       Verdict::reproduced,  Verdict::fitted,
                                        Verdict::not_engaged, Verdict::not_decided, Verdict::differs,
                                        Verdict::source_wrong};
const char* to_string(Verdict verdict);

/// Values that the source does not print, chosen so that printed numbers come out: how many, by name.
struct Fit {
  std::string name;
  std::vector<std::pair<std::string, int>> free;
  /// Of the claims that belong to it, those that come out, and all.
  int explains = 0, claims = 0;

  int count() const;
  std::string text() const;  // "K, w: 2 free numbers"
};

/// A claim, measured.
struct Claim {
  std::string id;       // "5.4.1/y-0"
  std::string section;  // of the source
  std::vector<std::string> figures;
  bool given = false;  // a number that goes into the run; otherwise one that comes out
  std::string what;
  std::string printed, ours;  // as text, with units
  std::optional<double> printed_value, ours_value, tolerance;
  bool later = false;  // the tolerance is one-sided
  std::string tolerance_reason;
  Verdict verdict = Verdict::differs;
  std::string note;
  std::shared_ptr<Fit> fit;  // that it belongs to; shared by all of them
};

/// A claim as it stands in claims.yaml. What it measures: numbers, or whether something holds.
struct ClaimEntry {
  Claim claim;        // what is known before anything is measured
  std::string needs;  // a command in a program of its own, without which it is not measured; empty: none
  std::string unit;
  std::vector<double> printed;  // numbers that go in, read back by `ours`
  std::vector<Expression> ours;
  std::optional<Expression> holds, engaged, tolerance;
  Verdict otherwise = Verdict::differs;             // where it does not agree
  Text printed_text, text, note, tolerance_reason;  // the first one of statements
  std::shared_ptr<Scope> values;
};

struct ClaimsFile {
  std::shared_ptr<Scope> values;
  std::vector<ClaimEntry> entries;
};

/// Checks all that can be without a run. Throws InputError naming the field.
ClaimsFile read_claims(const Json& fields);
/// In the order of the file, every one measured but those whose program is not there.
std::vector<Claim> measure(ClaimsFile& file, Sources& sources);
/// How many are not measured for want of a program, by its command.
std::map<std::string, int> left_out(const ClaimsFile& file);

Json to_json(const Claim& claim);
/// How many results and given values got each verdict.
Json count_verdicts(const std::vector<Claim>& claims);

/// `fields` with what its mappings take from templates: a mapping with "like: NAME", or a list of names, has
/// all fields of templates.NAME that it does not have itself, and so within it; later ones come first. Throws
/// InputError.
Json with_templates(const Json& fields);
/// Fields that the values and series of an entry take from its `of`, as far as their table has such columns.
Json with_defaults(const Json& series, const Json& of);

}  // namespace vericone::paper
