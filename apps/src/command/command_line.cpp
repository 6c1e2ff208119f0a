// SPDX-License-Identifier: BSD-3-Clause
#include "command/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <iostream>
#include <limits>
#include <list>
#include <optional>
#include <string_view>
#include <type_traits>

#include "work/build_info.h"

namespace vericone {
namespace {

CLI::Option& parsed(void* option) { return *static_cast<CLI::Option*>(option); }

std::string version_line() {
  return std::string("vericone ") + build_info::version() + " (" + build_info::commit() + ")";
}

/// Whether the help can show what a variable has.
template <typename T>
bool has_value(const T&) {
  return true;
}
template <typename T>
bool has_value(const std::optional<T>& value) {
  return value.has_value();
}
template <typename T>
bool has_value(const std::vector<T>& value) {
  return !value.empty();
}

/// How many letters have to be typed anew, put in, left out or exchanged with the next to get from one word
/// to the other.
std::size_t letters_between(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t k = 0; k <= b.size(); ++k) {
      if (i == 0 || k == 0) {
        d[i][k] = i + k;
        continue;
      }
      d[i][k] = std::min({d[i - 1][k] + 1, d[i][k - 1] + 1, d[i - 1][k - 1] + (a[i - 1] != b[k - 1])});
      if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1])
        d[i][k] = std::min(d[i][k], d[i - 2][k - 2] + 1);
    }
  return d[a.size()][b.size()];
}

/// ", did you mean ...", or nothing where no word is near.
std::string nearest(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::size_t kLongest = 40;  // no command or option is longer
  if (word.size() > kLongest) return "";
  std::string best;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : known) {
    // The beginning of a word is near, however much follows.
    const bool begins = word.size() > 3 && candidate.starts_with(word);
    const std::size_t distance = begins ? 1 : letters_between(word, candidate);
    if (distance >= least) continue;
    least = distance;
    best = candidate;
  }
  return best.empty() ? "" : ", did you mean " + best;
}

/// The first word that is written as an option and is none: it is the mistake, whatever else is missing then.
void refuse_unknown_options(const CLI::App& app, const std::vector<std::string>& words) {
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (const std::string& word : words) {
    if (word == "--") return;
    const bool is_long = word.size() > 2 && word.starts_with("--");
    const bool is_short = !is_long && word.size() > 1 && word[0] == '-' &&
                          std::isalpha(static_cast<unsigned char>(word[1])) != 0;
    if (!is_long && !is_short) continue;
    const std::string name = is_long ? word.substr(0, word.find('=')) : word.substr(0, 2);
    if (app.get_option_no_throw(name) == nullptr) {
      const std::string shown = is_long ? name : word;
      throw UsageError("no option " + shown + nearest(is_long ? shown : "-" + shown, known));
    }
  }
}

/// The parser takes -1 for the largest number there is.
template <typename T>
std::string not_a_count(const std::string& word) {
  T count = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (error == std::errc() && end == word.data() + word.size()) return "";
  return "got " + word + ", must be a whole number between 0 and " +
         std::to_string(std::numeric_limits<T>::max());
}

void read_words(CLI::App& app, const std::vector<std::string>& words) {
  const bool asks = std::any_of(words.begin(), words.end(),
                                [](const std::string& word) { return word == "-h" || word == "--help"; });
  if (!asks) refuse_unknown_options(app, words);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::CallForHelp& e) {
    app.exit(e);
    throw Answered{};
  } catch (const CLI::CallForVersion& e) {
    app.exit(e);
    throw Answered{};
  } catch (const CLI::ParseError& e) {
    std::string text = e.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    constexpr std::string_view kTwice = " At Most 1 required but received ";
    if (const std::size_t at = text.find(kTwice); at != std::string::npos)
      text = text.substr(0, at) + " given " + text.substr(at + kTwice.size()) + " times, must be given once";
    throw UsageError(text);
  }
}

}  // namespace

CommandLine::Option& CommandLine::Option::required() {
  parsed(option_).required();
  return *this;
}

CommandLine::Option& CommandLine::Option::shown_default(const std::string& text) {
  parsed(option_).default_str(text);
  return *this;
}

CommandLine::Option& CommandLine::Option::shown_type(const std::string& text) {
  parsed(option_).type_name(text);
  return *this;
}

CommandLine::Option& CommandLine::Option::words(int least, int most) {
  parsed(option_).expected(least, most);
  return *this;
}

CommandLine::Option& CommandLine::Option::one_each() {
  parsed(option_).allow_extra_args(false);
  return *this;
}

CommandLine::Option& CommandLine::Option::commas() {
  parsed(option_).delimiter(',');
  return *this;
}

