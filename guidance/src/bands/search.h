// SPDX-License-Identifier: BSD-3-Clause
//
// Of a convex pair the velocities that hit within a horizon are a convex set, so one plane that a free value
// has frees all values up to where the plane ends: Newton's method from outside, which passes no end. What is
// left between two such ends is hit, or is divided.
#pragma once

#include <vericone/guidance/bands.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace vericone::guidance::banding {

inline constexpr double kFinest = 1e-12;  // of a range, relative: narrower ones are neither free nor conflict

/// What is asked of one pair of convex parts.
class Question {
 public:
  virtual ~Question() = default;
  /// All values about q that one plane proves to be free.
  virtual std::optional<Range> free_about(double q) const = 0;
  virtual bool is_hit(double q) const = 0;
  /// All values between two hits; false says nothing.
  virtual bool all_hit(double from, double to) const = 0;

 protected:
  static bool meets(Verdict verdict) { return verdict == Verdict::in || verdict == Verdict::overlapping; }
};

/// The range of a quantity that is asked about; of a closed one the ends are one.
struct Domain {
  double low, high;
  bool closed = false;
};

/// What one pair of convex parts does to a quantity.
class Search {
 public:
  Search(const Question& question, const Domain& domain)
      : question_(question),
        domain_(domain),
        finest_(kFinest * std::max({1.0, std::abs(domain.low), std::abs(domain.high)})) {}

  std::vector<Range> free, hit;  // of a closed curve beyond its ends too, by a turn at most

  void run() {
    const double low = domain_.low, high = domain_.high, turn = high - low;
    if (turn == 0) {
      const State state = look(low);
      if (state != State::neither) (state == State::free ? free : hit).push_back({low, high});
      return;
    }
    if (!domain_.closed) return divide(low, high, question_.is_hit(low), question_.is_hit(high));
    const State state = look(low);
    if (state != State::free) return divide(low, high, state == State::hit, state == State::hit);
    const Range own = found_;
    double from = march(own.from, low - turn), again = from + turn;
    double to = own.to < again ? march(own.to, again) : again;
    if (to >= again) return free.push_back({low, high});
    const auto first = first_hit(to, again), last = first_hit(again, to);
    free.push_back({again - turn, to});
    divide(first.value_or(to), last.value_or(again), first.has_value(), last.has_value());
  }

 private:
  enum class State { free, hit, neither };

  /// At q; where it is free, `found_` is what one plane says of the values about it.
  State look(double q) {
    ++looks_;
    if (const auto range = question_.free_about(q)) {
      found_ = *range;
      return State::free;
    }
    return question_.is_hit(q) ? State::hit : State::neither;
  }

  /// From an end of what is free to where it really ends, no farther than `end`. Where a plane goes no
  /// farther than where it was asked for, a value a little beyond is asked.
  double march(double q, double end) {
    const double sign = end > q ? 1 : -1;
    double beyond = 0;
    for (int step = 0; step < 60 && sign * (end - q) > 0; ++step) {
      const State state = look(q + sign * beyond);
      if (state == State::hit) break;
      if (state == State::neither) {
        beyond = std::max(4 * beyond, 2 * finest_);
        continue;
      }
      const double next = sign > 0 ? found_.to : found_.from, back = sign > 0 ? found_.from : found_.to;
      if (sign * (back - q) > 0) break;  // not joined
      if (sign * (next - q) > finest_) {
        q = next;
        beyond = 0;
      } else {
        beyond = std::max(4 * beyond, 2 * finest_);
      }
    }
    return sign > 0 ? std::min(q, end) : std::max(q, end);
  }

