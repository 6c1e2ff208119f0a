// SPDX-License-Identifier: BSD-3-Clause
#include "object.h"

#include <structmember.h>
#include <algorithm>
#include <chrono>
#include <cstring>
#include <deque>
#include <functional>
#include <sstream>
#include <string_view>
#include <thread>

#include "call.h"
#include "module.h"

namespace vericone::python {
namespace {

// Tables of C keep what they point to for ever.
std::deque<std::vector<PyGetSetDef>> getters;
std::deque<std::string> texts;
const char* keep(std::string text) { return texts.emplace_back(std::move(text)).c_str(); }

const TypeInfo& info_of(PyObject* object) { return *reinterpret_cast<Instance*>(object)->info; }

void* own_value(PyObject* object) { return reinterpret_cast<Instance*>(object)->value.get(); }

void destroy(PyObject* self) {
  auto* instance = reinterpret_cast<Instance*>(self);
  PyTypeObject* type = Py_TYPE(self);
  if (instance->weak_references) PyObject_ClearWeakRefs(self);
  instance->value.~shared_ptr();
  instance->lock.~unique_ptr();
  instance->made.~vector();
  Py_XDECREF(instance->kept);
  type->tp_free(self);
  Py_DECREF(type);
}

PyObject* get_field(PyObject* self, void* closure) {
  const auto& field = *static_cast<const Field*>(closure);
  try {
    // Python lets a class have two bases of ours, or an object change its class: the value is of one.
    bool own = false;
    for (const TypeInfo* info = &info_of(self); info && !own; info = info->base)
      own = !info->fields.empty() && !std::less<>()(&field, info->fields.data()) &&
            std::less<>()(&field, info->fields.data() + info->fields.size());
    if (!own) throw WrongType{std::string("a ") + info_of(self).name + " has no field '" + field.name + "'"};
    const Hold hold(self);
    return field.converter->to(static_cast<const char*>(own_value(self)) + field.offset);
  } catch (...) {
    return raise_current();
  }
}

/// What defines an object, as a tuple: of a record the values of its fields. Null, without an error, where
/// nothing does.
PyObject* state_of(PyObject* self) {
  const TypeInfo& info = info_of(self);
  const Hold hold(self);
  if (info.state) return info.state(own_value(self));
  if (info.fields.empty()) return nullptr;
  py::tuple state(info.fields.size());
  for (std::size_t i = 0; i < info.fields.size(); ++i) {
    PyObject* part = get_field(self, const_cast<Field*>(&info.fields[i]));
    if (!part) throw py::error_already_set();
    PyTuple_SET_ITEM(state.ptr(), static_cast<Py_ssize_t>(i), part);
  }
  return state.release().ptr();
}

bool equal(PyObject* a, PyObject* b) {
  if (a == b) return true;
  if (PyFloat_Check(a) && PyFloat_Check(b)) {
    const double x = PyFloat_AS_DOUBLE(a), y = PyFloat_AS_DOUBLE(b);
    return x == y || (x != x && y != y);
  }
  if (py::isinstance<py::array>(a) && py::isinstance<py::array>(b)) {
    const auto x = py::reinterpret_borrow<py::array>(a), y = py::reinterpret_borrow<py::array>(b);
    const bool numbers = x.dtype().kind() == 'f' && y.dtype().kind() == 'f';
    return py::bool_(py::module_::import("numpy").attr("array_equal")(x, y, numbers));
  }
  if ((PyList_Check(a) && PyList_Check(b)) || (PyTuple_Check(a) && PyTuple_Check(b))) {
    const Py_ssize_t n = PySequence_Fast_GET_SIZE(a);
    if (n != PySequence_Fast_GET_SIZE(b)) return false;
    for (Py_ssize_t i = 0; i < n; ++i)
      if (!equal(PySequence_Fast_GET_ITEM(a, i), PySequence_Fast_GET_ITEM(b, i))) return false;
    return true;
  }
  const int same = PyObject_RichCompareBool(a, b, Py_EQ);
  if (same < 0) throw py::error_already_set();
  return same != 0;
}

PyObject* compare(PyObject* a, PyObject* b, int operation) {
  if ((operation != Py_EQ && operation != Py_NE) || Py_TYPE(a) != Py_TYPE(b) || &info_of(a) != &info_of(b))
    Py_RETURN_NOTIMPLEMENTED;
  try {
    bool same = a == b;
    if (!same) {
      const auto x = py::reinterpret_steal<py::object>(state_of(a));
      if (!x && !PyErr_Occurred()) Py_RETURN_NOTIMPLEMENTED;  // by identity
      const auto y = py::reinterpret_steal<py::object>(state_of(b));
      same = equal(x.ptr(), y.ptr());
    }
    return PyBool_FromLong(same == (operation == Py_EQ));
  } catch (...) {
    return raise_current();
  }
}

/// What an object of the library shows of one inside it: its kind alone where the whole is long.
constexpr std::size_t kLongPart = 72;

/// Short: numbers as they are; what is long by its shape or kind, so that a body or a pair is one line.
std::string brief(PyObject* part) {
  if (py::isinstance<py::array>(part)) {
    const auto array = py::reinterpret_borrow<py::array>(part);
    if (array.size() <= 16)
      if (std::string text = py::str(py::repr(array.attr("tolist")())); text.size() <= kLongPart) return text;
    return "<array " + std::string(py::str(py::repr(array.attr("shape")))) + ">";
  }
  if (is_object(part)) {
    std::string text = py::str(py::repr(py::handle(part)));
    return text.size() <= kLongPart ? text : "<" + short_name(info_of(part)) + ">";
  }
  if (PyList_Check(part) && PyList_GET_SIZE(part) > 4)
    return "<list of " + std::to_string(PyList_GET_SIZE(part)) + ">";
  if (PyList_Check(part) || PyTuple_CheckExact(part)) {
    std::string text(1, PyList_Check(part) ? '[' : '(');
    const Py_ssize_t n = PySequence_Fast_GET_SIZE(part);
    for (Py_ssize_t i = 0; i < n; ++i) text += (i > 0 ? ", " : "") + brief(PySequence_Fast_GET_ITEM(part, i));
    return text + (PyList_Check(part) ? "]" : n == 1 ? ",)" : ")");
  }
  // Python refuses to print integers of more than 4,300 digits.
  constexpr int kMostBits = 4000;
  static constinit Imported fraction("fractions", "Fraction");
  const auto bits = [](const py::object& whole) { return whole.attr("bit_length")().cast<long long>(); };
  const auto value = py::reinterpret_borrow<py::object>(part);
  if (PyLong_CheckExact(part) && bits(value) > kMostBits)
    return "<integer of " + std::to_string(bits(value)) + " bits>";
  if (py::isinstance(value, fraction.get())) {
    const long long top = bits(value.attr("numerator")), bottom = bits(value.attr("denominator"));
    if (std::max(top, bottom) > kMostBits)
      return "<fraction of " + std::to_string(top) + " and " + std::to_string(bottom) + " bits>";
  }
  return py::str(py::repr(value));
}

PyObject* represent(PyObject* self) {
  const TypeInfo& info = info_of(self);
  try {
    const auto state = py::reinterpret_steal<py::object>(state_of(self));
    std::string text = short_name(info) + "(";
    if (!state) {
      text = "<vericone." + std::string(info.name) + ">";
      return Convert<std::string>::to(text);
    }
    std::istringstream names(info.state_names);
    for (Py_ssize_t i = 0; i < PyTuple_GET_SIZE(state.ptr()); ++i) {
      std::string name;
      if (info.state)
        names >> name;
      else
        name = info.fields[static_cast<std::size_t>(i)].name;
      text +=
          (i > 0 ? ", " : "") + (name.empty() ? "" : name + "=") + brief(PyTuple_GET_ITEM(state.ptr(), i));
    }
    return Convert<std::string>::to(text + ")");
  } catch (...) {
    return raise_current();
  }
}

PyObject* reduce(PyObject* self, PyObject*) {
  try {
    auto state = py::reinterpret_steal<py::object>(state_of(self));
    if (!state || (!info_of(self).restore && !info_of(self).make))
      throw WrongType{"a " + short_name(info_of(self)) + " cannot be pickled: keep what it was made of"};
    const py::object restore = py::module_::import("vericone._core").attr("_restore");
    const auto given = py::make_tuple(py::handle(reinterpret_cast<PyObject*>(Py_TYPE(self))), state);
    // Of a class that a program has derived: what it has set, too.
    const py::object set = py::getattr(py::handle(self), "__dict__", py::none());
    return (set.is_none() ? py::make_tuple(restore, given) : py::make_tuple(restore, given, set))
        .release()
        .ptr();
  } catch (...) {
    return raise_current();
  }
}

}  // namespace

PyObject* restore(PyObject*, PyObject* arguments) {
  try {
    PyObject *type = nullptr, *state = nullptr;
    if (!PyArg_ParseTuple(arguments, "OO!:_restore", &type, &PyTuple_Type, &state)) return nullptr;
    const TypeInfo* info = nullptr;
    for (auto* own = reinterpret_cast<PyTypeObject*>(type); PyType_Check(type) && own && !info;
         own = own->tp_base)
      info = info_of_type(own);
    if (!info || (!info->restore && !info->make)) throw WrongType{"there is nothing to restore of this type"};
    auto* made = reinterpret_cast<PyTypeObject*>(type);
    if (info->restore) return as_type(new_instance(*info, info->restore(state)), made);
    if (PyTuple_GET_SIZE(state) != static_cast<Py_ssize_t>(info->fields.size()))
      throw WrongType{"a " + short_name(*info) +
                      " has another number of fields: it was pickled by another version"};
    auto value = info->make();
    for (std::size_t i = 0; i < info->fields.size(); ++i) {
      PyObject* part = PyTuple_GET_ITEM(state, static_cast<Py_ssize_t>(i));
      const Field& field = info->fields[i];
      if (!(part == Py_None && !field.converter->column))
        field.converter->from(static_cast<char*>(value.get()) + field.offset, part, {nullptr, field.name});
    }
    return as_type(new_instance(*info, std::move(value)), made);
  } catch (...) {
    return raise_current();
  }
}

namespace {

PyObject* copy(PyObject* self, PyObject*) {
  const TypeInfo& info = info_of(self);
  if (!info.machine) return Py_NewRef(self);  // immutable
  if (!info.copy) {
    PyErr_Format(PyExc_TypeError, "a %s cannot be copied", short_name(info).c_str());
    return nullptr;
  }
  try {
    const Hold hold(self);
    return new_instance(info, info.copy(own_value(self)));
  } catch (...) {
    return raise_current();
  }
}

PyObject* deep_copy(PyObject* self, PyObject*) { return copy(self, nullptr); }

void set_fields(const TypeInfo& info, void* value, PyObject* named, std::vector<bool>& set) {
  PyObject *key = nullptr, *given = nullptr;
  Py_ssize_t at = 0;
  while (named && PyDict_Next(named, &at, &key, &given)) {
    const char* name = PyUnicode_AsUTF8(key);
    if (!name) throw py::error_already_set();
    std::size_t i = 0;
    while (i < info.fields.size() && std::strcmp(info.fields[i].name, name) != 0) ++i;
    if (i == info.fields.size()) {
      std::string known;
      for (const Field& field : info.fields) known += (known.empty() ? "" : ", ") + std::string(field.name);
      throw WrongType{short_name(info) + " has no field '" + name + "'; it has " + known};
    }
    const Field& field = info.fields[i];
    field.converter->from(static_cast<char*>(value) + field.offset, given, {nullptr, field.name});
    set[i] = true;
  }
}

}  // namespace

std::string makers_text(PyTypeObject* type) {
  // What is static in these types makes one.
  std::string text;
  for (; type && text.empty(); type = type->tp_base) {
    const std::string_view whole = type->tp_name;
    const std::string own(whole.substr(whole.rfind('.') + 1));
    PyObject *name = nullptr, *value = nullptr;
    for (Py_ssize_t at = 0; type->tp_dict && PyDict_Next(type->tp_dict, &at, &name, &value);)
      if (PyObject_TypeCheck(value, &PyStaticMethod_Type) && PyUnicode_Check(name) &&
          PyUnicode_READ_CHAR(name, 0) != '_') {
        if (const char* its = PyUnicode_AsUTF8(name))
          text += ", " + own + "." + its + "()";
        else
          PyErr_Clear();
      }
  }
  return text;
}

PyObject* construct_record(const TypeInfo& info, PyTypeObject* type, PyObject* arguments,
                           PyObject* named) noexcept {
  try {
    if (!info.make)
      throw WrongType{short_name(info) + " has no value to begin with and is made in C++ alone"};
    auto value = info.make();
    std::vector<bool> set(info.fields.size());
    const Py_ssize_t n = PyTuple_GET_SIZE(arguments);
    if (n > static_cast<Py_ssize_t>(info.fields.size()))
      throw WrongType{short_name(info) + " has " + std::to_string(info.fields.size()) + " fields, got " +
                      std::to_string(n) + " values"};
    for (Py_ssize_t i = 0; i < n; ++i) {
      const Field& field = info.fields[static_cast<std::size_t>(i)];
      if (named && PyDict_GetItemString(named, field.name))
        throw WrongType{short_name(info) + "() got '" + field.name + "' twice"};
      field.converter->from(static_cast<char*>(value.get()) + field.offset, PyTuple_GET_ITEM(arguments, i),
                            {nullptr, field.name});
      set[static_cast<std::size_t>(i)] = true;
    }
    set_fields(info, value.get(), named, set);
    for (std::size_t i = 0; i < set.size(); ++i)
      if (info.fields[i].required && !set[i])
        throw WrongType{short_name(info) + "() needs '" + info.fields[i].name + "'"};
    return as_type(new_instance(info, std::move(value)), type);
  } catch (...) {
    return raise_current();
  }
}

namespace {

PyObject* replace(PyObject* self, PyObject* arguments, PyObject* named) {
  const TypeInfo& info = info_of(self);
  try {
    if (info.fields.empty() || !info.copy)
      throw WrongType{"a " + short_name(info) + " has no fields to replace"};
    if (PyTuple_GET_SIZE(arguments) != 0) throw WrongType{"replace() takes names: replace(field=value)"};
    std::shared_ptr<void> value;
    {
      const Hold hold(self);  // not while Python makes numbers of what it was given
      value = info.copy(own_value(self));
    }
    std::vector<bool> set(info.fields.size());
    set_fields(info, value.get(), named, set);
    return new_instance(info, std::move(value));
  } catch (...) {
    return raise_current();
  }
}

PyObject* display(PyObject* self, PyObject*) {
  try {
    return py::module_::import("vericone.display").attr("html")(py::handle(self)).release().ptr();
  } catch (...) {
    return raise_current();
  }
}

PyMethodDef base_methods[] = {
    {"__reduce__", reduce, METH_NOARGS, "For pickle."},
    {"__copy__", copy, METH_NOARGS, "Itself, where it never changes."},
    {"__deepcopy__", deep_copy, METH_O, "Itself, where it never changes."},
    {"_repr_html_", display, METH_NOARGS, "What Jupyter shows; None where there is nothing to see."},
    {nullptr, nullptr, 0, nullptr}};
PyMethodDef record_methods[] = {
    {"replace", reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(&replace)),
     METH_VARARGS | METH_KEYWORDS,
     "replace($self, /, **fields)\n--\n\nAnother record, with these fields changed."},
    {nullptr, nullptr, 0, nullptr}};
PyMethodDef no_methods[] = {{nullptr, nullptr, 0, nullptr}};

PyObject* cannot_make(PyTypeObject* type, PyObject*, PyObject*) {
  const std::string makers = makers_text(type);
  const std::string how = makers.empty() ? "functions return it" : "use " + makers.substr(2);
  PyErr_Format(PyExc_TypeError, "a %s is not made by itself: %s", type->tp_name, how.c_str());
  return nullptr;
}

PyMemberDef base_members[] = {
    {"__weaklistoffset__", T_PYSSIZET, offsetof(Instance, weak_references), READONLY, nullptr},
    {nullptr, 0, 0, 0, nullptr}};

}  // namespace