CommandLine::Option& CommandLine::Option::needs(const Option& other) {
  parsed(option_).needs(&parsed(other.option_));
  return *this;
}

CommandLine::Option& CommandLine::Option::within(std::uint64_t least, std::uint64_t most) {
  parsed(option_).check(CLI::Range(least, most));
  return *this;
}

CommandLine::Option& CommandLine::Option::check(std::function<std::string(const std::string&)> complaint) {
  parsed(option_).check(std::move(complaint));
  return *this;
}

bool CommandLine::Option::given() const { return parsed(option_).count() > 0; }

struct CommandLine::Parser {
  Parser(const std::string& what, const std::string& called) : app(what, called) {}

  CLI::App app;
  std::list<std::pair<bool, bool*>> negative;  // whether it was given, and what it makes false
};

CommandLine::CommandLine(const std::string& called, std::string name, const std::string& what,
                         const std::string& end, std::vector<std::string> words)
    : parser_(std::make_unique<Parser>(what, called)), name_(std::move(name)), words_(std::move(words)) {
  parser_->app.footer(end);
}

CommandLine::~CommandLine() = default;

template <typename T>
CommandLine::Option CommandLine::option(const std::string& names, T& target, const std::string& what) {
  CLI::Option* option = parser_->app.add_option(names, target, what);
  if (has_value(target)) option->capture_default_str();
  if constexpr (std::is_same_v<T, unsigned>) option->check(not_a_count<unsigned>);
  if constexpr (std::is_same_v<T, std::uint64_t> || std::is_same_v<T, std::optional<std::uint64_t>>)
    option->check(not_a_count<std::uint64_t>);
  return Option(option);
}

template CommandLine::Option CommandLine::option(const std::string&, std::string&, const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, int&, const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, unsigned&, const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, std::uint64_t&, const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, double&, const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, std::optional<int>&, const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, std::optional<std::uint64_t>&,
                                                 const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, std::optional<double>&,
                                                 const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, std::vector<std::string>&,
                                                 const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, std::vector<int>&, const std::string&);
template CommandLine::Option CommandLine::option(const std::string&, std::vector<double>&,
                                                 const std::string&);

void CommandLine::flag(const std::string& name, bool& target, const std::string& what) {
  parser_->app.add_flag(name, target, what);
}

void CommandLine::negative_flag(const std::string& name, bool& target, const std::string& what) {
  parser_->app.add_flag(name, parser_->negative.emplace_back(false, &target).first, what);
}

void CommandLine::quiet() { flag("--quiet", quiet_, "No progress; this command shows none"); }

void CommandLine::read() {
  // Every program of the family knows its version; the help of the whole family says so once.
  if (words_ == std::vector<std::string>{"--version"}) {
    std::cout << version_line() << '\n';
    throw Answered{};
  }
  try {
    read_words(parser_->app, words_);
  } catch (const UsageError& e) {
    throw UsageError(e.what() + (" (see vericone " + name_) + " --help)");
  }
  for (const auto& [given, target] : parser_->negative)
    if (given) *target = false;
}

std::vector<std::string> CommandLine::words() const {
  std::vector<std::string> words{name_};
  words.insert(words.end(), words_.begin(), words_.end());
  return words;
}

std::string CommandLine::text() const {
  std::string text = "vericone";
  for (const std::string& word : words()) text.append(" ").append(word);
  return text;
}

void answer_without_command(const std::string& called, const std::vector<ListedCommand>& commands,
                            const std::vector<std::string>& words) {
  CLI::App app("Collision cones with certified bounds", called);
  app.set_version_flag("--version", version_line());
  for (const auto& [group, name, what] : commands) app.add_subcommand(name, what)->group(group);
  app.footer(
      "vericone COMMAND --help says what a command takes, with examples.\n"
      "Words, units, signs and exit statuses: docs/reference/conventions.md.");
  if (words.empty()) {
    std::cerr << app.help();
    throw UsageError("no command given");
  }
  constexpr const char* kHint = " (see vericone --help)";
  if (!words.front().starts_with("-")) {
    std::vector<std::string> names;
    names.reserve(commands.size());
    for (const ListedCommand& command : commands) names.push_back(command.name);
    std::string instead = nearest(words.front(), names);
    for (const std::string& name : names)
      if (!instead.starts_with(", did")) instead.append(instead.empty() ? "; there are " : ", ").append(name);
    throw UsageError("no subcommand " + words.front() + instead + kHint);
  }
  try {
    read_words(app, words);
  } catch (const UsageError& e) {
    throw UsageError(std::string(e.what()) + kHint);
  }
  throw UsageError(std::string("no command given") + kHint);
}

}  // namespace vericone
