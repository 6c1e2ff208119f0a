// SPDX-License-Identifier: BSD-3-Clause
//
// pybind11 for the runtime alone: its objects, arrays and exceptions.
#pragma once

#include <pybind11/numpy.h>

#include "object.h"

namespace vericone::python {

namespace py = pybind11;

/// The same reference, as a type of pybind11.
template <class T = py::object>
[[nodiscard]] T as_pybind(const Reference& reference) {
  return py::reinterpret_borrow<T>(reference.get());
}
[[nodiscard]] inline Reference reference_to(py::object object) { return Reference(object.release().ptr()); }

}  // namespace vericone::python
