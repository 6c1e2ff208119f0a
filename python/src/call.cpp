// SPDX-License-Identifier: BSD-3-Clause
#include "call.h"

#include "module.h"

#include <unistd.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

namespace vericone::python {
namespace {

PyObject* input_error_type() {
  static constinit Imported type("vericone._errors", "InputError");
  return type.get().ptr();  // kept for ever
}

std::string signature_text(std::span<const Parameter> parameters) {
  std::string text = "(";
  bool star = false;
  for (const Parameter& p : parameters) {
    text += text.size() > 1 ? ", " : "";
    if (p.keyword_only && !star) {
      text += "*, ";
      star = true;
    }
    text += std::string(p.name) + (p.optional ? "=..." : "");
  }
  for (const Parameter& p : parameters)
    if (p.options) text += std::string(", or fields of ") + p.options()->name;
  return text + ")";
}

// Long work ------------------------------------------------------------------------------------------------

bool in_main_thread() {
  static constinit Imported get_ident("threading", "get_ident"), main_thread("threading", "main_thread");
  return get_ident.get()().equal(main_thread.get()().attr("ident"));
}

/// How long a call that was asked to end is waited for.
constexpr auto kPatience = std::chrono::milliseconds(200);

/// A call in a thread of its own. All that it needs is here, so that it may be left to itself.
struct Aside {
  Given given;
  Stop stop;
  PyObject* answer = nullptr;
  std::exception_ptr thrown;
  std::mutex mutex;
  std::condition_variable condition;
  bool ended = false, left = false;

