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

inline constexpr double kFinest = 1e-12;  // of a range, relative

/// What is asked of one pair of convex parts.
class Question {
 public:
  virtual ~Question() = default;
  /// All values about q that one plane proves to be free.
  virtual std::optional<Range> free_about(double q) const = 0;
  virtual bool is_hit(double q) const = 0;
  /// Of a closed quantity, where a hit is likeliest, if that is known: the plane there frees most, if it is
  /// none.
  virtual std::optional<double> likeliest() const { return std::nullopt; }
  /// Whether a plane that is known already frees all values between two.
  virtual bool known_free(double from, double to) const {
    static_cast<void>(from), static_cast<void>(to);
    return false;
  }
  /// All values between two hits; false says nothing.
  virtual bool all_hit(double from, double to) const = 0;
  /// Narrower ranges are neither free nor conflict.
  virtual double finest() const { return 0; }
  /// Between two hits narrower ones are not divided.
  virtual double finest_between_hits() const { return 0; }

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
        finest_(std::max(question.finest(),
                         kFinest * std::max({1.0, std::abs(domain.low), std::abs(domain.high)}))) {}

  std::vector<Range> free, hit;  // of a closed curve beyond its ends too, by a turn at most

  void run() {
    double low = domain_.low, high = domain_.high;
    const double turn = high - low;
    if (turn == 0) {
      const State state = look(low);
      if (state != State::neither) (state == State::free ? free : hit).push_back({low, high});
      return;
    }
    if (!domain_.closed && question_.known_free(low, high)) return free.push_back({low, high});
    if (!domain_.closed) return divide(low, high, question_.is_hit(low), question_.is_hit(high));
    if (const auto likeliest = question_.likeliest()) {
      low += std::clamp(*likeliest - low, 0.0, turn);
      if (question_.is_hit(low)) low += low < high - 0.5 * turn ? 0.5 * turn : -0.5 * turn;
      high = low + turn;
    }
    const State state = look(low);
    if (state != State::free) return divide(low, high, state == State::hit, state == State::hit);
    const Range own = found_;
    const Range everything{low - turn, high + turn};  // by more than a turn, which is no double
    if (own.to - own.from >= turn) return free.push_back(everything);
    End again = march(own.from, low - turn);
    again.at += turn;
    if (again.met) *again.met += turn;
    End to = own.to < again.at ? march(own.to, again.at) : again;
    if (to.at >= again.at) return free.push_back(everything);
    const auto first = first_hit(to, again.at), last = first_hit(again, to.at);
    free.push_back({again.at - turn, to.at});
    divide(first.value_or(to.at), last.value_or(again.at), first.has_value(), last.has_value());
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

  /// Where what is free ends, and a hit beyond it where one is known.
  struct End {
    double at;
    std::optional<double> met;
  };

  /// From an end of what is free, free itself, to where it really ends, no farther than `end`. Where a plane
  /// goes no farther than where it was asked for, a value a little beyond is asked: first whether it is hit,
  /// as most are.
  End march(double q, double end) {
    const double sign = end > q ? 1 : -1;
    double beyond = 0;
    std::optional<double> met;
    for (int step = 0; step < 60 && sign * (end - q) > 0; ++step) {
      const double there = q + sign * beyond;
      ++looks_;
      if (beyond > 0 && question_.is_hit(there)) {
        met = there;
        break;
      }
      const auto range = question_.free_about(there);
      if (range) {
        const double next = sign > 0 ? range->to : range->from, back = sign > 0 ? range->from : range->to;
        if (sign * (back - q) > 0) break;  // not joined
        if (sign * (next - q) > finest_) {
          q = next;
          beyond = 0;
          continue;
        }
      }
      beyond = std::max(4 * beyond, finest_);
    }
    return {sign > 0 ? std::min(q, end) : std::max(q, end), met};
  }

  /// From an end of what is free towards `end`: where the first hit is, found by steps that grow, and then
  /// brought as near as can be; it goes on to where what is free then ends. Nothing where that is not known.
  std::optional<double> first_hit(End& free_end, double end) {
    double& q = free_end.at;
    const double sign = end > q ? 1 : -1;
    const auto before_end = [&](double at) { return sign * (end - at) > 0; };
    double first = end;
    if (free_end.met && before_end(*free_end.met)) {
      first = *free_end.met;
    } else {
      double step = finest_;
      while (before_end(q + sign * step) && !question_.is_hit(q + sign * step)) step *= 4;
      if (before_end(q + sign * step))
        first = q + sign * step;
      else if (!question_.is_hit(end))
        return std::nullopt;
    }
    while (std::abs(first - q) > 1.5 * finest_ && looks_ < kMostLooks) {
      const double between = 0.5 * (q + first);
      const State state = look(between);
      // Nearly at the end; or nothing is known of what is between.
      if (state == State::neither && std::abs(first - q) < 1e3 * finest_) break;
      if (state == State::neither) return std::nullopt;
      if (state == State::hit) first = between;
      if (state != State::free) continue;
      if (sign * ((sign > 0 ? found_.from : found_.to) - q) > 0) return std::nullopt;  // not joined
      free_end = march(sign > 0 ? found_.to : found_.from, first);
      if (free_end.met && sign * (first - *free_end.met) > 0) first = *free_end.met;
    }
    return first;
  }

  /// All between two values, each of which is a hit or not.
  void divide(double from, double to, bool hit_from, bool hit_to) {
    if (hit_from && hit_to && question_.all_hit(from, to)) return hit.push_back({from, to});
    const double finest = hit_from && hit_to ? std::max(finest_, question_.finest_between_hits()) : finest_;
    if (!(to - from > finest) || looks_ > kMostLooks) return;
    const double q = from + 0.5 * (to - from);
    const State state = look(q);
    // Where bodies only touch nothing is decided however finely.
    if (state == State::neither && !hit_from && !hit_to && to - from < 1e3 * finest_) return;
    if (state != State::free) {
      divide(from, q, hit_from, state == State::hit);
      divide(q, to, state == State::hit, hit_to);
      return;
    }
    const Range own = found_;
    End low = march(std::max(own.from, from), from), high = march(std::min(own.to, to), to);
    const auto last = first_hit(low, from), first = first_hit(high, to);
    free.push_back({low.at, high.at});
    divide(from, last.value_or(low.at), hit_from, last.has_value());
    divide(first.value_or(high.at), to, first.has_value(), hit_to);
  }

  static constexpr int kMostLooks = 2000;

  const Question& question_;
  Domain domain_;
  double finest_;
  int looks_ = 0;
  Range found_;
};

/// Where something is asked: everywhere, or in these ranges.
struct Where {
  bool everywhere = false;
  std::vector<Range> ranges;
  bool empty() const { return !everywhere && ranges.empty(); }
};

/// The ranges of all together: free for every one, or hit by some.
class Merged {
 public:
  /// `domain`: of the quantity; of a closed one, the turn that is answered. `search`: where a search begins,
  /// of a closed quantity a turn anywhere.
  Merged(const Domain& domain, const Domain& search) : domain_(domain), search_(search) {}