PyTypeObject* make_base_type() {
  PyType_Slot slots[] = {{Py_tp_dealloc, reinterpret_cast<void*>(&destroy)},
                         {Py_tp_repr, reinterpret_cast<void*>(&represent)},
                         {Py_tp_richcompare, reinterpret_cast<void*>(&compare)},
                         {Py_tp_hash, reinterpret_cast<void*>(&PyObject_HashNotImplemented)},
                         {Py_tp_methods, base_methods},
                         {Py_tp_members, base_members},
                         {Py_tp_new, reinterpret_cast<void*>(&cannot_make)},
                         {Py_tp_doc, const_cast<char*>("A value or an object of the C++ library.")},
                         {0, nullptr}};
  PyType_Spec spec{"vericone._core._Object", sizeof(Instance), 0, Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE,
                   slots};
  auto* type = reinterpret_cast<PyTypeObject*>(PyType_FromSpec(&spec));
  if (!type) throw py::error_already_set();
  return type;
}

std::string Place::text() const {
  std::string text = outer ? outer->text() : "";
  if (name) return text.empty() ? name : text + "." + name;
  return text + "[" + std::to_string(index) + "]";
}

void wrong_type(const Place& place, const char* wanted, PyObject* given) {
  throw WrongType{place.text() + ": got " + std::string(Py_TYPE(given)->tp_name) + ", must be " + wanted};
}