  Aside() = default;
  ~Aside() { Py_XDECREF(answer); }  // where nobody takes it; the global lock is held
  Aside(const Aside&) = delete;
  Aside& operator=(const Aside&) = delete;
};

/// Waits for it when Python ends: until then its steps and what it holds are there.
void leave(std::thread worker) {
  static auto& left = *new std::vector<std::thread>;
  static const pid_t process = [] {
    py::module_::import("atexit").attr("register")(py::cpp_function([] {
      const Released quiet;
      if (getpid() != process) return;  // a fork has none of these threads
      for (std::thread& one : left) one.join();
      left.clear();
    }));
    return getpid();
  }();
  left.push_back(std::move(worker));
}

/// The call runs in a thread beside the main one, which waits for it and for signals. What a signal raises is
/// thrown here once the call has heard of it and ended, or after kPatience: a step of another library that
/// hears nothing goes on without us, and what it returns is dropped.
PyObject* call_aside(const Overload& overload, Given& given) {
  auto aside = std::make_shared<Aside>();
  given.keep();
  aside->given = std::move(given);
  std::thread worker([call = overload.call, aside]() mutable {
    const py::gil_scoped_acquire hold;
    try {
      const StopScope heard(&aside->stop);
      aside->answer = call(aside->given);
      if (!aside->answer) throw py::error_already_set();
    } catch (...) {
      aside->thrown = std::current_exception();
    }
    {
      const std::lock_guard lock(aside->mutex);
      aside->ended = true;
      if (aside->left) --shared().left_behind;
    }
    aside->condition.notify_all();
    aside.reset();  // here: the global lock is held
  });
  std::optional<py::error_already_set> raised;
  std::chrono::steady_clock::time_point late;
  bool ended = false;
  while (true) {
    {
      const Released quiet;
      std::unique_lock lock(aside->mutex);
      ended = aside->condition.wait_for(lock, kBetweenSignals, [&] { return aside->ended; });
    }
    if (ended || (raised && std::chrono::steady_clock::now() > late)) break;
    if (!raised && PyErr_CheckSignals() != 0) {
      raised.emplace();
      aside->stop.request();
      late = std::chrono::steady_clock::now() + kPatience;
    }
  }
  {
    const std::lock_guard lock(aside->mutex);
    ended = aside->ended;
    aside->left = !ended;
    shared().left_behind += !ended;
  }
  if (ended) {
    const Released quiet;
    worker.join();
  } else {
    leave(std::move(worker));
  }
  if (raised) throw std::move(*raised);
  given = std::move(aside->given);
  if (aside->thrown) std::rethrow_exception(aside->thrown);
  return std::exchange(aside->answer, nullptr);
}

PyObject* dispatch(const char* name, std::span<const Overload> overloads, PyObject* self,
                   PyObject* const* positional, Py_ssize_t n, PyObject* names, PyObject* const* named,
                   PyTypeObject* type = nullptr) noexcept {
  try {
    std::string why, last;  // of the overload that most arguments fit
    std::size_t most = 0;
    const auto refuse = [&](std::size_t fitting, const std::string& message) {
      if (last.empty() || fitting >= most) last = message;
      most = std::max(most, fitting);
    };
    std::optional<InputError> unfit;
    for (const Overload& overload : overloads) {
      Given given;
      given.self = self;
      std::size_t fitting = 0;
      if (!given.bind(overload.parameters, positional, n, names, named, why, fitting)) {
        refuse(fitting, why);
        continue;
      }
      try {
        const bool lasts =
            overload.work == Work::lasts || (overload.work == Work::grows && given.long_lists());
        PyObject* answer = lasts && in_main_thread() ? call_aside(overload, given) : overload.call(given);
        if (!answer && !PyErr_Occurred()) throw WrongType{"no answer"};
        shared().answered = static_cast<int>(&overload - overloads.data());
        if (answer && type) reinterpret_cast<Instance*>(answer)->made = std::move(given.made());
        return answer;
      } catch (const WrongType& wrong) {
        if (overloads.size() == 1) throw;
        refuse(overload.parameters.size() + 1, wrong.message);
      } catch (const Unfit& wrong) {
        if (overloads.size() == 1) throw;
        if (!unfit || unfit->field() != wrong.field())
          unfit.emplace(wrong);
        else if (unfit->requirement().find(wrong.requirement()) == std::string::npos)
          unfit.emplace(wrong.field(), wrong.value(), unfit->requirement() + " or " + wrong.requirement());
      }
    }
    if (unfit) throw InputError(*unfit);
    std::string message = std::string(name) + "(): " + last;
    if (overloads.size() > 1) {
      std::vector<std::string> known;  // some differ by types alone
      for (const Overload& overload : overloads) {
        std::string text = name + signature_text(overload.parameters);
        if (std::find(known.begin(), known.end(), text) == known.end()) known.push_back(std::move(text));
      }
      message = std::string(name) + "(): these arguments fit none of";
      for (const std::string& text : known) message += (&text == known.data() ? " " : "; ") + text;
      message += "; the nearest: " + last;
    }
    const std::string makers = type ? makers_text(type) : "";
    if (!makers.empty()) message += "; or use " + makers.substr(2);
    throw WrongType{message};
  } catch (...) {
    return raise_current();
  }
}

}  // namespace

// Arguments ------------------------------------------------------------------------------------------------

int Given::options_with(const char* name) const {
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    if (parameters_[i].options)
      for (const Field& field : parameters_[i].options()->fields)
        if (std::strcmp(field.name, name) == 0) return static_cast<int>(i);
  return -1;
}

bool Given::bind(std::span<const Parameter> parameters, PyObject* const* positional, Py_ssize_t n,
                 PyObject* names, PyObject* const* named, std::string& why, std::size_t& fitting) {
  parameters_ = parameters;
  Py_ssize_t most = 0;
  for (const Parameter& p : parameters) most += !p.keyword_only;
  if (n > most) {
    why = "takes at most " + std::to_string(most) + " positional arguments, got " + std::to_string(n);
    return false;
  }
  for (Py_ssize_t i = 0; i < n; ++i) values_[i] = positional[i];
  int options = -1;  // whose fields are given by name
  py::object fields;
  const Py_ssize_t count = names ? PyTuple_GET_SIZE(names) : 0;
  for (Py_ssize_t k = 0; k < count; ++k) {
    const char* name = PyUnicode_AsUTF8(PyTuple_GET_ITEM(names, k));
    if (!name) throw py::error_already_set();
    std::size_t i = 0;
    while (i < parameters.size() && std::strcmp(parameters[i].name, name) != 0) ++i;
    if (const int with = i == parameters.size() ? options_with(name) : -1; with >= 0) {
      options = with;
      if (!fields) fields = py::dict();
      fields[name] = py::handle(named[k]);
      continue;
    }
    if (i == parameters.size() || values_[i]) {
      why = i == parameters.size()
                ? "has no parameter '" + std::string(name) + "'; it is " + signature_text(parameters)
                : "got '" + std::string(name) + "' twice";
      return false;
    }
    values_[i] = named[k];
  }
  if (options >= 0) {
    const Parameter& p = parameters[static_cast<std::size_t>(options)];
    if (values_[options]) {
      why = "got both '" + std::string(p.name) + "' and fields of it";
      return false;
    }
    const py::tuple none;
    PyObject* made = construct_record(*p.options(), p.options()->type, none.ptr(), fields.ptr());
    if (!made) throw py::error_already_set();
    kept_.emplace_back(made);
    values_[options] = made;
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& p = parameters[i];
    if (!values_[i] && !p.optional) {
      why = "'" + std::string(p.name) + "' is missing; it is " + signature_text(parameters);
      return false;
    }
    if (values_[i] && p.could && !p.could(values_[i])) {
      why = std::string(p.name) + ": got " + std::string(Py_TYPE(values_[i])->tp_name) +
            ", which it does not take";
      return false;
    }
    ++fitting;
  }
  return true;
}

void* Given::object(int i, const TypeInfo& info) {
  std::shared_ptr<void> made;
  void* value = object_from(this->value(i), info, made, place(i));
  if (made)
    made_.push_back(std::move(made));
  else
    machines.add(this->value(i));
  return value;
}

bool Given::long_lists() const {
  constexpr Py_ssize_t kLong = 500;  // a cubic algorithm takes a tenth of a second then
  for (PyObject* value : values_) {
    if (!value || !(is_sequence(value) || PyUnicode_Check(value))) continue;
    const Py_ssize_t n = PyObject_Size(value);
    if (n < 0) PyErr_Clear();
    if (n > kLong) return true;
  }
  return false;
}

void Given::keep() {
  if (self) kept_.push_back(Reference::to(self));
  for (PyObject* value : values_)
    if (value) kept_.push_back(Reference::to(value));
}

int Given::threads(int i) const {
  if (!has(i)) return 1;
  const auto n = static_cast<int>(integer_from(values_[i], 0, 1024, place(i)));
  return n > 0 ? n : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

PyObject* call(const char* name, std::span<const Overload> overloads, PyObject* self,
               PyObject* const* arguments, Py_ssize_t n, PyObject* names) noexcept {
  return dispatch(name, overloads, self, arguments, n, names, arguments + n);
}

PyObject* call_many(const char* name, std::span<const Overload> overloads, PyObject* const* arguments,
                    Py_ssize_t n, PyObject* names) noexcept {
  if (n < 1) {
    PyErr_Format(PyExc_TypeError, "%s(): the objects are missing", name);
    return nullptr;
  }
  return dispatch(name, overloads, arguments[0], arguments + 1, n - 1, names, arguments + n);
}

PyObject* construct(const char* name, std::span<const Overload> overloads, PyTypeObject* type,
                    PyObject* arguments, PyObject* named) noexcept {
  std::vector<PyObject*> values;
  py::object names;
  try {
    if (named) {
      py::tuple keys(static_cast<std::size_t>(PyDict_Size(named)));
      PyObject *key = nullptr, *value = nullptr;
      Py_ssize_t at = 0, i = 0;
      while (PyDict_Next(named, &at, &key, &value)) {
        PyTuple_SET_ITEM(keys.ptr(), i++, Py_NewRef(key));
        values.push_back(value);
      }
      names = keys;
    }
  } catch (...) {
    return raise_current();
  }
  PyObject* made = dispatch(name, overloads, nullptr, PySequence_Fast_ITEMS(arguments),
                            PyTuple_GET_SIZE(arguments), names.ptr(), values.data(), type);
  if (!made) return nullptr;
  try {
    // Some classes refer to objects that they were made of. Arrays are copied.
    py::list kept;
    const auto keep = [&](PyObject* given) {
      if (!py::isinstance<py::array>(given)) kept.append(py::handle(given));
    };
    for (Py_ssize_t i = 0; i < PyTuple_GET_SIZE(arguments); ++i) keep(PyTuple_GET_ITEM(arguments, i));
    for (PyObject* value : values) keep(value);
    return as_type(keeping(made, kept.ptr()), type);
  } catch (...) {
    return raise_current();
  }
}

// Errors ---------------------------------------------------------------------------------------------------

namespace {

/// What a user gave need not be UTF-8.
py::object any_text(const std::string& text) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "backslashreplace"));
}

}  // namespace