  /// Of these, all that a question does not find free. `hits`: whether they count.
  Where not_free(const Question& question, const Where& where, bool hits) {
    Where result;
    if (where.everywhere) {
      Search one(question, search_);
      one.run();
      std::vector<Range> free = joined(one.free);
      if (domain_.closed)  // a turn is not a double
        for (Range& range : free)
          if (range.to - range.from < domain_.high) range = {range.from + kTurned, range.to - kTurned};
      add_rest(in_order(free), {domain_.low, domain_.high}, result.ranges);
      if (hits) add_hits(one.hit);
    }
    for (const Range& range : where.ranges)
      for (const double turn : turns()) {
        const Range here{std::max(range.from - turn, search_.low), std::min(range.to - turn, search_.high)};
        if (here.from > here.to) continue;
        Search one(question, {here.from, here.to});
        one.run();
        std::vector<Range> rest;
        add_rest(joined(one.free), here, rest);
        for (const Range& r : rest) result.ranges.push_back(turned(r, turn));
        if (hits) add_hits(one.hit);
      }
    result.ranges = joined(std::move(result.ranges));
    return result;
  }

  /// Without what is known to be hit already; or, where hits do not matter, to be blocked.
  Where without_known(const Where& where, bool hits) const {
    const std::vector<Range>& known = hits ? hit_ : blocked_;
    if (known.empty()) return where;
    Where result;
    for (const Range& range :
         where.everywhere ? std::vector<Range>{{domain_.low, domain_.high}} : where.ranges)
      add_rest(known, range, result.ranges);
    return result;
  }

  void block(const std::vector<Range>& ranges) {
    blocked_.insert(blocked_.end(), ranges.begin(), ranges.end());
    blocked_ = joined(std::move(blocked_));
  }

  Band band() const {
    Band result{{}, hit_};
    add_rest(blocked_, {domain_.low, domain_.high}, result.free);
    return result;
  }

 private:
  /// By which what is answered may be off what is searched.
  std::vector<double> turns() const {
    if (!domain_.closed || search_.closed) return {0};
    const double turn = domain_.high - domain_.low;
    return {0, turn};
  }
  Range turned(const Range& range, double turn) const {
    if (turn == 0) return range;
    return {std::max(range.from + turn - kTurned, domain_.low),
            std::min(range.to + turn + kTurned, domain_.high)};
  }

  void add_hits(const std::vector<Range>& hits) {
    const std::vector<Range> ordered = in_order(hits);
    hit_.insert(hit_.end(), ordered.begin(), ordered.end());
    hit_ = joined(std::move(hit_));
  }

  /// What of a range is in none of those, which are in order; of a range of one value that value.
  static void add_rest(const std::vector<Range>& those, const Range& range, std::vector<Range>& rest) {
    double from = range.from;
    bool any = false;
    for (const Range& one : those) {
      if (one.to < range.from || one.from > range.to) continue;
      any = true;
      if (one.from > from) rest.push_back({from, one.from});
      from = std::max(from, one.to);
    }
    if (from < range.to || !any) rest.push_back({from, range.to});
  }

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

  Domain domain_, search_;
  std::vector<Range> blocked_, hit_;  // in order, apart
};

}  // namespace vericone::guidance::banding