namespace {

[[noreturn]] void wait_for_ever() {
  while (true) std::this_thread::sleep_for(std::chrono::hours(1));
}

}  // namespace

// Where Python ends, it ends whoever asks for the lock, by unwinding the stack: these catch that.
void take_back(PyThreadState* state) noexcept {
  try {
    PyEval_RestoreThread(state);
  } catch (...) {
    wait_for_ever();
  }
}

PyGILState_STATE take_lock() noexcept {
  try {
    return PyGILState_Ensure();
  } catch (...) {
    wait_for_ever();
  }
}

PyObject* keeping(PyObject* made, PyObject* other) {
  auto* instance = reinterpret_cast<Instance*>(made);
  Py_XSETREF(instance->kept, Py_NewRef(other));
  return made;
}

std::shared_ptr<void> own(void* object, void (*destroy)(void*)) { return {object, destroy}; }

void throw_raised() { throw py::error_already_set(); }

bool is_object(PyObject* object) { return PyObject_TypeCheck(object, shared().base); }

bool is_instance(PyObject* object, const TypeInfo& info) {
  if (!is_object(object)) return false;
  for (const TypeInfo* own = &info_of(object); own; own = own->base)
    if (own == &info) return true;
  return false;
}

void* value_of(PyObject* object, const TypeInfo& info) {
  void* value = own_value(object);
  for (const TypeInfo* own = &info_of(object); own != &info; own = own->base) value = own->to_base(value);
  return value;
}

