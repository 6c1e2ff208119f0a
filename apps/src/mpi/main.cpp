// SPDX-License-Identifier: BSD-3-Clause
//
// The program `vericone-mpi`, the only one that links MPI: `mpirun -n N vericone-mpi COMMAND ...` is
// `vericone COMMAND ...` by N processes, for the commands whose rows are in tables.
#include <vericone/geometry/error.h>
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "job/job.h"
#include "mpi/ranks.h"
#include "output/part.h"
#include "output/temporary_folder.h"
#ifdef VERICONE_WITH_VISION
#include "pursue/pursue_command.h"
#endif

namespace {

using namespace vericone;

const std::map<std::string, Command>& commands() {
  static const std::map<std::string, Command> known{
#ifdef VERICONE_WITH_VISION
      {"pursue", pursue_command},
#endif
      {"accuracy", accuracy_command},
      {"campaign", campaign_command},
      {"trials", trials_command}};
  return known;
}

/// Of words that begin with none of them: help, version, or what is wrong.
int no_command(CommandLine& line) {
  std::string names, command;
  for (const auto& [name, one] : commands()) names += (names.empty() ? "" : ", ") + name;
  line.option("command", command,
              "One of " + names +
                  ", and its words: mpirun -n N vericone-mpi COMMAND ... does by N processes what "
                  "vericone COMMAND ... does, with the same files, byte for byte")
      .required();
  line.read();
  throw InputError("command", command, "one of " + names);
}

int run(mpi::Ranks& ranks, char** argv, std::vector<std::string> words) {
  const auto command = words.empty() ? commands().end() : commands().find(words[0]);
  if (command == commands().end())
    return ranks.first() ? run_program(words.empty() ? 1 : 2, argv, "mpi", no_command) : 0;
  // The files are the first one's matter.
  std::optional<TemporaryFolder> own;
  if (!ranks.first()) {
    own.emplace();
    words = words_without(words, {"--out"}, {});
    words.insert(words.end(), {"--out", (own->path() / "out").string()});
  }
  if (words_without(words, {"--threads"}, {}).size() == words.size())
    words.insert(words.end(), {"--threads", "1"});
  share_rows([&](work::ResumableTable& table) { return ranks.share(table); });
  std::string called = "vericone-mpi " + words[0];
  std::vector<char*> arguments{called.data()};
  for (auto word = words.begin() + 1; word != words.end(); ++word) arguments.push_back(word->data());
  return run_program(static_cast<int>(arguments.size()), arguments.data(), command->first, command->second);
}

}  // namespace

int main(int argc, char** argv) {
  mpi::Ranks ranks(argc, argv);
  if (!ranks.first() && !ranks.table_comes()) return ranks.finish(0);
  const int status = run(ranks, argv, std::vector<std::string>(argv + 1, argv + argc));
  return ranks.finish(status);
}
