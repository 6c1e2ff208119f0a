// SPDX-License-Identifier: BSD-3-Clause
//
// What the parts of the C interface share: the objects behind its pointers, errors, vectors.
#pragma once

#include <vericone/cones/pair.h>
#include <vericone/geometry/body.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <iterator>
#include <limits>
#include <new>
#include <optional>
#include <string>
#include <type_traits>

#include "vericone_c.h"

struct vericone_body {
  vericone::Body body;
};
struct vericone_pair {
  vericone::Pair pair;
};

namespace vericone::c {

using Eigen::Matrix3d;
using Eigen::Vector3d;

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
/// What vericone_error() says from now on in this thread; returns `status`.
int32_t failed(int32_t status, const char* text) noexcept;

/// What `make` returns; after an error NULL, the error's number, or NaN.
template <typename Make>
auto answered(Make make) noexcept -> decltype(make()) {
  using Result = decltype(make());
  int32_t status = VERICONE_FAILED;
  try {
    return make();
  } catch (const InputError& e) {
    status = failed(VERICONE_BAD_INPUT, e.what());
  } catch (const std::bad_alloc&) {
    status = failed(VERICONE_NO_MEMORY, "out of memory");
  } catch (const std::exception& e) {
    failed(status, e.what());
  } catch (...) {
    failed(status, "unknown");
  }
  if constexpr (std::is_pointer_v<Result>)
    return nullptr;
  else if constexpr (std::is_floating_point_v<Result>)
    return kNan;
  else
    return status;
}

/// *p; throws InputError naming `name` where there is nothing.
template <typename T>
T& given(T* p, const char* name) {
  if (!p) throw InputError(name, "NULL", "given");
  return *p;
}

inline Vector3d vector(const double* x, const char* name) { return Vector3d(&given(x, name)); }

inline Matrix3d rows(const double* rotation) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation);
}
inline Matrix3d rotation_of(const double* rotation) {
  return rotation ? rows(rotation) : Matrix3d::Identity();
}
/// All zero, as who names only some fields of a struct leaves it: not turned.
inline Matrix3d rotation_in(const double (&rotation)[9]) {
  return std::all_of(std::begin(rotation), std::end(rotation), [](double x) { return x == 0; })
             ? Matrix3d::Identity()
             : rows(rotation);
}

inline void write(const Vector3d& x, double* to) {
  if (to) std::copy_n(x.data(), 3, to);
}
inline void write(const std::optional<Vector3d>& x, double* to) {
  write(x.value_or(Vector3d::Constant(kNan)), to);
}

inline Placed placed(const vericone_body* body, const double* position, const double* rotation,
                     const char* name) {
  return {given(body, name).body, {vector(position, "position"), rotation_of(rotation)}};
}

}  // namespace vericone::c