PyObject* raise_current(const std::string& at) noexcept {
  try {
    try {
      throw;
    } catch (py::error_already_set& error) {
      error.restore();
    } catch (const WrongType& wrong) {
      PyErr_SetString(PyExc_TypeError, (at + wrong.message).c_str());
    } catch (const InputError& error) {
      const py::object type = py::reinterpret_borrow<py::object>(input_error_type());
      // Of a file the field says where in it; nowhere is the whole of it.
      const py::object made = type(any_text(error.field().empty() ? "path" : error.field()),
                                   any_text(error.value()), any_text(error.requirement()));
      PyErr_SetObject(type.ptr(), made.ptr());
    } catch (const std::bad_alloc&) {
      PyErr_NoMemory();
    } catch (const std::system_error& error) {
      // OSError itself chooses PermissionError and its like by the number.
      const bool known = error.code().category() == std::generic_category() ||
                         error.code().category() == std::system_category();
      const std::string reason = ": " + error.code().message();
      std::string text = error.what();
      if (known && text.ends_with(reason)) text.resize(text.size() - reason.size());
      const auto type = py::reinterpret_borrow<py::object>(PyExc_OSError);
      const py::object made =
          known ? type(error.code().value(), any_text(text)) : type(any_text(error.what()));
      PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(made.ptr())), made.ptr());
    } catch (const std::exception& error) {
      PyErr_SetObject(PyExc_RuntimeError, any_text(error.what()).ptr());
    } catch (const Interrupted&) {
      if (PyErr_CheckSignals() == 0) PyErr_SetString(PyExc_KeyboardInterrupt, "stopped by a callback");
    }
  } catch (...) {
    if (!PyErr_Occurred()) PyErr_SetString(PyExc_RuntimeError, "an error in C++ that has no text");
  }
  return nullptr;
}

// The global lock ------------------------------------------------------------------------------------------

Quiet::Quiet(Machines& machines) : machines_(machines), state_(PyEval_SaveThread()) { machines_.lock(); }

Quiet::~Quiet() {
  machines_.unlock();
  take_back(state_);
}

PyObject* tuple_of(std::initializer_list<PyObject*> parts) {
  py::tuple all(parts.size());
  Py_ssize_t i = 0;
  bool whole = true;
  for (PyObject* part : parts) {
    whole = whole && part;
    PyTuple_SET_ITEM(all.ptr(), i++, part);
  }
  if (!whole) throw py::error_already_set();
  return all.release().ptr();
}

}  // namespace vericone::python
