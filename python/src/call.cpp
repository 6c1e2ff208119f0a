// SPDX-License-Identifier: BSD-3-Clause
#include "call.h"

#include <vericone/geometry/error.h>
#include <vericone/geometry/stop.h>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <new>
#include <system_error>
#include <thread>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace vericone::python {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kBetweenSignals = std::chrono::milliseconds(25);

PyObject* input_error_type() {
  static const py::object& type = *new py::object(py::module_::import("vericone._errors").attr("InputError"));
  return type.ptr();
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
  return text + ")";
}

PyObject* dispatch(const char* name, std::span<const Overload> overloads, PyObject* self,
                   PyObject* const* positional, Py_ssize_t n, PyObject* names, PyObject* const* named,
                   bool keep = false) noexcept {
  try {
    std::string why, last;
    for (const Overload& overload : overloads) {
      Given given;
      given.self = self;
      if (!given.bind(overload.parameters, positional, n, names, named, why)) {
        last = why;
        continue;
      }
      try {
        PyObject* answer = overload.call(given);
        if (!answer && !PyErr_Occurred()) throw WrongType{"no answer"};
        if (answer && keep) reinterpret_cast<Instance*>(answer)->made = std::move(given.made());
        return answer;
      } catch (const WrongType& wrong) {
        if (overloads.size() == 1) throw;
        last = wrong.message;
      }
    }
    std::string message = std::string(name) + "(): " + last;
    if (overloads.size() > 1) {
      message = std::string(name) + "(): these arguments fit none of";
      for (const Overload& overload : overloads)
        message += std::string(&overload == overloads.data() ? " " : "; ") + name +
                   signature_text(overload.parameters);
      message += "; the last: " + last;
    }
    throw WrongType{message};
  } catch (...) {
    return raise_current();
  }
}

}  // namespace

// Arguments ------------------------------------------------------------------------------------------------

bool Given::bind(std::span<const Parameter> parameters, PyObject* const* positional, Py_ssize_t n,
                 PyObject* names, PyObject* const* named, std::string& why) {
  parameters_ = parameters;
  Py_ssize_t most = 0;
  for (const Parameter& p : parameters) most += !p.keyword_only;
  if (n > most) {
    why = "takes at most " + std::to_string(most) + " positional arguments, got " + std::to_string(n);
    return false;
  }
  for (Py_ssize_t i = 0; i < n; ++i) values_[i] = positional[i];
  const Py_ssize_t count = names ? PyTuple_GET_SIZE(names) : 0;
  for (Py_ssize_t k = 0; k < count; ++k) {
    const char* name = PyUnicode_AsUTF8(PyTuple_GET_ITEM(names, k));
    if (!name) throw py::error_already_set();
    std::size_t i = 0;
    while (i < parameters.size() && std::strcmp(parameters[i].name, name) != 0) ++i;
    if (i == parameters.size() || values_[i]) {
      why = i == parameters.size()
                ? "has no parameter '" + std::string(name) + "'; it is " + signature_text(parameters)
                : "got '" + std::string(name) + "' twice";
      return false;
    }
    values_[i] = named[k];
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
  }
  return true;
}

void* Given::object(int i, const TypeInfo& info) {
  std::shared_ptr<void> made;
  void* value = object_from(this->value(i), info, made, place(i));
  if (made) made_.push_back(std::move(made));
  return value;
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

PyObject* construct(const char* name, std::span<const Overload> overloads, PyTypeObject*, PyObject* arguments,
                    PyObject* named) noexcept {
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
                            PyTuple_GET_SIZE(arguments), names.ptr(), values.data(), true);
  // Some classes refer to what they were made of.
  if (made) reinterpret_cast<Instance*>(made)->kept = PyTuple_Pack(2, arguments, named ? named : Py_None);
  return made;
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
      PyErr_SetString(PyExc_OSError, error.what());
    } catch (const std::exception& error) {
      PyErr_SetString(PyExc_RuntimeError, error.what());
    } catch (const Interrupted&) {
      if (PyErr_CheckSignals() == 0) PyErr_SetString(PyExc_KeyboardInterrupt, "stopped by a callback");
    }
  } catch (...) {
    if (!PyErr_Occurred()) PyErr_SetString(PyExc_RuntimeError, "an error in C++ that has no text");
  }
  return nullptr;
}

