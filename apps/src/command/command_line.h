// SPDX-License-Identifier: BSD-3-Clause
//
// The words after a command's name. One file knows the parser behind it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace vericone {

/// The words are wrong: exit status 2. The text ends with a hint to the help that would have told.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Help or version was asked for and has been printed.
struct Answered {};

/// Options and arguments of one command, declared in the order of its help, then read once.
class CommandLine {
 public:
  /// What was declared, for what only few of them need.
  class Option {
   public:
    Option& required();
    Option& shown_default(const std::string& text);  // in the help, instead of the variable's value
    Option& shown_type(const std::string& text);
    Option& words(int least, int most);  // how many it takes; most < 0: any number
    Option& commas();                    // several in one word
    Option& one_each();                  // of a list: one word each time the option is given
    Option& needs(const Option& other);
    Option& within(std::uint64_t least, std::uint64_t most);
    Option& check(std::function<std::string(const std::string&)> complaint);  // empty: the word is good
    bool given() const;

   private:
    friend class CommandLine;
    explicit Option(void* option) : option_(option) {}
    void* option_;  // belongs to the parser
  };

  /// `called`: the words up to the command's name as they were typed. `what`: the command in one line. `end`:
  /// what its help ends with.
  CommandLine(const std::string& called, std::string name, const std::string& what, const std::string& end,
              std::vector<std::string> words);
  ~CommandLine();

  /// An option ("-N,--engagements") or, without dashes, an argument. The value that `target` has is the
  /// default. T: std::string, int, unsigned, std::uint64_t, double, and optionals or vectors of these
  /// (command_line.cpp lists them).
  template <typename T>
  Option option(const std::string& names, T& target, const std::string& what);
  void flag(const std::string& name, bool& target, const std::string& what);
  /// A flag such as --no-figures, which makes `target` false.
  void negative_flag(const std::string& name, bool& target, const std::string& what);

  /// --quiet of a command that shows no progress: the word is taken, so that scripts may say it to all.
  void quiet();

  /// Fills what was declared. Throws UsageError, or Answered after a help or version.
  void read();

  /// The whole command line for provenance, with the program's name for its path.
  std::string text() const;
  /// The command's name and what stands after it.
  std::vector<std::string> words() const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
  std::string name_;
  std::vector<std::string> words_;
  bool quiet_ = false;
};

/// A command as the help of the family lists it.
struct ListedCommand {
  std::string group, name, what;
};

/// Answers words that do not begin with a command: the help that lists `commands`, the version, or what is
/// wrong, with the help where there are no words. Throws UsageError or Answered.
[[noreturn]] void answer_without_command(const std::string& called,
                                         const std::vector<ListedCommand>& commands,
                                         const std::vector<std::string>& words);

}  // namespace vericone
