// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fuzz target without a fuzzer:
//   replay CORPUS_FILE            every case of the corpus and eight mutations of each
//   replay CORPUS_FILE FOLDER     writes the cases as seeds for libFuzzer
//   replay CORPUS_FILE -- FILE... runs inputs that libFuzzer found
#include <vericone/internal/verify/seeded_random.h>
#include <vericone/verify/corpus.h>

#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/fuzz_membership.h"

namespace {

using vericone::fuzz::Doubles;
using vericone::verify::CorpusCase, vericone::verify::SeededRandom;

std::optional<Doubles> seed_of(const CorpusCase& c) {
  Doubles input{};
  const auto a = c.body<3>("a"), b = c.body<3>("b");
  const auto w = c.doubles("w");
  if (!a || !b || !w) return std::nullopt;
  double* at = input.data();
  for (const auto& body : {*a, *b}) {
    for (int i = 0; i < 3; ++i) *at++ = body.center()(i);
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) *at++ = body.shape()(i, j);
  }
  for (const double x : *w) *at++ = x;
  return input;
}

/// One number becomes a neighbour, a value at the edge of the range, another number, or has a bit flipped.
Doubles mutated(Doubles input, SeededRandom& random) {
  static constexpr double kOdd[] = {0.0,
                                    -0.0,
                                    0x1p-1074,
                                    0x1p-1022,
                                    std::numeric_limits<double>::max(),
                                    1e-150,
                                    1e150,
                                    1.0,
                                    std::numeric_limits<double>::infinity(),
                                    std::numeric_limits<double>::quiet_NaN()};
  const int last = static_cast<int>(input.size()) - 1;
  for (int i = random.integer(1, 3); i > 0; --i) {
    double& x = input[static_cast<std::size_t>(random.integer(0, last))];
    switch (random.integer(0, 3)) {
      case 0:
        x = std::nextafter(x, random.coin() ? 1e308 : -1e308);
        break;
      case 1:
        x = kOdd[random.integer(0, 9)];
        break;
      case 2:
        x = input[static_cast<std::size_t>(random.integer(0, last))];
        break;
      default: {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &x, sizeof(x));
        bits ^= std::uint64_t{1} << random.integer(0, 63);
        std::memcpy(&x, &bits, sizeof(x));
      }
    }
  }
  return input;
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    std::cerr << "usage: replay CORPUS_FILE [FOLDER | -- FILE...]\n";
    return 2;
  }
  if (arguments.size() > 1 && arguments[1] == "--") {
    for (std::size_t i = 2; i < arguments.size(); ++i) {
      std::ifstream in(arguments[i], std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }
    return 0;
  }
  std::size_t seeds = 0, mutations = 0, bodies = 0;
  for (const CorpusCase& c : vericone::verify::read_corpus(std::filesystem::path(arguments[0]))) {
    const auto seed = seed_of(c);
    if (!seed) continue;
    if (arguments.size() > 1) {
      std::ofstream out(std::filesystem::path(arguments[1]) / std::to_string(seeds), std::ios::binary);
      out.write(reinterpret_cast<const char*>(seed->data()), sizeof(*seed));
    } else {
      vericone::fuzz::check_membership(*seed);
      SeededRandom random(0xf022, 1, seeds);
      for (int i = 0; i < 8; ++i, ++mutations)
        bodies += vericone::fuzz::check_membership(mutated(*seed, random));
    }
    ++seeds;
  }
  std::cout << seeds << " seeds, " << mutations << " mutations, " << bodies
            << " of them two bodies; all rungs agree\n";
  return seeds > 500 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try { return run({argv + 1, argv + argc}); } catch (const std::exception& e) {
  std::cerr << e.what() << '\n';
  return 1;
}
