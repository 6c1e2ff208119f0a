// SPDX-License-Identifier: BSD-3-Clause
#include "output/child.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace vericone {

ChildOutput run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                      const std::filesystem::path& folder) {
  // All that the child needs is made before it is, which may do little more than become the program.
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> list;
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  const std::string place = folder.string();
  std::array<std::array<int, 2>, 2> pipes{};
  for (auto& ends : pipes)
    // Ends that another child, started at the same time, does not get.
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe for " + words[0]);
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw std::runtime_error("could not start " + words[0]);
  if (child == 0) {
    // What nobody waits for is not made.
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent || (!place.empty() && chdir(place.c_str()) != 0)) std::_Exit(kNotStarted);
    dup2(pipes[0][1], STDOUT_FILENO);
    dup2(pipes[1][1], STDERR_FILENO);
    for (const auto& ends : pipes)
      for (const int end : ends) close(end);
    execvp(list[0], list.data());
    std::_Exit(kNotStarted);
  }
  ChildOutput result;
  std::array<pollfd, 2> open{};
  for (std::size_t i = 0; i < 2; ++i) {
    close(pipes[i][1]);
    open[i] = {pipes[i][0], POLLIN, 0};
  }
  std::array<char, 4096> buffer{};
  while (open[0].fd >= 0 || open[1].fd >= 0) {
    if (poll(open.data(), open.size(), -1) < 0 && errno != EINTR) break;
    for (std::size_t i = 0; i < 2; ++i) {
      if (open[i].fd < 0 || open[i].revents == 0) continue;
      const ssize_t n = read(open[i].fd, buffer.data(), buffer.size());
      if (n > 0) (i == 0 ? result.output : result.errors).append(buffer.data(), static_cast<std::size_t>(n));
      if (n == 0 || (n < 0 && errno != EINTR)) open[i].fd = -1;  // poll leaves it out
    }
  }
  for (const auto& ends : pipes) close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) result.status = WEXITSTATUS(status);
  return result;
}

std::string last_line(const std::string& text) {
  std::istringstream lines(text);
  std::string line, last;
  while (std::getline(lines, line))
    if (!line.empty()) last = line;
  return last;
}

}  // namespace vericone
