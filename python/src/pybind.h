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

/// "float64". Not by str(): numpy 1.24 keeps some memory of each such text of a time.
[[nodiscard]] inline std::string dtype_name(const py::array& array) {
  return py::str(array.dtype().attr("name"));
}

/// Without the global lock, as long as this lives. A thread that wants it when Python ends waits for ever:
/// Python would end it by an exception that no destructor lets through.
class Released {
 public:
  Released() : state_(PyEval_SaveThread()) {}
  ~Released() { take_back(state_); }
  Released(const Released&) = delete;
  Released& operator=(const Released&) = delete;

 private:
  PyThreadState* state_;
};

/// Something of a module of Python, imported when it is first asked for. A static variable that is made by an
/// import would not do: an import lets other threads have the global lock, and one of them would hold it
/// while it waits for that variable.
class Imported {
 public:
  constexpr Imported(const char* module, const char* name) : module_(module), name_(name) {}
  [[nodiscard]] py::object get() {
    if (!held_) {
      py::object found = py::module_::import(module_).attr(name_);
      if (!held_) held_ = found.release().ptr();  // for ever
    }
    return py::reinterpret_borrow<py::object>(held_);
  }

 private:
  const char *module_, *name_;
  PyObject* held_ = nullptr;
};

}  // namespace vericone::python
