// SPDX-License-Identifier: GPL-3.0-or-later
//
// write_corpus FOLDER: writes tests/corpus again, after a change of its generators.
#include <vericone/verify/corpus.h>

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include "verify/corpus/corpus_seed.h"

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "usage: write_corpus FOLDER\n";
    return 2;
  }
  for (const auto predicate : vericone::verify::kCorpusPredicates) {
    const auto file = std::filesystem::path(argv[1]) / (std::string(predicate) + ".txt");
    std::ofstream out(file, std::ios::binary);
    out << vericone::verify::corpus_text(predicate, vericone::verify::kCorpusSeed);
    if (!out.flush()) {
      std::cerr << "could not write " << file << '\n';
      return 1;
    }
  }
  return 0;
} catch (const std::exception& e) {
  std::cerr << e.what() << '\n';
  return 1;
}
