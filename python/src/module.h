// SPDX-License-Identifier: BSD-3-Clause
//
// What a module is made of, and what all modules of the package share: the types, and the one below all of
// them.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <unordered_map>

#include "pybind.h"

namespace vericone::python {

/// One for all modules.
struct Shared {
  std::unordered_map<std::string, std::unique_ptr<TypeInfo>> types;
  PyTypeObject* base = nullptr;  // below all of them
  std::atomic<int> left_behind =
      0;             // calls that were interrupted and left to themselves, and have not ended yet
  int answered = 0;  // which overload has answered the last call: tests reach them all
};
[[nodiscard]] Shared& shared();

/// In the namespace that its name says: of "guidance.GuideMemory.Past" the first part, the rest are types.
void put(const char* name, const py::object& what);
/// Without its namespace and the types that it is in.
[[nodiscard]] std::string short_name(const TypeInfo& info);
/// Null where it is no type of the library.
[[nodiscard]] const TypeInfo* info_of_type(const PyTypeObject* type);

/// The type below all others, made once, by _core.
[[nodiscard]] PyTypeObject* make_base_type();
/// _core._restore(type, state): what pickle calls.
PyObject* restore(PyObject* module, PyObject* arguments);

}  // namespace vericone::python