namespace {

std::recursive_mutex* lock_of(PyObject* object) {
  return is_object(object) ? reinterpret_cast<Instance*>(object)->lock.get() : nullptr;
}

}  // namespace

Hold::Hold(PyObject* object) : lock_(lock_of(object)) {
  if (!lock_ || lock_->try_lock()) return;
  const Released quiet;  // who has it may be waiting for the global lock
  lock_->lock();
}

Hold::~Hold() {
  if (lock_) lock_->unlock();
}

void Machines::add(PyObject* object) {
  std::recursive_mutex* const lock = lock_of(object);
  if (!lock) return;
  // The same order for all threads: none waits for another in a circle.
  const auto at = std::lower_bound(locks_.begin(), locks_.end(), lock, std::less<>());
  if (at == locks_.end() || *at != lock) locks_.insert(at, lock);
}

void Machines::lock() {
  for (std::recursive_mutex* lock : locks_) lock->lock();
}

void Machines::unlock() {
  for (std::recursive_mutex* lock : locks_) lock->unlock();
}

std::shared_ptr<void> shared_of(PyObject* object, const TypeInfo& info) {
  return {reinterpret_cast<Instance*>(object)->value, value_of(object, info)};
}

PyObject* new_instance(const TypeInfo& info, std::shared_ptr<void> value) {
  if (!info.type) throw WrongType{"there is no Python type for what C++ returned here"};
  PyObject* self = info.type->tp_alloc(info.type, 0);
  if (!self) throw py::error_already_set();
  auto* instance = reinterpret_cast<Instance*>(self);
  new (&instance->value) std::shared_ptr<void>(std::move(value));
  new (&instance->lock) std::unique_ptr<std::recursive_mutex>;
  new (&instance->made) std::vector<std::shared_ptr<void>>;
  if (info.machine) instance->lock = std::make_unique<std::recursive_mutex>();
  instance->info = &info;
  return self;
}