// The global lock ------------------------------------------------------------------------------------------

Quiet::Quiet(PyObject* self) : state_(nullptr) {
  if (self && is_object(self)) lock_ = reinterpret_cast<Instance*>(self)->lock.get();
  state_ = PyEval_SaveThread();
  if (lock_) lock_->lock();
}

Quiet::~Quiet() {
  if (lock_) lock_->unlock();
  PyEval_RestoreThread(state_);
}

namespace {

bool in_main_thread() {
  static const py::object& threading = *new py::object(py::module_::import("threading"));
  return threading.attr("get_ident")().equal(threading.attr("main_thread")().attr("ident"));
}

/// Waits until `done`, and looks for signals meanwhile; the global lock is held when it is called and after.
/// What a signal raises is returned.
std::optional<py::error_already_set> wait_for(std::condition_variable& condition, std::mutex& mutex,
                                              const bool& done, Stop& stop) {
  std::optional<py::error_already_set> raised;
  while (true) {
    bool ended = false;
    {
      const py::gil_scoped_release quiet;
      std::unique_lock lock(mutex);
      ended = condition.wait_for(lock, kBetweenSignals, [&] { return done; });
    }
    if (ended) return raised;
    if (!raised && PyErr_CheckSignals() != 0) {
      raised.emplace();
      stop.request();
    }
  }
}

}  // namespace