  /// From an end of what is free towards `end`: where the first hit is, found by steps that grow, and then
  /// brought as near as can be; `q` goes on to where what is free then ends. Nothing where that is not known.
  std::optional<double> first_hit(double& q, double end) {
    const double sign = end > q ? 1 : -1;
    double step = finest_;
    while (step < std::abs(end - q) && !question_.is_hit(q + sign * step)) step *= 4;
    if (!(step < std::abs(end - q)) && !question_.is_hit(end)) return std::nullopt;
    double first = step < std::abs(end - q) ? q + sign * step : end;
    while (std::abs(first - q) > finest_ && looks_ < kMostLooks) {
      const double between = 0.5 * (q + first);
      const State state = look(between);
      // Nearly at the end; or nothing is known of what is between.
      if (state == State::neither && std::abs(first - q) < 1e3 * finest_) break;
      if (state == State::neither) return std::nullopt;
      if (state == State::hit) first = between;
      if (state != State::free) continue;
      if (sign * ((sign > 0 ? found_.from : found_.to) - q) > 0) return std::nullopt;  // not joined
      q = march(sign > 0 ? found_.to : found_.from, first);
    }
    return first;
  }

  /// All between two values, each of which is a hit or not.
  void divide(double from, double to, bool hit_from, bool hit_to) {
    if (hit_from && hit_to && question_.all_hit(from, to)) return hit.push_back({from, to});
    if (!(to - from > finest_) || looks_ > kMostLooks) return;
    const double q = from + 0.5 * (to - from);
    const State state = look(q);
    if (state != State::free) {
      divide(from, q, hit_from, state == State::hit);
      divide(q, to, state == State::hit, hit_to);
      return;
    }
    const Range own = found_;
    Range all{march(std::max(own.from, from), from), march(std::min(own.to, to), to)};
    const auto last = first_hit(all.from, from), first = first_hit(all.to, to);
    free.push_back(all);
    divide(from, last.value_or(all.from), hit_from, last.has_value());
    divide(first.value_or(all.to), to, first.has_value(), hit_to);
  }

  static constexpr int kMostLooks = 2000;

  const Question& question_;
  Domain domain_;
  double finest_;
  int looks_ = 0;
  Range found_;
};

/// The ranges of all together: free for every one, or hit by some.
class Merged {
 public:
  explicit Merged(const Domain& domain) : domain_(domain) {}

  /// `domain`: where to search; of a closed quantity a turn anywhere. `hits`: whether they count.
  void add(const Question& question, const Domain& domain, bool hits) {
    Search one(question, domain);
    one.run();
    std::vector<Range> free = joined(one.free);
    if (domain_.closed)  // a turn is not a double
      for (Range& range : free)
        if (range.to - range.from < domain_.high) range = {range.from + kTurned, range.to - kTurned};
    const std::vector<Range> own = in_order(free);
    double from = domain_.low;
    for (const Range& range : own) {
      if (range.from > from) blocked_.push_back({from, range.from});
      from = std::max(from, range.to);
    }
    if (from < domain_.high || own.empty()) blocked_.push_back({from, domain_.high});
    if (hits) hit_.insert(hit_.end(), one.hit.begin(), one.hit.end());
  }

  Band band() const {
    Band result{{}, in_order(hit_)};
    double from = domain_.low;
    for (const Range& range : in_order(blocked_)) {
      if (range.from > from) result.free.push_back({from, range.from});
      from = std::max(from, range.to);
    }
    if (from < domain_.high || blocked_.empty()) result.free.push_back({from, domain_.high});
    return result;
  }

 private:
  /// Within the ends of the curve, joined where they overlap.
  std::vector<Range> in_order(const std::vector<Range>& given) const {
    std::vector<Range> all;
    const double turn = domain_.high - domain_.low;
    for (const Range& range : given)
      for (int k = domain_.closed ? -2 : 0; k <= (domain_.closed ? 2 : 0); ++k) {
        const Range moved{std::max(range.from + k * turn, domain_.low),
                          std::min(range.to + k * turn, domain_.high)};
        if (moved.from <= moved.to) all.push_back(moved);
      }
    return joined(std::move(all));
  }

  static std::vector<Range> joined(std::vector<Range> all) {
    std::sort(all.begin(), all.end(), [](const Range& a, const Range& b) { return a.from < b.from; });
    std::vector<Range> result;
    for (const Range& range : all) {
      if (!result.empty() && range.from <= result.back().to) {
        result.back().to = std::max(result.back().to, range.to);
      } else {
        result.push_back(range);
      }
    }
    return result;
  }

  static constexpr double kTurned = 0x1p-48;

  Domain domain_;
  std::vector<Range> blocked_, hit_;
};

}  // namespace vericone::guidance::banding