PyObject* as_type(PyObject* made, PyTypeObject* type) {
  if (type == Py_TYPE(made)) return made;
  const auto plain = py::reinterpret_steal<py::object>(made);
  PyObject* self = type->tp_alloc(type, 0);
  if (!self) throw py::error_already_set();
  auto *to = reinterpret_cast<Instance*>(self), *from = reinterpret_cast<Instance*>(made);
  new (&to->value) std::shared_ptr<void>(std::move(from->value));
  new (&to->lock) std::unique_ptr<std::recursive_mutex>(std::move(from->lock));
  new (&to->made) std::vector<std::shared_ptr<void>>(std::move(from->made));
  to->kept = std::exchange(from->kept, nullptr);
  to->info = from->info;
  return self;
}

void add_type(TypeInfo& info, const char* doc, PyMethodDef* methods, newfunc construct) {
  std::vector<PyGetSetDef>& fields = getters.emplace_back();
  for (Field& field : info.fields) fields.push_back({field.name, get_field, nullptr, field.doc, &field});
  fields.push_back({});
  PyType_Slot slots[] = {{Py_tp_new, reinterpret_cast<void*>(construct ? construct : &cannot_make)},
                         {Py_tp_doc, const_cast<char*>(doc)},
                         {Py_tp_getset, fields.data()},
                         {Py_tp_methods, methods               ? methods
                                         : info.fields.empty() ? no_methods
                                                               : record_methods},
                         {0, nullptr}};
  const char* name = keep("vericone." + std::string(info.name));
  PyType_Spec spec{name, 0, 0, static_cast<unsigned>(Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE), slots};
  const py::object bases =
      py::make_tuple(py::handle(reinterpret_cast<PyObject*>(info.base ? info.base->type : shared().base)));
  info.type = reinterpret_cast<PyTypeObject*>(PyType_FromSpecWithBases(&spec, bases.ptr()));
  if (!info.type) throw py::error_already_set();
  const py::handle type(reinterpret_cast<PyObject*>(info.type));
  if (!info.fields.empty() && methods)
    for (PyMethodDef* method = record_methods; method->ml_name; ++method) {
      const auto bound = py::reinterpret_steal<py::object>(PyDescr_NewMethod(info.type, method));
      type.attr(method->ml_name) = bound;
    }
  put(info.name, py::reinterpret_borrow<py::object>(type));
}

}  // namespace vericone::python