void run_interruptibly(PyObject* self, const std::function<void()>& work) {
  if (!in_main_thread()) {
    const Quiet quiet(self);
    return work();
  }
  Stop stop;
  std::exception_ptr thrown;
  std::mutex mutex;
  std::condition_variable condition;
  bool done = false;
  std::recursive_mutex* machine =
      self && is_object(self) ? reinterpret_cast<Instance*>(self)->lock.get() : nullptr;
  std::thread worker([&] {
    try {
      const StopScope heard(&stop);
      std::unique_lock<std::recursive_mutex> hold;
      if (machine) hold = std::unique_lock(*machine);
      work();
    } catch (...) {
      thrown = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    done = true;
    condition.notify_all();
  });
  auto raised = wait_for(condition, mutex, done, stop);
  {
    const py::gil_scoped_release quiet;
    worker.join();
  }
  if (raised) {
    thrown = nullptr;
    throw std::move(*raised);
  }
  if (thrown) std::rethrow_exception(thrown);
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

// Many -----------------------------------------------------------------------------------------------------

Many::Many(const Given& given, int i, int components)
    : name_(given.place(i).name), components_(std::max(components, 1)), scalar_(components == 0) {
  PyObject* value = given.value(i);
  const Place place = given.place(i);
  if (scalar_ && !is_sequence(value)) {
    numbers_[0] = number_from(value, place);
    one_ = numbers_;
    return;
  }
  if (!scalar_ && py::detail::npy_api::get().PyArray_Check_(value)
          ? py::detail::array_proxy(value)->nd == 1
          : (PyList_Check(value) || PyTuple_Check(value)) && PySequence_Fast_GET_SIZE(value) == components_ &&
                !scalar_ && !is_sequence(PySequence_Fast_GET_ITEM(value, 0))) {
    fixed_from(value, components_, 1, numbers_, place);
    one_ = numbers_;
    return;
  }
  read_numbers(value, place);
}

void Many::read_numbers(PyObject* given, const Place& place) {
  const std::string wanted = scalar_ ? "a number or an array of real numbers"
                                     : "of shape (" + std::to_string(components_) + ",) or (..., " +
                                           std::to_string(components_) + ")";
  if (!py::detail::npy_api::get().PyArray_Check_(given)) {
    if (!is_sequence(given) && !PyObject_HasAttrString(given, "__array__"))
      wrong_type(place, ("an array " + wanted).c_str(), given);
    array_ = strict_array(given, place);
  } else {
    array_ = py::reinterpret_borrow<py::object>(given);
  }
  auto array = py::reinterpret_borrow<py::array>(array_);
  const char kind = array.dtype().kind();
  if ((kind != 'f' && kind != 'i' && kind != 'u') || (kind == 'f' && array.itemsize() > 8))
    throw InputError(place.text(), "an array of " + std::string(py::str(array.dtype())),
                     "an array of real numbers that doubles hold exactly");
  const auto dimensions = static_cast<std::size_t>(array.ndim());
  if (!scalar_ && (dimensions == 0 || array.shape(array.ndim() - 1) != components_)) {
    std::string own = "(";
    for (std::size_t d = 0; d < dimensions; ++d)
      own += std::to_string(array.shape(static_cast<Py_ssize_t>(d))) +
             (d + 1 < dimensions || d == 0 ? ", " : "");
    if (dimensions > 1 || own.ends_with(", "))
      own = own.ends_with(", ") ? own.substr(0, own.size() - 1) : own;
    throw InputError(place.text(), "an array of shape " + own + ")", wanted);
  }
  // Halves, and numbers of another byte order, become doubles first: rare, and exact.
  const py::dtype type = array.dtype();
  if (type.byteorder() == '>' || (kind == 'f' && array.itemsize() == 2) ||
      !(array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_)) {
    array_ = py::module_::import("numpy").attr("ascontiguousarray")(
        array, kind == 'f' ? py::dtype("f8") : py::dtype(kind == 'i' ? "i8" : "u8"));
    array = py::reinterpret_borrow<py::array>(array_);
  }
  kind_ = kind == 'f'   ? (array.itemsize() == 8 ? 'd' : 'f')
          : kind == 'i' ? "bh?i???q"[array.itemsize() - 1]
                        : "BH?I???Q"[array.itemsize() - 1];
  const std::size_t leading = scalar_ ? dimensions : dimensions - 1;
  for (std::size_t d = 0; d < leading; ++d) {
    shape_.push_back(array.shape(static_cast<Py_ssize_t>(d)));
    strides_.push_back(array.strides(static_cast<Py_ssize_t>(d)));
  }
  if (!scalar_) inner_ = array.strides(array.ndim() - 1);
  data_ = static_cast<const char*>(array.data());
  single_ = false;
  if (leading == 0) {  // an array of one number
    single_ = true;
    numbers_[0] = number_from(py::object(array.attr("item")()).ptr(), place);
    one_ = numbers_;
  }
}

Many::Many(const Given& given, int i, const TypeInfo& info) : name_(given.place(i).name) {
  PyObject* value = given.value(i);
  const Place place = given.place(i);
  if (could_be(value, info)) {
    std::shared_ptr<void> made;
    one_ = object_from(value, info, made, place);
    if (made) made_.push_back(std::move(made));
    return;
  }
  py::object list;
  if (PyList_Check(value) || PyTuple_Check(value)) {
    list = py::reinterpret_steal<py::object>(PySequence_Tuple(value));  // stays as it is while others work
    shape_ = {PyTuple_GET_SIZE(list.ptr())};
    strides_ = {sizeof(void*)};
  } else if (py::detail::npy_api::get().PyArray_Check_(value) &&
             py::reinterpret_borrow<py::array>(value).dtype().kind() == 'O') {
    const auto array = py::reinterpret_borrow<py::array>(value);
    for (Py_ssize_t d = 0; d < array.ndim(); ++d) shape_.push_back(array.shape(d));
    strides_.resize(shape_.size());
    Py_ssize_t step = sizeof(void*);
    for (std::size_t d = shape_.size(); d-- > 0; step *= shape_[d]) strides_[d] = step;
    list = py::tuple(array.attr("ravel")().attr("tolist")());
  } else {
    wrong_type(place, (std::string("a vericone.") + info.name + " or a list of them").c_str(), value);
  }
  single_ = false;
  array_ = list;
  for (Py_ssize_t k = 0; k < PyTuple_GET_SIZE(list.ptr()); ++k) {
    std::shared_ptr<void> made;
    objects_.push_back(object_from(PyTuple_GET_ITEM(list.ptr(), k), info, made, {&place, nullptr, k}));
    if (made) made_.push_back(std::move(made));
  }
  data_ = reinterpret_cast<const char*>(objects_.data());
}

std::vector<Py_ssize_t> broadcast(std::span<const Many* const> many) {
  std::vector<Py_ssize_t> shape;
  for (const Many* m : many) {
    const auto& own = m->shape();
    if (own.size() > shape.size()) shape.insert(shape.begin(), own.size() - shape.size(), 1);
    for (std::size_t d = 0; d < own.size(); ++d) {
      Py_ssize_t& n = shape[shape.size() - own.size() + d];
      if (own[d] == n || own[d] == 1) continue;
      if (n != 1)
        throw InputError(
            m->name(),
            std::to_string(own[d]) + " of them along an axis where others are " + std::to_string(n),
            "of shapes that broadcast together");
      n = own[d];
    }
  }
  return shape;
}

Output make_output(const Column* column, std::span<const Py_ssize_t> shape) {
  static const py::object& empty = *new py::object(py::module_::import("numpy").attr("empty"));
  static const py::object& records = *new py::object(py::module_::import("numpy").attr("recarray"));
  py::tuple sizes(shape.size());
  for (std::size_t d = 0; d < shape.size(); ++d) sizes[d] = shape[d];
  Output output;
  if (column->record) {
    output.array = py::module_::import("numpy")
                       .attr("empty")(sizes, record_dtype(*column->record(), false))
                       .attr("view")(records);
    output.size = record_size(*column->record(), false);
  } else {
    output.array = empty(sizes, column->format());
    output.size = column->size;
  }
  output.data = static_cast<char*>(py::reinterpret_borrow<py::array>(output.array).mutable_data());
  return output;
}

PyObject* objects_of(std::span<const Py_ssize_t> shape, const std::function<PyObject*(Py_ssize_t)>& item) {
  Py_ssize_t count = 1;
  py::tuple sizes(shape.size());
  for (std::size_t d = 0; d < shape.size(); ++d) {
    sizes[d] = shape[d];
    count *= shape[d];
  }
  const py::object array = py::module_::import("numpy").attr("empty")(count, "O");
  for (Py_ssize_t i = 0; i < count; ++i) array[py::int_(i)] = py::reinterpret_steal<py::object>(item(i));
  return array.attr("reshape")(sizes).release().ptr();
}

namespace {

struct Rounded {  // an integer that no double holds
  const Many* many;
  Py_ssize_t component;
  std::string value;
};

template <class T>
double exact(const char* at, const Many& many, Py_ssize_t component) {
  T x;
  std::memcpy(&x, at, sizeof(T));
  if constexpr (std::is_integral_v<T> && sizeof(T) == 8) {
    const auto d = static_cast<double>(x);
    if (d >= 0x1p63 ? !(d < 0x1p64 && static_cast<std::uint64_t>(d) == static_cast<std::uint64_t>(x))
                    : static_cast<T>(d) != x)
      throw Rounded{&many, component, std::to_string(x)};
    return d;
  } else {
    return static_cast<double>(x);
  }
}

}  // namespace

/// Hands parts of all questions to threads.
class Walk {
 public:
  Walk(std::span<const Many* const> many, std::span<const Py_ssize_t> shape) : many_(many), shape_(shape) {
    count_ = 1;
    for (const Py_ssize_t n : shape) count_ *= n;
    steps_.resize(many.size());
    for (std::size_t k = 0; k < many.size(); ++k) {
      steps_[k].assign(shape.size(), 0);
      const auto& own = many[k]->shape_;
      for (std::size_t d = 0; d < own.size(); ++d)
        if (own[d] != 1) steps_[k][shape.size() - own.size() + d] = many[k]->strides_[d];
    }
    // Whether one step leads from each question to the next, over all of them.
    even_.resize(many.size(), true);
    single_step_.resize(many.size(), 0);
    for (std::size_t k = 0; k < many.size(); ++k) {
      std::optional<Py_ssize_t> step;
      Py_ssize_t inside = 1;
      for (std::size_t d = shape.size(); d-- > 0;) {
        if (shape[d] == 1) continue;
        if (!step) {
          step = steps_[k][d];
        } else if (steps_[k][d] != *step * inside) {
          even_[k] = false;
        }
        inside *= shape[d];
      }
      single_step_[k] = step.value_or(0);
    }
  }

  [[nodiscard]] Py_ssize_t count() const { return count_; }

  /// Where in argument k question i is.
  [[nodiscard]] const char* at(std::size_t k, Py_ssize_t i) const {
    const char* data = many_[k]->data_;
    if (even_[k]) return data + i * single_step_[k];
    for (std::size_t d = shape_.size(); d-- > 0; i /= shape_[d]) data += (i % shape_[d]) * steps_[k][d];
    return data;
  }

  /// Numbers not laid out as doubles one after the other are copied to `room`.
  void part(Py_ssize_t begin, Py_ssize_t count, std::span<std::vector<double>> room, Part& part,
            bool dense) const {
    part.count = count;
    for (std::size_t k = 0; k < many_.size(); ++k) {
      const Many& m = *many_[k];
      if (m.single_) {
        if (m.components_ > 0) {
          part.in[k] = reinterpret_cast<const char*>(m.numbers_);
        } else {
          part.in[k] = reinterpret_cast<const char*>(&m.one_);
        }
        part.step[k] = 0;
        continue;
      }
      const bool objects = m.components_ == 0;
      const bool in_place = objects || (m.kind_ == 'd' && (m.inner_ == 8 || m.components_ == 1));
      if (in_place && even_[k] && (!dense || single_step_[k] == 8 * m.components_)) {
        part.in[k] = at(k, begin);
        part.step[k] = single_step_[k];
        continue;
      }
      room[k].resize(static_cast<std::size_t>(count * std::max(m.components_, 1)));
      if (objects) {
        for (Py_ssize_t i = 0; i < count; ++i)
          std::memcpy(&room[k][static_cast<std::size_t>(i)], at(k, begin + i), sizeof(void*));
      } else {
        copy_numbers(k, begin, count, room[k].data());
      }
      part.in[k] = reinterpret_cast<const char*>(room[k].data());
      part.step[k] = 8 * std::max(m.components_, 1);
    }
  }

  /// "[5][2]" of question i.
  [[nodiscard]] std::string index(Py_ssize_t i) const {
    std::string text;
    for (std::size_t d = shape_.size(); d-- > 0; i /= shape_[d])
      text = "[" + std::to_string(i % shape_[d]) + "]" + text;
    return text;
  }
  /// The index in the argument's own array, without the axes along which it is repeated.
  [[nodiscard]] std::string own_index(const Many& m, Py_ssize_t i) const {
    std::string text;
    for (std::size_t d = shape_.size(); d-- > 0; i /= shape_[d]) {
      const std::size_t missing = shape_.size() - m.shape_.size();
      if (d < missing) break;
      text = "[" + std::to_string(m.shape_[d - missing] == 1 ? 0 : i % shape_[d]) + "]" + text;
    }
    return text;
  }
  /// Of the first argument that has a number that is not finite in question i: which, and where.
  [[nodiscard]] const Many* not_finite(Py_ssize_t i, Py_ssize_t& component) const {
    for (std::size_t k = 0; k < many_.size(); ++k) {
      const Many& m = *many_[k];
      if (m.components_ == 0) continue;
      double numbers[16];
      if (m.single_)
        std::memcpy(numbers, m.numbers_, sizeof(numbers));
      else
        copy_numbers(k, i, 1, numbers);
      for (component = 0; component < m.components_; ++component)
        if (!std::isfinite(numbers[component])) return &m;
    }
    return nullptr;
  }

 private:
  template <class T>
  void copy_as(std::size_t k, Py_ssize_t begin, Py_ssize_t count, double* out) const {
    const Many& m = *many_[k];
    const Py_ssize_t n = m.components_;
    if (even_[k] && n == 3) {
      const char* from = at(k, begin);
      const Py_ssize_t step = single_step_[k], inner = m.inner_;
      if constexpr (std::is_floating_point_v<T>) {  // the two orders of arrays, without a turn for each
                                                    // number
        const auto* x = reinterpret_cast<const T*>(from);
        if (step == sizeof(T)) {
          const auto* y = reinterpret_cast<const T*>(from + inner);
          const auto* z = reinterpret_cast<const T*>(from + 2 * inner);
          Py_ssize_t i = 0;
#ifdef __SSE2__
          if constexpr (std::is_same_v<T,
                                       double>)  // two rows by three loads, three shuffles and three stores
            for (; i + 1 < count; i += 2) {
              const __m128d a = _mm_loadu_pd(x + i), b = _mm_loadu_pd(y + i), c = _mm_loadu_pd(z + i);
              _mm_storeu_pd(out + 3 * i, _mm_unpacklo_pd(a, b));
              _mm_storeu_pd(out + 3 * i + 2, _mm_shuffle_pd(c, a, 2));
              _mm_storeu_pd(out + 3 * i + 4, _mm_unpackhi_pd(b, c));
            }
#endif
          for (; i < count; ++i) {
            out[3 * i] = static_cast<double>(x[i]);
            out[3 * i + 1] = static_cast<double>(y[i]);
            out[3 * i + 2] = static_cast<double>(z[i]);
          }
          return;
        }
        if (inner == sizeof(T) && step % static_cast<Py_ssize_t>(sizeof(T)) == 0) {
          const Py_ssize_t row = step / static_cast<Py_ssize_t>(sizeof(T));
          for (Py_ssize_t i = 0; i < count; ++i, x += row, out += 3) {
            out[0] = static_cast<double>(x[0]);
            out[1] = static_cast<double>(x[1]);
            out[2] = static_cast<double>(x[2]);
          }
          return;
        }
      }
      for (Py_ssize_t i = 0; i < count; ++i, from += step, out += 3) {
        out[0] = exact<T>(from, m, 0);
        out[1] = exact<T>(from + inner, m, 1);
        out[2] = exact<T>(from + 2 * inner, m, 2);
      }
      return;
    }
    for (Py_ssize_t i = 0; i < count; ++i) {
      const char* from = at(k, begin + i);
      for (Py_ssize_t c = 0; c < n; ++c) *out++ = exact<T>(from + c * m.inner_, m, c);
    }
  }
  void copy_numbers(std::size_t k, Py_ssize_t begin, Py_ssize_t count, double* out) const {
    switch (many_[k]->kind_) {
      case 'd':
        return copy_as<double>(k, begin, count, out);
      case 'f':
        return copy_as<float>(k, begin, count, out);
      case 'b':
        return copy_as<std::int8_t>(k, begin, count, out);
      case 'h':
        return copy_as<std::int16_t>(k, begin, count, out);
      case 'i':
        return copy_as<std::int32_t>(k, begin, count, out);
      case 'q':
        return copy_as<std::int64_t>(k, begin, count, out);
      case 'B':
        return copy_as<std::uint8_t>(k, begin, count, out);
      case 'H':
        return copy_as<std::uint16_t>(k, begin, count, out);
      case 'I':
        return copy_as<std::uint32_t>(k, begin, count, out);
      default:
        return copy_as<std::uint64_t>(k, begin, count, out);
    }
  }

  std::span<const Many* const> many_;
  std::span<const Py_ssize_t> shape_;
  Py_ssize_t count_ = 0;
  std::vector<std::vector<Py_ssize_t>> steps_;
  std::vector<char> even_;
  std::vector<Py_ssize_t> single_step_;
};

void answer_all(Given& given, std::span<const Many* const> many, std::span<const Py_ssize_t> shape,
                std::span<const Output> outputs, int threads, Kernel kernel, void* f, Kernel whole) {
  const Walk walk(many, shape);
  std::atomic<Py_ssize_t> next{0};
  Stop stop;
  std::mutex mutex;
  std::condition_variable condition;
  bool done = false;
  int running = 0;
  Py_ssize_t failed_at = walk.count();
  std::exception_ptr failure;

  const auto fail = [&](Py_ssize_t question) {
    const std::lock_guard lock(mutex);
    if (question < failed_at) {
      failed_at = question;
      failure = std::current_exception();
    }
  };
  // One thread's work; the caller's looks for signals between its parts. False: a signal raised something.
  const auto work = [&](bool watches) {
    std::vector<std::vector<double>> room(many.size());
    Part part;
    Py_ssize_t size = whole ? 512 : 16;
    auto looked = Clock::now();
    int parts = 0;
    std::optional<py::error_already_set> raised;
    while (!stop.requested()) {
      const Py_ssize_t begin = next.fetch_add(size);
      if (begin >= walk.count()) break;
      const Py_ssize_t count = std::min(size, walk.count() - begin);
      const auto started = whole ? looked : Clock::now();
      for (std::size_t o = 0; o < outputs.size(); ++o) {
        part.out[o] = outputs[o].data + begin * outputs[o].size;
        part.step[7 - o] = outputs[o].size;
      }
      Py_ssize_t at = 0;
      try {
        walk.part(begin, count, room, part, whole != nullptr);
        (whole ? whole : kernel)(f, part, at);
      } catch (...) {
        if (whole) {  // again one by one: which question it was
          Part one;
          for (at = 0; at < count; ++at) {
            for (std::size_t o = 0; o < outputs.size(); ++o) one.out[o] = part.out[o] + at * outputs[o].size;
            Py_ssize_t zero = 0;
            try {
              walk.part(begin + at, 1, room, one, true);
              kernel(f, one, zero);
            } catch (...) {
              fail(begin + at);
              break;
            }
          }
        } else {
          fail(begin + at);
        }
        next = walk.count();  // earlier parts are all under way: the first failure of all is found
        break;
      }
      if (whole && ++parts % 64 != 0) continue;  // a part takes a microsecond or two
      const auto now = Clock::now();
      if (!whole) {
        if (now - started < std::chrono::microseconds(500) && size < 8192) size *= 2;
        if (now - started > std::chrono::milliseconds(20) && size > 1) size /= 2;
      }
      if (watches && now - looked > kBetweenSignals) {
        looked = now;
        const py::gil_scoped_acquire hold;
        if (PyErr_CheckSignals() != 0) {
          raised.emplace();
          stop.request();
        }
      }
    }
    return raised;
  };

  std::optional<py::error_already_set> raised;
  {
    const bool aside = given.long_work && in_main_thread();  // one question alone may be long
    std::vector<std::thread> others;
    const int extra = static_cast<int>(std::min<Py_ssize_t>(threads, std::max<Py_ssize_t>(walk.count(), 1)) -
                                       (aside ? 0 : 1));
    running = extra;
    for (int t = 0; t < extra; ++t)
      others.emplace_back([&] {
        {
          const StopScope heard(&stop);
          (void)work(false);
        }
        const std::lock_guard lock(mutex);
        if (--running == 0) {
          done = true;
          condition.notify_all();
        }
      });
    if (aside) {
      raised = wait_for(condition, mutex, done, stop);
    } else {
      std::recursive_mutex* machine =
          given.self && is_object(given.self) ? reinterpret_cast<Instance*>(given.self)->lock.get() : nullptr;
      const py::gil_scoped_release quiet;
      const StopScope heard(&stop);
      std::unique_lock<std::recursive_mutex> hold;
      if (machine) hold = std::unique_lock(*machine);
      raised = work(true);
      for (auto& other : others) other.join();
      others.clear();
    }
    const py::gil_scoped_release quiet;
    for (auto& other : others) other.join();
  }
  if (raised) throw std::move(*raised);
  if (!failure) return;
  try {
    std::rethrow_exception(failure);
  } catch (const Rounded& rounded) {
    throw InputError(rounded.many->name() + walk.own_index(*rounded.many, failed_at) +
                         (rounded.many->scalar() ? "" : "[" + std::to_string(rounded.component) + "]"),
                     rounded.value, "a number that a double holds exactly");
  } catch (const InputError& error) {
    // The field as C++ names it, with the question's index after its first word, and the number that is not
    // finite.
    const std::size_t end = std::min(error.field().find_first_of("[."), error.field().size());
    std::string index = walk.index(failed_at), rest = error.field().substr(end);
    Py_ssize_t component = 0;
    const Many* bad = walk.not_finite(failed_at, component);
    if (bad) {
      index = walk.own_index(*bad, failed_at);
      if (rest.empty() && !bad->scalar()) rest = "[" + std::to_string(component) + "]";
    }
    throw InputError(error.field().substr(0, end) + index + rest, error.value(), error.requirement());
  }
}

}  // namespace vericone::python
