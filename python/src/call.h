// SPDX-License-Identifier: BSD-3-Clause
//
// Calls from Python: arguments bound to parameters, overloads chosen, one question or many answered without
// the global lock, and what C++ throws made an exception of Python.
#pragma once

#include <vericone/geometry/error.h>
#include <chrono>
#include <initializer_list>
#include <tuple>

#include "convert.h"

namespace vericone::python {

struct Parameter {
  const char* name;
  bool (*could)(PyObject*);  // null: anything
  bool optional = false, keyword_only = false;
  /// Of options: their type. Their fields may be given by name, in place of the record.
  const struct TypeInfo* (*options)() = nullptr;
};
template <class T>
const TypeInfo* options_of() {
  return &type_of<T>();
}

class Given;
/// Whether a call may take more than a few tenths of a second, so that Ctrl-C has to end it.
enum class Work : std::uint8_t {
  quick,
  grows,  // where its lists are long
  lasts
};
struct Overload {
  std::span<const Parameter> parameters;
  PyObject* (*call)(Given&);
  Work work = Work::quick;
};

/// The arguments of one call.
class Given {
 public:
  static constexpr int kMost = 40;
  /// Of the object itself; of a function about many objects `self` may be a sequence of them.
  PyObject* self = nullptr;
  Machines machines;  // among the arguments that are not copied

  [[nodiscard]] bool has(int i) const { return values_[i] != nullptr; }
  [[nodiscard]] PyObject* value(int i) const { return i < 0 ? self : values_[i]; }  // -1: self
  [[nodiscard]] Place place(int i) const { return {nullptr, i < 0 ? "self" : parameters_[i].name}; }

  template <class T>
  [[nodiscard]] T get(int i) const {
    return Convert<T>::from(values_[i], place(i));
  }
  /// A shared object, or several: None is none.
  template <class T>
  [[nodiscard]] T present(int i) const {
    T value = get<T>(i);
    const auto require = [&](const auto& shared) {
      if (!shared) throw WrongType{std::string(place(i).name) + ": got None, which it does not take"};
    };
    if constexpr (requires { value.size(); })
      for (const auto& shared : value) require(shared);
    else
      require(value);
    return value;
  }
  template <class T>
  [[nodiscard]] T& object(int i) {
    return *static_cast<T*>(object(i, type_of<T>()));
  }
  template <class T>
  [[nodiscard]] const T* pointer(int i) {
    return !has(i) || values_[i] == Py_None ? nullptr : &object<T>(i);
  }
  /// Whether the keyword `rung=True` and its like was given.
  [[nodiscard]] bool wants(int i) const { return has(i) && Convert<bool>::from(values_[i], place(i)); }
  [[nodiscard]] int threads(int i) const;

  /// Binds; false where they do not fit these parameters: `why` says it, and `fitting` of them, at the
  /// beginning, do.
  bool bind(std::span<const Parameter> parameters, PyObject* const* positional, Py_ssize_t n, PyObject* names,
            PyObject* const* named, std::string& why, std::size_t& fitting);

  /// Whether a list, an array or a text among the arguments is so long that work on it may last.
  [[nodiscard]] bool long_lists() const;
  /// Holds on to all arguments: this goes to another thread.
  void keep();

  /// What was made of arguments that stand for others.
  [[nodiscard]] std::vector<std::shared_ptr<void>>& made() { return made_; }

 private:
  [[nodiscard]] void* object(int i, const TypeInfo& info);
  /// Which options have this field; -1: none.
  [[nodiscard]] int options_with(const char* name) const;

  std::span<const Parameter> parameters_;
  PyObject* values_[kMost] = {};
  std::vector<std::shared_ptr<void>> made_;
  std::vector<Reference> kept_;
};

/// `name`, for messages. The vectorcall convention of methods.
PyObject* call(const char* name, std::span<const Overload> overloads, PyObject* self,
               PyObject* const* arguments, Py_ssize_t n, PyObject* names) noexcept;
/// As call(), of a tuple and a dictionary.
PyObject* construct(const char* name, std::span<const Overload> overloads, PyTypeObject* type,
                    PyObject* arguments, PyObject* named) noexcept;
/// A record from the values of its fields, in their order or by name.
PyObject* construct_record(const TypeInfo& info, PyTypeObject* type, PyObject* arguments,
                           PyObject* named) noexcept;
/// A method about many objects: the first argument is the object, or a list of them.
PyObject* call_many(const char* name, std::span<const Overload> overloads, PyObject* const* arguments,
                    Py_ssize_t n, PyObject* names) noexcept;
/// Which overload has answered the last call (with the global lock held): asked by tests, which reach them
/// all.
[[nodiscard]] int answered_overload();
/// How many calls were interrupted and left to themselves, and have not ended yet.
[[nodiscard]] int calls_left_behind();
/// What is being thrown, as an exception of Python; returns null.
PyObject* raise_current(const std::string& at = {}) noexcept;

/// The global lock is released, and the machines are locked, as long as this lives.
class Quiet {
 public:
  explicit Quiet(Machines& machines);
  ~Quiet();
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  Machines& machines_;
  PyThreadState* state_;
};

/// How often a thread that waits or works looks for signals.
inline constexpr auto kBetweenSignals = std::chrono::milliseconds(25);

template <class F>
auto run(Given& given, F&& f) {
  const Quiet quiet(given.machines);
  return std::remove_cvref_t<std::invoke_result_t<F>>(f());
}
template <class T>
[[nodiscard]] PyObject* to_python(T&& value) {
  return Convert<std::remove_cvref_t<T>>::to(std::forward<T>(value));
}
/// Several results as a tuple; takes the references.
[[nodiscard]] PyObject* tuple_of(std::initializer_list<PyObject*> parts);
/// A copy of what a pointer points to, or nothing.
template <class T>
[[nodiscard]] std::optional<std::vector<T>> copied(const std::vector<T>* value) {
  return value ? std::optional(*value) : std::nullopt;
}
template <class T>
[[nodiscard]] std::shared_ptr<std::remove_const_t<T>> copied(T* value) {
  return value ? std::make_shared<std::remove_const_t<T>>(*value) : nullptr;
}

}  // namespace vericone::python
