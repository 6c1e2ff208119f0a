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
#include <string>

#include "answers/velocity_ladder.h"
#include "ellipsoids/velocity_forms.h"

namespace vericone {
namespace {

constexpr std::size_t kBlock = 64, kChunk = 16 * kBlock;

/// Answers of whole blocks of velocities, whose components follow each other in `w`; `on` where the forms
/// leave one undecided. Returns whether they leave none.
[[gnu::always_inline]] inline bool answer_blocks(const detail::VelocityForms& forms, const double* w,
                                                 std::size_t blocks, Membership* out) {
  const detail::VelocityForms f = forms;
  std::int64_t decided = 1;
  for (; blocks > 0; --blocks, w += 3 * kBlock, out += kBlock) {
    double x[kBlock], y[kBlock], z[kBlock];
    std::int64_t side[kBlock];
    for (std::size_t i = 0; i < kBlock; ++i) {
      x[i] = w[3 * i];
      y[i] = w[3 * i + 1];
      z[i] = w[3 * i + 2];
    }
    for (std::size_t i = 0; i < kBlock; ++i) {
      const VelocityProducts<double> products(x[i], y[i], z[i]);
      const auto form = [&products](const double(&k)[6][2], int which) {
        return products.form([&k, which](int term) { return k[term][which]; });
      };
      const double ahead = (f.normal[0] * x[i] + f.normal[1] * y[i]) + f.normal[2] * z[i];
      side[i] = certain_side(f, form(f.outer, 0), form(f.inner, 0), form(f.inner, 1), form(f.outer, 1), ahead,
                             products.square());
    }
    for (std::size_t i = 0; i < kBlock; ++i) {
      out[i] = membership_of(side[i]);
      decided &= side[i];  // 1 and -1 are odd
    }
  }
  return decided != 0;
}

using AnswerBlocks = bool(const detail::VelocityForms&, const double*, std::size_t, Membership*);

bool answer_by_two(const detail::VelocityForms& f, const double* w, std::size_t blocks, Membership* out) {
  return answer_blocks(f, w, blocks, out);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] bool answer_by_four(const detail::VelocityForms& f, const double* w,
                                            std::size_t blocks, Membership* out) {
  return answer_blocks(f, w, blocks, out);
}

[[gnu::target("avx512f")]] bool answer_by_eight(const detail::VelocityForms& f, const double* w,
                                                std::size_t blocks, Membership* out) {
  return answer_blocks(f, w, blocks, out);
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

/// Any number of velocities up to kChunk: what is over after whole blocks goes through one filled up with the
/// last.
bool answer_chunk(AnswerBlocks* answer, const detail::VelocityForms& f, std::span<const Eigen::Vector3d> w,
                  Membership* out) {
  const std::size_t blocks = w.size() / kBlock, rest = w.size() % kBlock;
  bool decided = answer(f, w.data()->data(), blocks, out);
  if (rest == 0) return decided;
  std::array<Eigen::Vector3d, kBlock> block;
  std::array<Membership, kBlock> answers;
  block.fill(w.back());
  std::copy_n(w.end() - rest, rest, block.begin());
  decided &= answer(f, block[0].data(), 1, answers.data());
  std::copy_n(answers.begin(), rest, out + blocks * kBlock);
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
  AnswerBlocks* const answer = answers_by(at_most);
  for (std::size_t begin = 0; begin < w.size(); begin += kChunk) {
    const std::size_t end = std::min(w.size(), begin + kChunk);
    std::size_t left = 0;
    if (!answer_chunk(answer, forms_, w.subspan(begin, end - begin), &out[begin]))
      for (std::size_t i = begin; i < end; ++i) {
        if (out[i] != Membership::on) continue;
        if (!w[i].allFinite()) require_finite_velocity(w[i], ("w[" + std::to_string(i) + "]").c_str());
        out[i] = climb_all(w[i], Eigen::Vector3d::Zero(), nullptr);
        ++left;
      }
    decided_by<ConeMembership>(Rung::triage, nullptr, end - begin - left);
  }
}

}  // namespace vericone
