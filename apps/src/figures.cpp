// SPDX-License-Identifier: BSD-3-Clause
#include "figures.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace vericone {
namespace {

std::filesystem::path scripts_folder() {
  if (const char* given = std::getenv("VERICONE_FIGURES")) return given;
  if (std::filesystem::is_directory(VERICONE_FIGURE_SCRIPTS)) return VERICONE_FIGURE_SCRIPTS;
  return VERICONE_INSTALLED_FIGURE_SCRIPTS;
}

}  // namespace

std::vector<std::filesystem::path> draw_figures(const std::string& script,
                                                const std::filesystem::path& folder) {
  const std::filesystem::path scripts = scripts_folder(), file = scripts / script;
  if (!std::filesystem::exists(file)) throw std::runtime_error("figure script not found: " + file.string());
  std::array<int, 2> channel{};
  if (pipe(channel.data()) != 0) throw std::runtime_error("no pipe for the figure script");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("could not start the figure script");
  if (child == 0) {
    dup2(channel[1], STDOUT_FILENO);
    dup2(channel[1], STDERR_FILENO);
    close(channel[0]);
    close(channel[1]);
    const std::string file_text = file.string(), folder_text = folder.string();
    setenv("PYTHONPATH", scripts.c_str(), 1);
    // Debian's own interpreter: another python3 on the PATH need not have matplotlib.
    execl("/usr/bin/python3", "python3", file_text.c_str(), folder_text.c_str(), static_cast<char*>(nullptr));
    std::_Exit(127);
  }
  close(channel[1]);
  std::string output;
  std::array<char, 4096> buffer{};
  for (ssize_t n = 0; (n = read(channel[0], buffer.data(), buffer.size())) > 0;)
    output.append(buffer.data(), static_cast<std::size_t>(n));
  close(channel[0]);
  int status = 0;
  waitpid(child, &status, 0);
  std::istringstream lines(output);
  std::vector<std::filesystem::path> pictures;
  std::string line, last;
  while (std::getline(lines, line)) {
    if (!line.empty()) last = line;
    if (line.starts_with("picture ")) pictures.emplace_back(line.substr(8));
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(script +
                             " failed: " + (last.empty() ? "no /usr/bin/python3 with matplotlib" : last));
  return pictures;
}

}  // namespace vericone
