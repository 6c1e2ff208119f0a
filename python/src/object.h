// SPDX-License-Identifier: BSD-3-Clause
//
// C++ values as Python objects. One layout for all of them: a shared pointer to the value and, for those that
// change, a lock. The tables that describe the types are generated from the public headers.
#pragma once

// No pybind11 here: what its headers emit into everything that includes them is compiled ten times then.
#include <Python.h>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

namespace vericone::python {

/// A reference to a Python object, or none. The global lock is held wherever one is copied or ends.
class Reference {
 public:
  Reference() = default;
  explicit Reference(PyObject* owned) : object_(owned) {}
  [[nodiscard]] static Reference to(PyObject* borrowed) { return Reference(Py_XNewRef(borrowed)); }
  Reference(const Reference& other) : object_(Py_XNewRef(other.object_)) {}
  Reference(Reference&& other) noexcept : object_(other.release()) {}
  Reference& operator=(Reference other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Reference() { Py_XDECREF(object_); }

  [[nodiscard]] PyObject* get() const { return object_; }
  [[nodiscard]] PyObject* release() { return std::exchange(object_, nullptr); }

 private:
  PyObject* object_ = nullptr;
};

/// Where in the arguments of a call a value stands: "options.plane.choice", "bodies[3]".
struct Place {
  const Place* outer = nullptr;
  const char* name = nullptr;  // null: an index
  Py_ssize_t index = 0;

  [[nodiscard]] std::string text() const;
};

/// An argument of a kind that the parameter does not take: the next overload is tried, and none is a
/// TypeError.
struct WrongType {
  std::string message;
};
[[noreturn]] void wrong_type(const Place& place, const char* wanted, PyObject* given);

/// How values of one C++ type come from and go to Python, without their type.
struct Converter {
  PyObject* (*to)(const void* value);
  void (*from)(void* value, PyObject* given, const Place& place);
  const struct Column* column;  // null: not a column of an array of records
};

/// How a value lies in the row of a numpy record array.
struct Column {
  std::string (*format)();  // of numpy: "f8", "(3,)f8"; of a record "" (see fields)
  Py_ssize_t size;
  void (*write)(void* row, const void* value);
  void (*write_nothing)(void* row);
  const struct TypeInfo* (*record)() = nullptr;
};

struct Field {
  const char* name;
  std::size_t offset;  // in the value
  const Converter* converter;
  bool required;  // C++ gives it no value of its own
  const char* doc;
};

/// A method without arguments that an array of records has as a column too.
struct DerivedColumn {
  const char* name;
  const Column* column;
  void (*write)(void* row, const void* record);
};

/// A new object, which the result owns. Not std::make_shared: 897 of the 5,285 functions that one generated
/// source had were its, for each type again.
[[nodiscard]] std::shared_ptr<void> own(void* object, void (*destroy)(void*));
template <class T>
[[nodiscard]] std::shared_ptr<void> own(T* object) {
  return own(object, [](void* held) { delete static_cast<T*>(held); });
}

/// Throws what Python has raised.
[[noreturn]] void throw_raised();
/// Takes the global lock back; for ever waiting when Python ends.
void take_back(PyThreadState* state) noexcept;
[[nodiscard]] PyGILState_STATE take_lock() noexcept;
/// Holds the global lock, in any thread.
class GlobalLock {
 public:
  GlobalLock() : state_(take_lock()) {}
  ~GlobalLock() { PyGILState_Release(state_); }
  GlobalLock(const GlobalLock&) = delete;
  GlobalLock& operator=(const GlobalLock&) = delete;

