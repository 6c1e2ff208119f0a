// SPDX-License-Identifier: BSD-3-Clause
//
// What LASzip codes numbers with: adaptive arithmetic coding (Said 2004, "Introduction to Arithmetic Coding")
// of symbols and bits, and on top of it whole numbers by their distance from a prediction.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace vericone::files::laz {

/// Data that no encoder wrote.
struct Damaged {
  const char* what;
};

/// How often each symbol came, of late.
class SymbolModel {
 public:
  explicit SymbolModel(std::uint32_t symbols)
      : counts_(symbols, 1), below_(symbols), until_(symbols), cycle_(symbols) {
    renew();
    cycle_ = until_ = (symbols + 6) / 2;
  }

 private:
  friend class Decoder;
  static constexpr int kBits = 15;

  void renew() {
    if ((total_ += cycle_) > 1U << kBits) {
      total_ = 0;
      for (std::uint32_t& count : counts_) total_ += count = (count + 1) / 2;
    }
    const std::uint32_t scale = 0x80000000U / total_;
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      below_[i] = scale * sum >> (31 - kBits);
      sum += counts_[i];
    }
    cycle_ = std::min(5 * cycle_ / 4, (std::uint32_t(counts_.size()) + 6) * 8);
    until_ = cycle_;
  }

  std::vector<std::uint32_t> counts_, below_;  // below: the share of smaller symbols
  std::uint32_t total_ = 0, until_, cycle_;
};

class BitModel {
 private:
  friend class Decoder;
  static constexpr int kBits = 13;

  void renew() {
    if ((total_ += cycle_) > 1U << kBits) {
      total_ = (total_ + 1) / 2;
      zeros_ = (zeros_ + 1) / 2;
      if (zeros_ == total_) ++total_;
    }
    zero_ = zeros_ * (0x80000000U / total_) >> (31 - kBits);
    cycle_ = std::min(5 * cycle_ / 4, 64U);
    until_ = cycle_;
  }

  std::uint32_t zeros_ = 1, total_ = 2, zero_ = 1U << (kBits - 1), cycle_ = 4, until_ = 4;
};

class Decoder {
 public:
  Decoder() = default;
  explicit Decoder(std::string_view bytes) : bytes_(bytes) {
    for (int i = 0; i < 4; ++i) value_ = value_ << 8 | next();
  }

  std::uint32_t symbol(SymbolModel& model) {
    std::uint32_t high = length_;
    length_ >>= SymbolModel::kBits;
    // The last symbol that begins at the value or before it.
    const auto after = std::partition_point(model.below_.begin() + 1, model.below_.end(),
                                            [&](std::uint32_t below) { return below * length_ <= value_; });
    const std::size_t symbol = std::size_t(after - model.below_.begin()) - 1;
    const std::uint32_t low = model.below_[symbol] * length_;
    if (after != model.below_.end()) high = *after * length_;
    value_ -= low;
    length_ = high - low;
    refill();
    ++model.counts_[symbol];
    if (--model.until_ == 0) model.renew();
    return std::uint32_t(symbol);
  }

  std::uint32_t bit(BitModel& model) {
    const std::uint32_t zero = model.zero_ * (length_ >> BitModel::kBits);
    const bool one = value_ >= zero;
    if (one) {
      value_ -= zero;
      length_ -= zero;
    } else {
      length_ = zero;
      ++model.zeros_;
    }
    refill();
    if (--model.until_ == 0) model.renew();
    return one;
  }

  /// So many bits (1 to 32), all values as likely.
  std::uint32_t bits(std::uint32_t count) {
    if (count > 19) {
      const std::uint32_t low = bits(16);
      return bits(count - 16) << 16 | low;
    }
    const std::uint32_t x = value_ / (length_ >>= count);
    if (x >> count != 0) throw Damaged{"a value beyond what was coded"};
    value_ -= length_ * x;
    refill();
    return x;
  }
  std::uint64_t wide() {
    const std::uint64_t low = bits(32);
    return std::uint64_t(bits(32)) << 32 | low;
  }

 private:
  std::uint32_t next() {
    // What an encoder writes at its end may be a few bytes shorter than what is looked at.
    if (at_ == bytes_.size()) {
      if (++beyond_ > 8) throw Damaged{"compressed data that ends early"};
      return 0;
    }
    return static_cast<std::uint8_t>(bytes_[at_++]);
  }
  void refill() {
    for (; length_ < 1U << 24; length_ <<= 8) value_ = value_ << 8 | next();
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  std::uint32_t value_ = 0, length_ = 0xffffffffU;
  int beyond_ = 0;
};

/// A whole number of so many bits as what is added to a prediction: how many bits that takes, then these.
class NumberModel {
 public:
  NumberModel(std::uint32_t bits, std::size_t contexts) : bits_(bits) {
    for (std::size_t i = 0; i < contexts; ++i) sizes_.emplace_back(bits + 1);
    for (std::uint32_t k = 1; k <= bits; ++k) corrections_.emplace_back(1U << std::min(k, kCoded));
  }

  std::int32_t read(Decoder& from, std::int32_t prediction, std::size_t context) {
    // Sums wrap, as they did when they were coded.
    auto sum = std::uint32_t(prediction) + std::uint32_t(correction(from, sizes_[context]));
    if (bits_ < 32) {
      const std::uint32_t range = 1U << bits_;
      if (std::int32_t(sum) < 0)
        sum += range;
      else if (sum >= range)
        sum -= range;
    }
    return std::int32_t(sum);
  }
  /// How many bits the last correction took.
  [[nodiscard]] std::uint32_t size() const { return size_; }

 private:
  static constexpr std::uint32_t kCoded = 8;

  std::int32_t correction(Decoder& from, SymbolModel& sizes) {
    size_ = from.symbol(sizes);
    if (size_ == 0) return std::int32_t(from.bit(zero_or_one_));
    if (size_ == 32) return INT32_MIN;
    std::uint32_t x = from.symbol(corrections_[size_ - 1]);
    if (size_ > kCoded) x = x << (size_ - kCoded) | from.bits(size_ - kCoded);
    // Of k bits the numbers from -2^k + 1 to -2^(k-1), and from 2^(k-1) + 1 to 2^k.
    return x >= 1U << (size_ - 1) ? std::int32_t(x + 1) : std::int32_t(x - ((1U << size_) - 1));
  }

  std::uint32_t bits_, size_ = 0;
  std::vector<SymbolModel> sizes_, corrections_;
  BitModel zero_or_one_;
};

/// The middle one of the five latest, roughly: a new one pushes out the largest and the smallest by turns.
class RunningMedian {
 public:
  [[nodiscard]] std::int32_t get() const { return sorted_[2]; }

  void add(std::int32_t x) {
    // Of the two ends the one that goes is replaced by the new one, which then takes its place; the next time
    // the other end goes, if the new one came to lie on this side of the middle.
    if (drops_largest_) {
      drops_largest_ = x < sorted_[2];
      sorted_[4] = x;
      for (std::size_t i = 4; i > 0 && sorted_[i] < sorted_[i - 1]; --i)
        std::swap(sorted_[i], sorted_[i - 1]);
    } else {
      drops_largest_ = x <= sorted_[2];
      sorted_[0] = x;
      for (std::size_t i = 0; i < 4 && sorted_[i + 1] < sorted_[i]; ++i)
        std::swap(sorted_[i], sorted_[i + 1]);
    }
  }

 private:
  std::array<std::int32_t, 5> sorted_{};
  bool drops_largest_ = true;
};

}  // namespace vericone::files::laz
