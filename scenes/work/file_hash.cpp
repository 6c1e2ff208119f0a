// SPDX-License-Identifier: BSD-3-Clause
#include "work/file_hash.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <stdexcept>

namespace vericone {
namespace {

constexpr std::size_t kBlock = 64, kRounds = 64;
using Words = std::array<std::uint32_t, 8>;

/// The first 32 bits of the fractional part of the root of a prime: floor(2^32 prime^(1/degree)) mod 2^32,
/// the constants of the standard.
constexpr std::uint32_t root_bits(std::uint64_t prime, int degree) {
  // Squares and cubes of numbers below 2^36 fit 128 bits.
  __extension__ using Wide = unsigned __int128;
  const Wide target = degree == 2 ? Wide{prime} << 64U : Wide{prime} << 96U;
  std::uint64_t root = 0;
  for (std::uint64_t bit = std::uint64_t{1} << 37U; bit > 0; bit >>= 1U) {
    const Wide next = root | bit;
    const Wide power = degree == 2 ? next * next : next * next * next;
    if (power <= target) root |= bit;
  }
  return static_cast<std::uint32_t>(root);
}

struct Constants {
  Words start{};
  std::array<std::uint32_t, kRounds> rounds{};
};

constexpr Constants constants() {
  Constants c;
  std::size_t count = 0;
  for (std::uint64_t n = 2; count < kRounds; ++n) {
    bool prime = true;
    for (std::uint64_t d = 2; d * d <= n; ++d) prime = prime && n % d != 0;
    if (!prime) continue;
    if (count < c.start.size()) c.start[count] = root_bits(n, 2);
    c.rounds[count++] = root_bits(n, 3);
  }
  return c;
}

constexpr Constants kConstants = constants();

void add_block(Words& hash, const unsigned char* block) {
  std::array<std::uint32_t, kRounds> w{};
  for (std::size_t i = 0; i < 16; ++i)
    for (std::size_t k = 0; k < 4; ++k) w[i] = w[i] << 8U | block[4 * i + k];
  for (std::size_t i = 16; i < kRounds; ++i) {
    const std::uint32_t s0 = std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ w[i - 15] >> 3U;
    const std::uint32_t s1 = std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ w[i - 2] >> 10U;
    w[i] = w[i - 16] + s0 + w[i - 7] + s1;
  }
  auto [a, b, c, d, e, f, g, h] = hash;
  for (std::size_t i = 0; i < kRounds; ++i) {
    const std::uint32_t s1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const std::uint32_t s0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const std::uint32_t t1 = h + s1 + ((e & f) ^ (~e & g)) + kConstants.rounds[i] + w[i];
    const std::uint32_t t2 = s0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
  }
  const Words added{a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < hash.size(); ++i) hash[i] += added[i];
}

}  // namespace

std::string sha256_of_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  Words hash = kConstants.start;
  std::array<unsigned char, 2 * kBlock> block{};
  std::uint64_t length = 0;
  std::size_t got = kBlock;
  while (got == kBlock) {
    in.read(reinterpret_cast<char*>(block.data()), kBlock);
    got = static_cast<std::size_t>(in.gcount());
    length += got;
    if (got == kBlock) add_block(hash, block.data());
  }
  if (!in.eof()) throw std::runtime_error("could not read " + file.string());
  // A one bit, zeros, and the count of bits end the last block, or the one after it.
  const std::size_t padded = got + 9 <= kBlock ? kBlock : 2 * kBlock;
  for (std::size_t i = got; i < padded; ++i) block[i] = 0;
  block[got] = 0x80;
  for (std::size_t k = 0; k < 8; ++k) block[padded - 1 - k] = static_cast<unsigned char>(8 * length >> 8 * k);
  for (std::size_t first = 0; first < padded; first += kBlock) add_block(hash, block.data() + first);
  std::string text;
  for (const std::uint32_t word : hash)
    for (int digit = 7; digit >= 0; --digit) text += "0123456789abcdef"[word >> 4 * digit & 15U];
  return text;
}

}  // namespace vericone