 private:
  PyGILState_STATE state_;
};

struct TypeInfo {
  const char* name = "";  // "guidance.NavigatorOptions"
  PyTypeObject* type = nullptr;
  std::shared_ptr<void> (*make)() = nullptr;             // by default; of records
  std::shared_ptr<void> (*copy)(const void*) = nullptr;  // null: there is only one
  std::vector<Field> fields;                             // of records
  std::vector<DerivedColumn> derived;
  TypeInfo* base = nullptr;
  void* (*to_base)(void*) = nullptr;
  bool machine = false;  // changes: one call at a time
  /// The plain values that define an object, and the object of such values: what ==, pickle and repr go by.
  PyObject* (*state)(const void*) = nullptr;
  std::shared_ptr<void> (*restore)(PyObject* state) = nullptr;
  const char* state_names = "";  // of its parts: "center, shape"
  /// Other types that stand for one of this: null where the object is none of them.
  std::shared_ptr<void> (*stand_in)(PyObject* given, const Place& place) = nullptr;
  bool (*has_stand_in)(PyObject* given) = nullptr;
  std::vector<std::pair<long long, PyObject*>> members;  // of an enumeration
};

/// The description of a type, the same in all modules of the package; `name` is that of the C++ type.
TypeInfo& type_of(const std::type_info& type);
template <class T>
TypeInfo& type_of() {
  static TypeInfo& info = type_of(typeid(T));
  return info;
}

struct Instance {
  PyObject ob_base;
  std::shared_ptr<void> value;
  const TypeInfo* info;
  std::unique_ptr<std::recursive_mutex> lock;  // of machines
  PyObject* kept;                              // what the value refers to
  std::vector<std::shared_ptr<void>> made;     // and what stood for some of it
  PyObject* weak_references;
};

[[nodiscard]] bool is_object(PyObject* object);  // of any type of the library that is no enumeration
[[nodiscard]] bool is_instance(PyObject* object, const TypeInfo& info);
/// The value, seen as one of `info` (its own type or a base).
[[nodiscard]] void* value_of(PyObject* object, const TypeInfo& info);
/// While its value is read with the global lock held: of a machine, no other thread changes it meanwhile.
class Hold {
 public:
  explicit Hold(PyObject* object);
  ~Hold();
  Hold(const Hold&) = delete;
  Hold& operator=(const Hold&) = delete;

 private:
  std::recursive_mutex* lock_;
};
/// The machines that a call uses, locked together, without the global lock. No other call uses them then.
class Machines {
 public:
  void add(PyObject* object);  // nothing, where it is none
  [[nodiscard]] bool none() const { return locks_.empty(); }
  void lock();
  void unlock();

 private:
  std::vector<std::recursive_mutex*> locks_;  // in the order of their addresses, each once
};
/// As it is held, seen so.
[[nodiscard]] std::shared_ptr<void> shared_of(PyObject* object, const TypeInfo& info);
/// A new reference.
[[nodiscard]] PyObject* new_instance(const TypeInfo& info, std::shared_ptr<void> value);
/// What was just made, as one of `type`: its own, or a class that a program has derived from it. Takes the
/// reference.
[[nodiscard]] PyObject* as_type(PyObject* made, PyTypeObject* type);

/// An object that refers to another: that lives as long. Takes and returns the reference to the first.
[[nodiscard]] PyObject* keeping(PyObject* made, PyObject* other);

/// How objects of a type are made, beside its constructor: ", Ellipse.from_axes(), Ellipse.from_shape()";
/// empty where nothing of its own does.
[[nodiscard]] std::string makers_text(PyTypeObject* type);
/// Makes the Python type of `info` (its fields included) in the namespace that its name says.
void add_type(TypeInfo& info, const char* doc, PyMethodDef* methods, newfunc construct);
/// An enum.IntEnum of these members, separated by spaces: "disjoint 0 touching 1".
void add_enum(const std::type_info& type, const char* name, const char* members, const char* doc);
[[nodiscard]] PyObject* enum_member(const TypeInfo& info, long long value);
[[nodiscard]] long long enum_value(const TypeInfo& info, PyObject* given, const Place& place);

/// A function, or a method where `info` says of which type.
void add_function(const char* space, PyMethodDef* method);
/// Takes the reference.
void add_constant(const char* space, const char* name, PyObject* value);

/// Makes this module, whose names `fill` adds, and sets up what all modules of the package share: the first
/// is _core; others find what it has made. Null where that raised.
[[nodiscard]] PyObject* make_module(const char* name, void (*fill)()) noexcept;

/// The numpy dtype of records of this type, or null where a field is no column.
[[nodiscard]] Reference record_dtype(const TypeInfo& info);
[[nodiscard]] Py_ssize_t record_size(const TypeInfo& info);
void write_record(void* row, const TypeInfo& info, const void* record);
void write_no_record(void* row, const TypeInfo& info);

}  // namespace vericone::python
