// SPDX-License-Identifier: BSD-3-Clause
#include "command/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <iostream>
#include <limits>
#include <list>
#include <optional>
#include <type_traits>

#include "command/build_info.h"

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
                         std::vector<std::string> words)
    : parser_(std::make_unique<Parser>(what, called)), name_(std::move(name)), words_(std::move(words)) {}

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

void CommandLine::read() {
  // Every program of the family knows its version; the help of the whole family says so once.
  if (words_ == std::vector<std::string>{"--version"}) {
    std::cout << version_line() << '\n';
    throw Answered{};
  }
  read_words(parser_->app, words_);
  for (const auto& [given, target] : parser_->negative)
    if (given) *target = false;
}

std::string CommandLine::text() const {
  std::string text = "vericone " + name_;
  for (const std::string& word : words_) text.append(" ").append(word);
  return text;
}

void answer_without_command(const std::string& called,
                            const std::vector<std::pair<std::string, std::string>>& commands,
                            const std::vector<std::string>& words) {
  CLI::App app("Collision cones with certified bounds", called);
  app.set_version_flag("--version", version_line());
  app.require_subcommand(1);
  for (const auto& [name, what] : commands) app.add_subcommand(name, what);
  read_words(app, words);
  throw UsageError("A subcommand is required");
}

}  // namespace vericone
