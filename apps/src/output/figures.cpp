// SPDX-License-Identifier: BSD-3-Clause
#include "output/figures.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace vericone {
namespace {

std::filesystem::path scripts_folder() {
  if (const char* given = std::getenv("VERICONE_FIGURES")) return given;
  if (std::filesystem::is_directory(VERICONE_FIGURE_SCRIPTS)) return VERICONE_FIGURE_SCRIPTS;
  return VERICONE_INSTALLED_FIGURE_SCRIPTS;
}

/// Debian's own interpreter, by its full path: Python looks for its libraries from the name it is called by,
/// and another python3 on the PATH (an active environment's) need not have matplotlib.
std::string interpreter() {
  const char* given = std::getenv("VERICONE_PYTHON");
  return given && *given ? given : "/usr/bin/python3";
}

/// Runs a script with the modules beside it and those of the first folder. The interpreter is isolated (-I):
/// variables, the user's own packages and the folder it is called in mean nothing to it.
constexpr const char* kStart =
    "import os, runpy, sys; modules, script = sys.argv[1:3]; "
    "sys.path[:0] = [os.path.dirname(script), modules]; sys.argv = sys.argv[2:]; "
    "runpy.run_path(script, run_name='__main__')";

/// Whether the last line of a script that failed says that a package is missing.
bool lacks_package(const std::string& line) {
  constexpr std::string_view kMissing = "ModuleNotFoundError: No module named '";
  return line.starts_with(kMissing);
}

constexpr int kNoInterpreter = 127;  // exit status of a child that could not become the interpreter

void say_no_pictures(const std::string& why) {
  static bool said = false;
  if (!said)
    std::cerr << "vericone: no pictures: " << why
              << "; a Python with numpy and matplotlib draws them, another one than "
                 "/usr/bin/python3 by VERICONE_PYTHON\n";
  said = true;
}

}  // namespace

void draw_figures(const std::string& script, const std::filesystem::path& folder) {
  const std::filesystem::path scripts = scripts_folder(), file = scripts / script;
  if (!std::filesystem::exists(file)) throw std::runtime_error("figure script not found: " + file.string());
  const std::string python = interpreter(), scripts_text = scripts.string(), file_text = file.string(),
                    folder_text = folder.string();
  std::array<int, 2> channel{};
  if (pipe(channel.data()) != 0) throw std::runtime_error("no pipe for the figure script");
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw std::runtime_error("could not start the figure script");
  if (child == 0) {
    // A picture that nobody waits for is not drawn.
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) std::_Exit(kNoInterpreter);
    dup2(channel[1], STDOUT_FILENO);
    dup2(channel[1], STDERR_FILENO);
    close(channel[0]);
    close(channel[1]);
    execlp(python.c_str(), python.c_str(), "-I", "-c", kStart, scripts_text.c_str(), file_text.c_str(),
           folder_text.c_str(), static_cast<char*>(nullptr));
    std::_Exit(kNoInterpreter);
  }
  close(channel[1]);
  std::string output;
  std::array<char, 4096> buffer{};
  for (ssize_t n = 0; (n = read(channel[0], buffer.data(), buffer.size())) > 0 || (n < 0 && errno == EINTR);)
    if (n > 0) output.append(buffer.data(), static_cast<std::size_t>(n));
  close(channel[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  std::istringstream lines(output);
  std::string line, last;
  while (std::getline(lines, line))
    if (!line.empty()) last = line;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNoInterpreter) {
    say_no_pictures("no interpreter " + python);
  } else if (lacks_package(last)) {
    say_no_pictures(python + " says " + last);
  } else {
    throw std::runtime_error(script + " failed: " + (last.empty() ? python + " ended without a word" : last));
  }
}

std::vector<std::filesystem::path> pictures_of(const std::vector<std::filesystem::path>& files) {
  std::vector<std::filesystem::path> pictures;
  for (const auto& file : files)
    if (file.extension() == ".png" || file.extension() == ".pdf") pictures.push_back(file);
  return pictures;
}

}  // namespace vericone
