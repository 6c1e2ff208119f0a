// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace vericone {

/// A list that allocates only beyond N entries.
template <typename T, std::size_t N>
class SmallList {
 public:
  void push_back(const T& x) {
    if (size_ < N) {
      first_[size_] = x;
    } else {
      if (rest_.empty()) rest_.assign(first_.begin(), first_.end());
      rest_.push_back(x);
    }
    ++size_;
  }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* begin() { return size_ <= N ? first_.data() : rest_.data(); }
  T* end() { return begin() + size_; }
  const T* begin() const { return size_ <= N ? first_.data() : rest_.data(); }
  const T* end() const { return begin() + size_; }
  const T& operator[](std::size_t i) const { return begin()[i]; }

 private:
  std::array<T, N> first_;
  std::vector<T> rest_;
  std::size_t size_ = 0;
};

}  // namespace vericone
