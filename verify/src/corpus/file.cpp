// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/verify/corpus.h>

#include <vericone/internal/geometry/exact/integer.h>
#include <algorithm>
#include <charconv>
#include <fstream>
#include <istream>
#include <sstream>
#include <stdexcept>

namespace vericone::verify {
namespace {

using exact::Integer, exact::Rational;

constexpr int kLongestExponent = 5000;  // doubles need 1,100; products of a few of them fit

int parse_exponent(std::string_view text) {
  int e = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), e);
  if (error != std::errc() || end != text.data() + text.size() || std::abs(e) > kLongestExponent)
    throw std::runtime_error("\"" + std::string(text) + "\" is not an exponent between -5000 and 5000");
  return e;
}

Integer parse_integer(std::string_view text) {
  const std::string_view digits = text.starts_with('-') ? text.substr(1) : text;
  if (digits.empty() || digits.size() > 2000 ||
      !std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; }))
    throw std::runtime_error("\"" + std::string(text) + "\" is not an integer");
  // A leading zero would be read as octal.
  const auto first = std::min(digits.find_first_not_of('0'), digits.size() - 1);
  const Integer value(std::string(digits.substr(first)));
  return text.starts_with('-') ? Integer(-value) : value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

CorpusCase parse_case(std::string_view line) {
  static constexpr std::array<const char*, 7> kColumns = {"predicate", "family", "kind", "index",
                                                          "truth",     "source", "rung"};
  const auto words = split(line, ' ');
  if (words.size() <= kColumns.size())
    throw std::runtime_error("field " +
                             std::string(kColumns[std::min(words.size() - 1, kColumns.size() - 1)]) +
                             ": the line ends after it; seven columns and the numbers are needed");
  for (std::size_t i = 0; i < kColumns.size(); ++i)
    if (words[i].empty()) throw std::runtime_error(std::string("field ") + kColumns[i] + ": empty");
  CorpusCase c;
  c.predicate = words[0];
  c.family = words[1];
  c.kind = words[2];
  const auto [end, error] = std::from_chars(words[3].data(), words[3].data() + words[3].size(), c.index);
  if (error != std::errc() || end != words[3].data() + words[3].size())
    throw std::runtime_error("field index: \"" + std::string(words[3]) + "\" is not a number");
  c.truth = words[4];
  c.source = words[5];
  c.rung = words[6];
  if (std::find(kCorpusPredicates.begin(), kCorpusPredicates.end(), c.predicate) == kCorpusPredicates.end())
    throw std::runtime_error("field predicate: \"" + c.predicate + "\" is not known");
  if (c.source != "construction" && c.source != "exact")
    throw std::runtime_error("field source: \"" + c.source + "\" is neither construction nor exact");
  if (c.rung != "any" && c.rung != "triage" && c.rung != "interval" && c.rung != "exact")
    throw std::runtime_error("field rung: \"" + c.rung + "\" is none of any, triage, interval, exact");
  for (std::size_t i = kColumns.size(); i < words.size(); ++i) {
    const auto equals = words[i].find('=');
    if (equals == std::string_view::npos || equals == 0)
      throw std::runtime_error("field " + std::string(words[i]) + ": NAME=NUMBER,NUMBER,... is needed");
    CorpusField field{std::string(words[i].substr(0, equals)), {}};
    try {
      for (const auto number : split(words[i].substr(equals + 1), ','))
        field.values.push_back(parse_number(number));
    } catch (const std::exception& e) {
      throw std::runtime_error("field " + field.name + ": " + e.what());
    }
    if (c.has(field.name)) throw std::runtime_error("field " + field.name + ": given twice");
    c.fields.push_back(std::move(field));
  }
  return c;
}

}  // namespace

std::string number_text(const Rational& x) {
  const Integer n = numerator(x), d = denominator(x);
  static const Integer kShort = Integer(1) << 64;
  if (d == 1 && abs(n) < kShort) return n.str();
  const bool dyadic = (d & (d - 1)) == 0;
  if (!dyadic || (d <= (1 << 16) && abs(n) < kShort)) return n.str() + "/" + d.str();
  const unsigned up = lsb(abs(n)), down = lsb(d);  // one of the two is 0
  return Integer(n < 0 ? -(-n >> up) : n >> up).str() + "*2^" +
         std::to_string(static_cast<int>(up) - static_cast<int>(down));
}

Rational parse_number(std::string_view text) {
  if (const auto slash = text.find('/'); slash != std::string_view::npos) {
    const Integer d = parse_integer(text.substr(slash + 1));
    if (d <= 0)
      throw std::runtime_error("\"" + std::string(text) + "\" has a denominator that is not positive");
    return {parse_integer(text.substr(0, slash)), d};
  }
  if (const auto power = text.find("*2^"); power != std::string_view::npos) {
    const Integer m = parse_integer(text.substr(0, power));
    const int e = parse_exponent(text.substr(power + 3));
    if (e >= 0) return Rational(Integer(m << static_cast<unsigned>(e)));
    return {m, Integer(Integer(1) << static_cast<unsigned>(-e))};
  }
  return Rational(parse_integer(text));
}

std::string case_line(const CorpusCase& c) {
  std::string line = c.predicate + ' ' + c.family + ' ' + c.kind + ' ' + std::to_string(c.index) + ' ' +
                     c.truth + ' ' + c.source + ' ' + c.rung;
  for (const CorpusField& field : c.fields) {
    line += ' ' + field.name;
    char before = '=';
    for (const Rational& x : field.values) {
      line += before + number_text(x);
      before = ',';
    }
  }
  return line;
}

std::string corpus_text(std::string_view predicate, std::uint64_t seed) {
  std::string text = "# vericone corpus, format 1: " + std::string(predicate) + ", seed " +
                     std::to_string(seed) + " (tests/corpus/README.md)\n";
  for (const CorpusCase& c : corpus_cases(predicate, seed)) text += case_line(c) + '\n';
  return text;
}

std::vector<CorpusCase> read_corpus(std::istream& in, const std::string& name) {
  std::vector<CorpusCase> cases;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty() || line.starts_with('#')) continue;
    try {
      cases.push_back(parse_case(line));
    } catch (const std::exception& e) {
      throw std::runtime_error(name + ":" + std::to_string(number) + ": " + e.what());
    }
  }
  if (in.bad()) throw std::runtime_error(name + ": could not be read");
  return cases;
}

std::vector<CorpusCase> read_corpus(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(file.string() + ": could not be opened");
  return read_corpus(in, file.string());
}

}  // namespace vericone::verify
