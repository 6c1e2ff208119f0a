// SPDX-License-Identifier: BSD-3-Clause
#include "command/program.h"

#include <unistd.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/sound_arithmetic.h>

#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <system_error>

#include "command/catalogue.h"
#include "command/find_program.h"
#include "json/plain_text.h"
#include "output/standard_output.h"
#include "work/interrupt.h"

namespace vericone {
namespace {

/// The exit status of what ended so, with its line on standard error.
int told(const std::exception_ptr& failure) {
  try {
    std::cout.flush();
  } catch (const std::system_error&) {  // the failure is told, or was this
  }
  // What breaks because of an interruption, such as the script of a picture that gets it too, is not told.
  if (interrupted()) return kExitInterrupted;
  try {
    std::rethrow_exception(failure);
  } catch (const UsageError& e) {
    std::cerr << "vericone: " << plain_text(e.what()) << '\n';
    return 2;
  } catch (const InputError& e) {
    std::cerr << "vericone: " << plain_text(e.what()) << '\n';
    return 2;
  } catch (const std::bad_alloc&) {
    std::cerr << "vericone: not enough memory\n";
    return 1;
  } catch (const std::filesystem::filesystem_error& e) {
    const std::filesystem::path& path = e.path2().empty() ? e.path1() : e.path2();
    std::cerr << "vericone: " << plain_text(path.string()) << ": " << e.code().message() << '\n';
    return 1;
  } catch (const std::exception& e) {
    std::cerr << "vericone: " << plain_text(e.what()) << '\n';
    return 1;
  }
}

/// The exit status of `work`, with the line on standard error where it fails.
template <typename Work>
int guarded(Work work) {
  int status = 0;
  try {
    require_standard_output();
    require_sound_arithmetic();
    try {
      status = work();
    } catch (const Answered&) {
    }
    std::cout.flush();
    return status;
  } catch (...) {
    return told(std::current_exception());
  }
}

int carry_out(Command command, const std::string& called, const std::string& name,
              std::vector<std::string> words) {
  catch_interrupts();
  const CatalogueEntry* entry = find_entry(name);
  CommandLine line(called, name, entry ? entry->what : "", entry ? help_end(*entry) : "", std::move(words));
  return command(line);
}

/// The program goes on as `file`. It is told that it was called as "vericone NAME", so that its help and its
/// provenance say what the user typed.
[[noreturn]] void become(const std::filesystem::path& file, std::string called,
                         std::vector<std::string> words) {
  std::vector<char*> arguments{called.data()};
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(file.c_str(), arguments.data());
  throw std::runtime_error("could not start " + file.string());
}

/// The commands with what they do, and with what is missing of those that are not there.
std::vector<ListedCommand> listed(const std::map<std::string, Command>& commands) {
  std::vector<ListedCommand> list;
  for (const CatalogueEntry& entry : catalogue()) {
    const bool there = commands.contains(entry.name) || find_program(entry.name);
    list.push_back(
        {entry.group, entry.name, there ? entry.what : entry.what + " (needs " + entry.needs + ")"});
  }
  return list;
}

std::string program_of(int argc, char** argv) { return argc > 0 ? argv[0] : "vericone"; }

std::vector<std::string> words_of(int argc, char** argv) {
  return argc > 0 ? std::vector<std::string>(argv + 1, argv + argc) : std::vector<std::string>();
}

}  // namespace

int run_family(int argc, char** argv, const std::map<std::string, Command>& commands) {
  return guarded([&] {
    const std::string program = program_of(argc, argv);
    std::vector<std::string> words = words_of(argc, argv);
    // `vericone help NAME` and `vericone --help NAME` are `vericone NAME --help`.
    if (!words.empty() && words[0] == "help") words[0] = "--help";
    if (words.size() > 1 && (words[0] == "--help" || words[0] == "-h")) std::swap(words[0], words[1]);
    if (words.empty() || words[0].starts_with("-")) answer_without_command(program, listed(commands), words);

    const std::string name = words.front(), called = program + " " + name;
    const std::vector<std::string> rest(words.begin() + 1, words.end());
    if (const auto own = commands.find(name); own != commands.end())
      return carry_out(own->second, called, name, rest);
    if (const auto file = find_program(name)) become(*file, called, rest);
    if (const CatalogueEntry* entry = find_entry(name)) throw InputError(name, entry->lacks, entry->needs);
    answer_without_command(program, listed(commands), words);
  });
}

int run_program(int argc, char** argv, const std::string& name, Command command,
                const std::map<std::string, Command>& others) {
  return guarded([&] {
    const std::string called = program_of(argc, argv);
    const auto other = others.find(called.substr(called.rfind(' ') + 1));
    return other == others.end() ? carry_out(command, called, name, words_of(argc, argv))
                                 : carry_out(other->second, called, other->first, words_of(argc, argv));
  });
}

void hand_over(const std::string& owner, const std::string& command, const std::vector<std::string>& words,
               const std::string& field) {
  if (const auto file = find_program(owner)) become(*file, "vericone " + command, words);
  const CatalogueEntry* entry = find_entry(owner);
  throw InputError(field, entry->lacks, entry->needs);
}

}  // namespace vericone
