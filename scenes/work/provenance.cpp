// SPDX-License-Identifier: BSD-3-Clause
#include "work/provenance.h"

#include <vericone/work/staged_folder.h>
#include <Eigen/Core>
#include <chrono>
#include <ctime>
#include <fstream>
#include <stdexcept>

#include "json/json_value.h"
#include "json/plain_text.h"
#include "work/build_info.h"
#include "work/file_hash.h"

namespace vericone {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string now() {
  const std::time_t t = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::string text(32, '\0');
  text.resize(std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&t)));
  return text;
}

const char* compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "GNU " __VERSION__;
#else
  return "unknown";
#endif
}

Json hashes(const std::vector<std::filesystem::path>& files) {
  Json list = Json::array();
  for (const auto& file : files) {
    Json hash = nullptr;  // a pipe, or gone
    try {
      if (std::filesystem::is_regular_file(file)) hash = sha256_of_file(file);
    } catch (const std::runtime_error&) {
      hash = nullptr;
    }
    list.push_back({{"file", file.string()}, {"sha256", hash}});
  }
  return list;
}

}  // namespace

Json provenance(const std::string& command_line, int threads,
                const std::vector<std::filesystem::path>& inputs) {
  return {{"command", plain_text(command_line)},
          {"version", build_info::version()},
          {"commit", build_info::commit()},
          {"compiler", compiler()},
          {"flags", build_info::flags()},
          {"eigen", std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                        std::to_string(EIGEN_MINOR_VERSION)},
          {"processor", processor()},
          {"threads", threads},
          {"inputs", hashes(inputs)},
          {"finished", now()}};
}

std::string work::provenance(const std::string& command_line, int threads,
                             const std::vector<std::filesystem::path>& inputs) {
  return vericone::provenance(command_line, threads, inputs).dump(1) + "\n";
}

}  // namespace vericone
