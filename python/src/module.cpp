// SPDX-License-Identifier: BSD-3-Clause
#include "module.h"

#include <cstring>
#include <memory>
#include <sstream>
#include <string>

#include "call.h"

namespace vericone::python {
namespace {

Shared* all = nullptr;
PyObject* module_names = nullptr;

/// Where users find the names of a namespace.
std::string module_of(const std::string& space) {
  if (space == "verify") return "vericone_verify";
  return "vericone" + (space.empty() ? "" : "." + space);
}

/// The dictionary of a namespace of this module: "" or "guidance".
py::dict names_of(const std::string& space) {
  const auto names = py::reinterpret_borrow<py::dict>(module_names);
  if (!names.contains(space)) names[py::str(space)] = py::dict();
  return names[py::str(space)];
}

}  // namespace

void put(const char* name, const py::object& what) {
  std::string space, rest = name;
  py::object at;
  for (std::size_t dot; (dot = rest.find('.')) != std::string::npos; rest.erase(0, dot + 1)) {
    const std::string part = rest.substr(0, dot);
    if (at)
      at = at.attr(part.c_str());
    else if (names_of(space).contains(part))
      at = names_of(space)[part.c_str()];
    else
      space += (space.empty() ? "" : ".") + part;
  }
  what.attr("__module__") = module_of(space);
  const std::string whole = name;
  what.attr("__qualname__") = space.empty() ? whole : whole.substr(space.size() + 1);
  if (at)
    PyObject_SetAttrString(at.ptr(), rest.c_str(), what.ptr());
  else
    names_of(space)[rest.c_str()] = what;
}

Shared& shared() { return *all; }

TypeInfo& type_of(const std::type_info& type) {
  auto& info = all->types[type.name()];
  if (!info) info = std::make_unique<TypeInfo>();
  return *info;
}

const TypeInfo* info_of_type(const PyTypeObject* type) {
  for (const auto& [name, info] : all->types)
    if (info->type == type) return info.get();
  return nullptr;
}

std::string short_name(const TypeInfo& info) {
  const char* dot = std::strrchr(info.name, '.');
  return dot ? dot + 1 : info.name;
}

void add_enum(const std::type_info& type, const char* name, const char* members, const char* doc) {
  static constinit Imported named_int("vericone._enums", "NamedInt");
  TypeInfo& info = type_of(type);
  info.name = name;
  py::list pairs;
  std::istringstream text(members);
  std::string member;
  for (long long value = 0; text >> member >> value;) pairs.append(py::make_tuple(member, value));
  const py::object made = named_int.get()(short_name(info), pairs);
  made.attr("__doc__") = doc;
  put(name, made);
  for (const py::handle pair : pairs) {
    const py::object value = pair[py::int_(1)];
    info.members.emplace_back(value.cast<long long>(), made(value).release().ptr());
  }
  info.type = reinterpret_cast<PyTypeObject*>(made.inc_ref().ptr());
}

PyObject* enum_member(const TypeInfo& info, long long value) {
  for (const auto& [number, member] : info.members)
    if (number == value) return Py_NewRef(member);
  return PyLong_FromLongLong(value);
}

long long enum_value(const TypeInfo& info, PyObject* given, const Place& place) {
  const bool own = PyObject_TypeCheck(given, info.type);
  if (!own && (!PyLong_CheckExact(given))) wrong_type(place, (std::string("a ") + info.name).c_str(), given);
  const long long value = PyLong_AsLongLong(given);
  if (value == -1 && PyErr_Occurred()) PyErr_Clear();
  for (const auto& [number, member] : info.members)
    if (number == value) return value;
  std::string names;
  for (const auto& [number, member] : info.members)
    names += (names.empty() ? "" : ", ") + std::string(py::str(py::handle(member).attr("name")));
  throw InputError(place.text(), py::str(py::handle(given)), "one of " + names);
}

void add_function(const char* space, PyMethodDef* method) {
  const py::str name(module_of(space));
  const auto function = py::reinterpret_steal<py::object>(PyCFunction_NewEx(method, nullptr, name.ptr()));
  names_of(space)[method->ml_name] = function;
}

void add_constant(const char* space, const char* name, PyObject* value) {
  names_of(space)[name] = py::reinterpret_steal<py::object>(value);
}

namespace {

PyMethodDef left_method = {"_left_behind",
                           [](PyObject*, PyObject*) { return PyLong_FromLong(all->left_behind); },
                           METH_NOARGS, "How many interrupted calls have not ended yet."};
PyMethodDef overload_method = {"_answered_overload",
                               [](PyObject*, PyObject*) { return PyLong_FromLong(all->answered); },
                               METH_NOARGS, "Which overload has answered the last call, from 0."};
PyMethodDef restore_method = {"_restore", restore, METH_VARARGS, "For pickle."};

void begin_module(py::module_& module) {
  const py::dict names;
  module.attr("_names") = names;
  module_names = names.ptr();
  const py::str name = module.attr("__name__");
  if (std::string(name) == "vericone._core") {
    all = new Shared;
    all->base = make_base_type();
    module.attr("_shared") = py::capsule(all);
    module.attr("_Object") = py::handle(reinterpret_cast<PyObject*>(all->base));
    module.attr("_restore") =
        py::reinterpret_steal<py::object>(PyCFunction_NewEx(&restore_method, nullptr, name.ptr()));
    module.attr("_left_behind") =
        py::reinterpret_steal<py::object>(PyCFunction_NewEx(&left_method, nullptr, name.ptr()));
    module.attr("_answered_overload") =
        py::reinterpret_steal<py::object>(PyCFunction_NewEx(&overload_method, nullptr, name.ptr()));
  } else {
    const py::module_ core = py::module_::import("vericone._core");
    all = core.attr("_shared").cast<py::capsule>().get_pointer<Shared>();
  }
}

}  // namespace

PyObject* make_module(const char* name, void (*fill)()) noexcept {
  try {
    py::detail::get_internals();
    py::detail::npy_api::get();
    static py::module_::module_def definition;
    auto module = py::module_::create_extension_module(name, nullptr, &definition);
    begin_module(module);
    fill();
    return module.release().ptr();
  } catch (py::error_already_set& error) {
    py::raise_from(error, PyExc_ImportError, "initialization failed");
  } catch (const std::exception& error) {
    PyErr_SetString(PyExc_ImportError, error.what());
  }
  return nullptr;
}

}  // namespace vericone::python
