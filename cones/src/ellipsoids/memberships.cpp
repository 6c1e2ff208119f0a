// SPDX-License-Identifier: BSD-3-Clause
//
// Many velocities against one pair. The loops over a block are plain ones that compilers turn into vector
// instructions; each set of instructions has its own function, chosen when the program runs. Only that
// function and what is inlined into it may use them: no flag for the file, so no inline function that other
// files share is compiled for a machine it does not run on.
#include <vericone/cones/ellipsoids/predicates.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <string>

#include "answers/velocity_ladder.h"
#include "ellipsoids/velocity_forms.h"

namespace vericone {
namespace {

constexpr std::size_t kBlock = 64, kChunk = 16 * kBlock;

/// Answers of whole blocks of velocities, `step` doubles apart in `w`; `on` where the forms leave one
/// undecided. Returns whether they leave none. What lies far apart is asked for while the block before is
/// answered: a processor reads ahead by itself only as far as the next lines.
template <bool kDense>
[[gnu::always_inline]] inline bool answer_blocks(const detail::VelocityForms& forms, const double* w,
                                                 std::ptrdiff_t step, std::size_t blocks, Membership* out) {
  constexpr std::size_t kGroup = kDense ? kBlock : 8;  // are answered between two requests
  constexpr std::ptrdiff_t kLine = 8;                  // doubles
  const detail::VelocityForms f = forms;
  const std::ptrdiff_t row = kDense ? 3 : step;
  std::int64_t decided = 1;
  for (; blocks > 0; --blocks, w += row * std::ptrdiff_t(kBlock), out += kBlock) {
    double x[kBlock], y[kBlock], z[kBlock];
    std::int64_t side[kBlock];
    for (std::size_t i = 0; i < kBlock; ++i) {
      const double* v = w + row * std::ptrdiff_t(i);
      x[i] = v[0];
      y[i] = v[1];
      z[i] = v[2];
    }
    for (std::size_t group = 0; group < kBlock; group += kGroup) {
      if constexpr (!kDense) {
        const double* next = w + row * std::ptrdiff_t(kBlock + group + (row < 0 ? kGroup : 0));
        const std::ptrdiff_t length = std::abs(row) * std::ptrdiff_t(kGroup);
        if (blocks > 1 && length <= 32 * kLine)
          for (std::ptrdiff_t k = 0; k < length; k += kLine) __builtin_prefetch(next + k);
      }
      for (std::size_t i = group; i < group + kGroup; ++i) {
        const VelocityProducts<double> products(x[i], y[i], z[i]);
        const auto form = [&products](const double(&k)[6][2], int which) {
          return products.form([&k, which](int term) { return k[term][which]; });
        };
        const double ahead = (f.normal[0] * x[i] + f.normal[1] * y[i]) + f.normal[2] * z[i];
        side[i] = certain_side(f, form(f.outer, 0), form(f.inner, 0), form(f.inner, 1), form(f.outer, 1),
                               ahead, products.square());
      }
    }
    for (std::size_t i = 0; i < kBlock; ++i) {
      out[i] = membership_of(side[i]);
      decided &= side[i];  // 1 and -1 are odd
    }
  }
  return decided != 0;
}

using AnswerBlocks = bool(const detail::VelocityForms&, const double*, std::ptrdiff_t, std::size_t,
                          Membership*);

bool answer_by_two(const detail::VelocityForms& f, const double* w, std::ptrdiff_t step, std::size_t blocks,
                   Membership* out) {
  return step == 3 ? answer_blocks<true>(f, w, step, blocks, out)
                   : answer_blocks<false>(f, w, step, blocks, out);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] bool answer_by_four(const detail::VelocityForms& f, const double* w,
                                            std::ptrdiff_t step, std::size_t blocks, Membership* out) {
  return step == 3 ? answer_blocks<true>(f, w, step, blocks, out)
                   : answer_blocks<false>(f, w, step, blocks, out);
}

[[gnu::target("avx512f")]] bool answer_by_eight(const detail::VelocityForms& f, const double* w,
                                                std::ptrdiff_t step, std::size_t blocks, Membership* out) {
  return step == 3 ? answer_blocks<true>(f, w, step, blocks, out)
                   : answer_blocks<false>(f, w, step, blocks, out);
}

VectorWidth widest_of_the_machine() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f")) return VectorWidth::eight;
  return __builtin_cpu_supports("avx2") ? VectorWidth::four : VectorWidth::two;
}

AnswerBlocks* answers_by(VectorWidth width) {
  switch (std::min(width, widest_vectors())) {
    case VectorWidth::eight:
      return answer_by_eight;
    case VectorWidth::four:
      return answer_by_four;
    case VectorWidth::two:
      break;
  }
  return answer_by_two;
}
#else
VectorWidth widest_of_the_machine() { return VectorWidth::two; }

AnswerBlocks* answers_by(VectorWidth) { return answer_by_two; }
#endif

Eigen::Vector3d vector_at(const double* w, std::ptrdiff_t step, std::size_t i) {
  return Eigen::Map<const Eigen::Vector3d>(w + step * std::ptrdiff_t(i));
}

/// Any number of velocities up to kChunk: what is over after whole blocks goes through one filled up with the
/// last.
bool answer_chunk(AnswerBlocks* answer, const detail::VelocityForms& f, const double* w, std::ptrdiff_t step,
                  std::span<Membership> out) {
  const std::size_t blocks = out.size() / kBlock, rest = out.size() % kBlock;
  bool decided = answer(f, w, step, blocks, out.data());
  if (rest == 0) return decided;
  std::array<Eigen::Vector3d, kBlock> block;
  std::array<Membership, kBlock> answers;
  for (std::size_t i = 0; i < kBlock; ++i)
    block[i] = vector_at(w, step, blocks * kBlock + std::min(i, rest - 1));
  decided &= answer(f, block[0].data(), 3, 1, answers.data());
  std::copy_n(answers.begin(), rest, out.begin() + blocks * kBlock);
  return decided;
}

}  // namespace

VectorWidth widest_vectors() {
  static const VectorWidth width = widest_of_the_machine();
  return width;
}

void ConeOracle::memberships(std::span<const Eigen::Vector3d> w, std::span<Membership> out,
                             VectorWidth at_most) const {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
  if (out.size() != w.size())
    throw InputError("out", std::to_string(out.size()) + " answers",
                     "as many as velocities, " + std::to_string(w.size()));
  if (!w.empty()) memberships(w.front().data(), 3, out, at_most);
}

void ConeOracle::memberships(const double* w, std::ptrdiff_t step, std::span<Membership> out,
                             VectorWidth at_most) const {
  AnswerBlocks* const answer = answers_by(at_most);
  for (std::size_t begin = 0; begin < out.size(); begin += kChunk) {
    const std::size_t end = std::min(out.size(), begin + kChunk);
    const double* const chunk = w + step * std::ptrdiff_t(begin);
    std::size_t left = 0;
    if (!answer_chunk(answer, forms_, chunk, step, out.subspan(begin, end - begin)))
      for (std::size_t i = begin; i < end; ++i) {
        if (out[i] != Membership::on) continue;
        const Eigen::Vector3d v = vector_at(w, step, i);
        if (!v.allFinite()) require_finite_velocity(v, ("w[" + std::to_string(i) + "]").c_str());
        out[i] = climb_all(v, Eigen::Vector3d::Zero(), nullptr);
        ++left;
      }
    decided_by<ConeMembership>(Rung::triage, nullptr, end - begin - left);
  }
}

}  // namespace vericone
