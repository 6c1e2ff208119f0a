// SPDX-License-Identifier: BSD-3-Clause
//
// What the generated sources of a module say of its types, beside the calls.
#pragma once

#include <cstddef>

#include "batch.h"

namespace vericone::python {

template <class T>
void describe(TypeInfo& info) {
  if constexpr (std::is_default_constructible_v<T> && std::is_copy_constructible_v<T>)
    info.make = [] { return own(new T()); };
  if constexpr (std::is_copy_constructible_v<T>)
    info.copy = [](const void* value) { return own(new T(*static_cast<const T*>(value))); };
}

template <class T, class Base>
void inherit(TypeInfo& info) {
  info.base = &type_of<Base>();
  info.to_base = [](void* value) -> void* { return static_cast<Base*>(static_cast<T*>(value)); };
}

template <class T, class F>
void derive(TypeInfo& info, const char* name, F) {
  using R = std::remove_cvref_t<std::invoke_result_t<F, const T&>>;
  info.derived.push_back({name, Convert<R>::kColumn, [](void* row, const void* record) {
                            const R value = F{}(*static_cast<const T*>(record));
                            Convert<R>::kColumn->write(row, &value);
                          }});
}

/// What C++ leaves to its callers (REQUIRES of generate/rules.py).
inline void require(bool holds, const char* field, const char* given, const char* requirement) {
  if (!holds) throw InputError(field, given, requirement);
}

/// The library's own check() of an argument, which names the part.
template <class T, class Check>
void require_sound(const T& argument, const char* name, Check&& check) {
  try {
    check(argument);
  } catch (const InputError& e) {
    throw e.within(name);
  }
}

template <class List, class Check>
void require_all_sound(const List& list, const char* name, Check&& check) {
  std::size_t i = 0;
  for (const auto& one : list) require_sound(one, (name + ("[" + std::to_string(i++) + "]")).c_str(), check);
}

/// A function of the vectorcall convention, as a table of methods holds it.
inline PyCFunction method(PyObject* (*function)(PyObject*, PyObject* const*, Py_ssize_t, PyObject*)) {
  return reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(function));
}

inline bool could_many(PyObject* given) { return is_number(given) || is_sequence(given); }
template <class T>
bool could_be_many(PyObject* given) {
  return could_be(given, type_of<T>()) || is_sequence(given);
}
template <class T>
bool could_be_or_none(PyObject* given) {
  return given == Py_None || could_be(given, type_of<T>());
}

}  // namespace vericone::python
