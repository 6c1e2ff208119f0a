// SPDX-License-Identifier: BSD-3-Clause
//
// What a source prints, and what we get (docs/reference/papers.md, "Claims").
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "json/json_value.h"
#include "paper/text.h"

namespace vericone::paper {

enum class Kind : std::uint8_t {
  result,      // comes out of a run or a command
  code,        // the same, resting on values that are not printed but stand in the authors' program
  given,       // goes into a run, or is ordered by it
  arithmetic,  // of the source's own numbers and formulas: nothing of ours is in it
};
const char* to_string(Kind kind);

enum class Verdict : std::uint8_t {
  given,         // goes into the run and was read back from it as printed
  consistent,    // the source's own numbers agree with one another
  reproduced,    // ours agrees within the tolerance
  by_code,       // ours agrees, by values of the authors' program
  fitted,        // it agrees because a value that is not printed was chosen so: consistent, no more
  not_engaged,   // nothing was commanded against that obstacle: what happened says nothing about the law
  not_decided,   // it does not agree, and ours rests on values that the source does not print
  differs,       // it does not agree, and what is printed decides
  source_wrong,  // what is printed contradicts itself or is shown wrong
};
inline constexpr Verdict kVerdicts[] = {Verdict::given,       Verdict::consistent, Verdict::reproduced,
                                        Verdict::by_code,     Verdict::fitted,     Verdict::not_engaged,
                                        Verdict::not_decided, Verdict::differs,    Verdict::source_wrong};
const char* to_string(Verdict verdict);
/// Whether ours agrees with what is printed.
bool agrees(Verdict verdict);

/// Something that the source does not print: how many numbers it is and, where that is stated, where they
/// stand and between what they may lie.
struct Chosen {
  std::string name;
  int numbers = 1;
  std::vector<std::string> files;  // of the paper's folder, the same numbers in each; empty: not stated
  std::vector<std::string> paths;  // of the numbers, as pointer_to takes them
  std::vector<std::pair<double, double>> ranges;
  bool whole = false, logarithmic = false;
};

/// Values that the source does not print, chosen so that printed numbers come out.
struct Fit {
  std::string name;
  std::vector<Chosen> chosen;
  /// Of the claims that rest on it: those that come out, all measured ones, and those not measured this time.
  int explains = 0, claims = 0, unmeasured = 0;

  int count() const;
  std::string text() const;  // "K, w: 2 free numbers"
};

/// A claim, measured.
struct Claim {
  std::string id;       // "5.4.1/y-0"
  std::string section;  // of the source
  std::vector<std::string> figures;
  Kind kind = Kind::result;
  std::string what;
  std::string printed, ours;  // as text, with units
  std::optional<double> printed_value, ours_value, tolerance;
  bool later = false;  // the tolerance is one-sided
  std::string tolerance_reason;
  Verdict verdict = Verdict::differs;
  std::string note;
  std::vector<std::shared_ptr<Fit>> fits;  // that it rests on, met or not; shared by all claims
  Scope::Origins origins;                  // what ours is measured on
};
/// Which claims are meant.
using Which = std::function<bool(const Claim&)>;

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
  std::vector<std::shared_ptr<Fit>> fits;
  std::vector<ClaimEntry> entries;
};

/// Checks all that can be without a run. Throws InputError naming the field.
ClaimsFile read_claims(const Json& fields);
/// In the order of the file, those of `which` but for those whose program is not there.
std::vector<Claim> measure(ClaimsFile& file, Sources& sources, const Which& which);
/// How many of `which` are not measured for want of a program, by its command.
std::map<std::string, int> left_out(const ClaimsFile& file, const Which& which);

Json to_json(const Claim& claim);
/// How many claims of each kind got each verdict.
Json count_verdicts(const std::vector<Claim>& claims);

/// `fields` with what its mappings take from templates: a mapping with "like: NAME", or a list of names, has
/// all fields of templates.NAME that it does not have itself, and so within it; later ones come first. Throws
/// InputError.
Json with_templates(const Json& fields);
/// Fields that the values and series of an entry take from its `of`, as far as their table has such columns.
Json with_defaults(const Json& series, const Json& of);

}  // namespace vericone::paper
