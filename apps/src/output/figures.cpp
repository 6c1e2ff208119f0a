// SPDX-License-Identifier: BSD-3-Clause
#include "output/figures.h"

#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string_view>

#include "output/child.h"
#include "output/shared_folder.h"

namespace vericone {
namespace {

std::filesystem::path scripts_folder() {
  if (const char* given = std::getenv("VERICONE_FIGURES")) return given;
  return shared_folder("figures");
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
  const std::string python = interpreter();
  const ChildOutput child =
      run_child(python, {"-I", "-c", kStart, scripts.string(), file.string(), folder.string()});
  if (child.status == 0) return;
  const std::string last = last_line(child.errors.empty() ? child.output : child.errors);
  if (child.status == kNotStarted)
    say_no_pictures("no interpreter " + python);
  else if (lacks_package(last))
    say_no_pictures(python + " says " + last);
  else
    throw std::runtime_error(script + " failed: " + (last.empty() ? python + " ended without a word" : last));
}

std::vector<std::filesystem::path> pictures_of(const std::vector<std::filesystem::path>& files) {
  std::vector<std::filesystem::path> pictures;
  for (const auto& file : files)
    if (file.extension() == ".png" || file.extension() == ".pdf") pictures.push_back(file);
  return pictures;
}

}  // namespace vericone
