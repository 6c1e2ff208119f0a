// SPDX-License-Identifier: BSD-3-Clause
#include "call.h"
#include "pybind.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <bit>
#include <set>

namespace vericone::python {
namespace {

constexpr const char* kNumber = "a real number that a double holds exactly";

[[noreturn]] void rounded(const Place& place, const std::string& value) {
  throw Unfit(place.text(), value, kNumber);
}

/// In one line, and short.
std::string shown(PyObject* given) {
  const auto text = py::reinterpret_steal<py::object>(PyObject_Repr(given));
  if (!text) {
    PyErr_Clear();
    return "?";
  }
  std::string shown = py::str(text);
  std::replace(shown.begin(), shown.end(), '\n', ' ');
  if (shown.size() > 60) shown = shown.substr(0, 57) + "...";
  return shown;
}

bool is_array(PyObject* given) { return py::detail::npy_api::get().PyArray_Check_(given); }

/// What is no array and says what array it is: of pandas, a memoryview, an array.array.
bool is_array_like(PyObject* given) {
  static PyObject* const name = PyUnicode_InternFromString("__array__");
  static constinit Imported scalar("numpy", "generic");
  if (is_array(given) || PyUnicode_Check(given) || PyBytes_Check(given) || PyByteArray_Check(given))
    return false;
  if (!_PyType_Lookup(Py_TYPE(given), name) && !PyObject_CheckBuffer(given)) return false;
  return !py::isinstance(given, scalar.get());
}

/// No values stand below a mask.
void require_unmasked(PyObject* array, const Place& place) {
  static constinit Imported masked("numpy.ma", "MaskedArray"), any("numpy", "any");
  if (Py_TYPE(array) == py::detail::npy_api::get().PyArray_Type_ || !py::isinstance(array, masked.get()))
    return;
  if (py::bool_(any.get()(py::handle(array).attr("mask"))))
    throw InputError(place.text(), "an array with masked values", "without: leave them out, or fill them");
}

constinit Imported asarray("numpy", "asarray"), contiguous("numpy", "ascontiguousarray"),
    absolute("numpy", "abs");

std::string shape_text(std::span<const Py_ssize_t> shape) {
  std::string text = "(";
  for (const Py_ssize_t n : shape) text += (n < 0 ? std::string("n") : std::to_string(n)) + ", ";
  if (shape.size() > 1) text.resize(text.size() - 2);
  return (shape.size() == 1 ? text.substr(0, text.size() - 1) : text) + ")";
}

/// Refuses integers of an array that no double may hold, and wider numbers.
py::array exact_doubles(PyObject* given, const Place& place) {
  const auto array = py::reinterpret_borrow<py::array>(given);
  const char kind = array.dtype().kind();
  if (kind == 'f' && array.itemsize() > 8)
    throw InputError(place.text(), "an array of " + dtype_name(array), kNumber);
  if ((kind == 'i' || kind == 'u') && array.itemsize() == 8 && array.size() > 0 &&
      !py::bool_(py::int_(absolute.get()(array).attr("max")()) <= py::int_(std::uint64_t{1} << 53)))
    throw InputError(place.text(), "an integer beyond 2^53", kNumber);
  return array;
}

/// Names the first number of a list that is no double.
void check_numbers(PyObject* given, const Place& place, int depth = 0) {
  if (depth > 8) return;
  if (is_array(given)) {
    const py::dtype type = py::reinterpret_borrow<py::array>(given).dtype();
    if (type.kind() == 'O') {
      const py::object list = py::handle(given).attr("tolist")();
      if (PyList_Check(list.ptr())) check_numbers(list.ptr(), place, depth + 1);
    } else if (type.itemsize() >= 8 && type.kind() != 'c') {
      (void)exact_doubles(given, place);  // numpy makes doubles of them where others are
    }
    return;
  }
  if (PyList_Check(given) || PyTuple_Check(given)) {
    for (Py_ssize_t i = 0; i < PySequence_Fast_GET_SIZE(given); ++i) {
      const auto item = py::reinterpret_borrow<py::object>(PySequence_Fast_GET_ITEM(given, i));
      check_numbers(item.ptr(), {&place, nullptr, i}, depth + 1);
    }
    return;
  }
  (void)number_from(given, place);
}

template <class T>
Numbers<T> numbers_of(const py::array& array) {
  return {Reference::to(array.ptr()), static_cast<const T*>(array.data()), array.shape(0),
          array.ndim() > 1 ? array.shape(1) : 1};
}

py::array array_from(PyObject* given, std::span<const Py_ssize_t> shape, const Place& place, bool whole) {
  py::object array;
  if (is_array(given)) {
    require_unmasked(given, place);
    array = py::reinterpret_borrow<py::object>(given);
  } else {
    if (!is_sequence(given)) wrong_type(place, ("an array of shape " + shape_text(shape)).c_str(), given);
    if (!whole && !is_array_like(given)) check_numbers(given, place);
    try {
      array = asarray.get()(py::handle(given));
    } catch (py::error_already_set& error) {
      if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
      wrong_type(place, ("an array of shape " + shape_text(shape)).c_str(), given);
    }
  }
  auto numbers = py::reinterpret_borrow<py::array>(array);
  const char kind = numbers.dtype().kind();
  // An empty list has no type of its own.
  const bool empty = numbers.size() == 0 && !is_array(given);
  if (whole ? kind != 'i' && kind != 'u' && !empty
            : (kind != 'f' && kind != 'i' && kind != 'u') || (kind == 'f' && numbers.itemsize() > 8))
    throw InputError(place.text(), "an array of " + dtype_name(numbers),
                     whole ? "an array of integers" : "an array of real numbers that doubles hold exactly");
  const bool any_length = std::any_of(shape.begin(), shape.end(), [](Py_ssize_t n) { return n < 0; });
  if (empty && any_length && shape.size() > 1) {
    std::vector<Py_ssize_t> none(shape.begin(), shape.end());
    for (Py_ssize_t& n : none) n = std::max<Py_ssize_t>(n, 0);
    return py::array(py::dtype(whole ? "i8" : "f8"), none);
  }
  bool fits = numbers.ndim() == static_cast<Py_ssize_t>(shape.size());
  for (std::size_t i = 0; fits && i < shape.size(); ++i)
    fits = shape[i] < 0 || numbers.shape(static_cast<Py_ssize_t>(i)) == shape[i];
  if (!fits) {
    std::vector<Py_ssize_t> own(numbers.shape(), numbers.shape() + numbers.ndim());
    throw Unfit(place.text(), "an array of shape " + shape_text(own), "of shape " + shape_text(shape));
  }
  if (whole ? kind == 'u' && numbers.itemsize() == 8 : kind != 'f' && numbers.itemsize() == 8) {
    const auto most = whole ? std::uint64_t{1} << 63 : std::uint64_t{1} << 53;
    // As an int: numpy compares unsigned numbers with others as doubles.
    if (numbers.size() > 0 && !py::bool_(py::int_(absolute.get()(numbers).attr("max")()) <= py::int_(most)))
      throw InputError(place.text(), "an integer beyond " + std::string(whole ? "2^63" : "2^53"), kNumber);
  }
  return contiguous.get()(numbers, py::dtype(whole ? "i8" : "f8"));
}

}  // namespace

Reference strict_array(PyObject* given, const Place& place) {
  if (is_array(given)) {
    require_unmasked(given, place);
    return Reference::to(given);
  }
  if (!is_array_like(given)) check_numbers(given, place);
  try {
    return reference_to(asarray.get()(py::handle(given)));
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
    wrong_type(place, "an array of real numbers, its rows equally long", given);
  }
}

bool is_number(PyObject* given) {
  return PyFloat_Check(given) || PyLong_Check(given) ||
         (PyNumber_Check(given) && !is_sequence(given) && !PyComplex_Check(given));
}

bool is_sequence(PyObject* given) {
  if (PyList_Check(given) || PyTuple_Check(given)) return true;
  if (is_array(given)) return py::detail::array_proxy(given)->nd > 0;
  if (PyUnicode_Check(given) || PyBytes_Check(given) || PyByteArray_Check(given) || PyDict_Check(given))
    return false;
  return PySequence_Check(given) || is_array_like(given);
}

Reference fast_sequence(PyObject* given, const Place& place) {
  if (!is_sequence(given)) wrong_type(place, "a list", given);
  PyObject* list = PySequence_Tuple(given);  // stays as it is, whatever its items do when they are converted
  if (!list) throw py::error_already_set();
  return Reference(list);
}

void items_from(const Reference& parts, const Place& place, void* first, std::size_t size,
                void (*from)(void*, PyObject*, const Place&)) {
  for (Py_ssize_t i = 0; i < PyTuple_GET_SIZE(parts.get()); ++i)
    from(static_cast<char*>(first) + static_cast<std::size_t>(i) * size, PyTuple_GET_ITEM(parts.get(), i),
         {&place, nullptr, i});
}

PyObject* list_to(const void* first, std::size_t count, std::size_t size, PyObject* (*to)(const void*)) {
  py::list result(count);
  for (std::size_t i = 0; i < count; ++i) {
    PyObject* item = to(static_cast<const char*>(first) + i * size);
    if (!item) throw_raised();
    PyList_SET_ITEM(result.ptr(), static_cast<Py_ssize_t>(i), item);
  }
  return result.release().ptr();
}

double number_from(PyObject* given, const Place& place) {
  if (PyFloat_Check(given)) return PyFloat_AS_DOUBLE(given);
  static constinit Imported truth("numpy", "bool_");
  if (PyBool_Check(given) || PyUnicode_Check(given) || PyComplex_Check(given) || is_sequence(given) ||
      py::isinstance(given, truth.get()))
    wrong_type(place, "a real number", given);
  if (is_array(given) && py::reinterpret_borrow<py::array>(given).dtype().kind() == 'O')
    wrong_type(place, "a real number", given);
  if (is_array(given))  // of no axes
    return number_from(py::object(py::handle(given).attr("item")()).ptr(), place);
  if (PyIndex_Check(given)) {
    const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(given));
    if (!whole) throw py::error_already_set();
    const double x = PyLong_AsDouble(whole.ptr());
    if (x == -1 && PyErr_Occurred()) {
      PyErr_Clear();
      rounded(place, shown(given));
    }
    const auto back = py::reinterpret_steal<py::object>(PyLong_FromDouble(x));
    if (PyObject_RichCompareBool(back.ptr(), whole.ptr(), Py_EQ) != 1) rounded(place, shown(given));
    return x;
  }
  if (!PyNumber_Check(given)) wrong_type(place, "a real number", given);
  const auto number = py::reinterpret_steal<py::object>(PyNumber_Float(given));
  if (!number) {
    if (PyErr_ExceptionMatches(PyExc_OverflowError)) {
      PyErr_Clear();
      rounded(place, shown(given));
    }
    if (!PyErr_ExceptionMatches(PyExc_TypeError) && !PyErr_ExceptionMatches(PyExc_ValueError))
      throw py::error_already_set();
    PyErr_Clear();
    wrong_type(place, "a real number", given);
  }
  const double x = PyFloat_AS_DOUBLE(number.ptr());
  if (x == x) {  // what is not a double stays what it is: a Fraction of 1/3, a longdouble
    const int same = PyObject_RichCompareBool(number.ptr(), given, Py_EQ);
    if (same < 0) throw py::error_already_set();
    if (same == 0) rounded(place, shown(given));
  }
  return x;
}

long long integer_from(PyObject* given, long long least, unsigned long long most, const Place& place) {
  if (PyBool_Check(given) || !PyIndex_Check(given) || is_sequence(given))
    wrong_type(place, "an integer", given);
  const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(given));
  if (!whole) {
    PyErr_Clear();
    wrong_type(place, "an integer", given);
  }
  if (!py::bool_(py::int_(least) <= whole && whole <= py::int_(most)))
    throw InputError(place.text(), shown(given),
                     "an integer from " + std::to_string(least) + " to " + std::to_string(most));
  if (py::bool_(whole > py::int_(std::numeric_limits<long long>::max())))
    return static_cast<long long>(PyLong_AsUnsignedLongLong(whole.ptr()));
  return PyLong_AsLongLong(whole.ptr());
}

bool Convert<bool>::from(PyObject* given, const Place& place) {
  if (given == Py_True) return true;
  if (given == Py_False) return false;
  static constinit Imported numpy_bool("numpy", "bool_");
  if (!py::isinstance(given, numpy_bool.get())) wrong_type(place, "True or False", given);
  return PyObject_IsTrue(given) == 1;
}

std::string text_from(PyObject* given, const Place& place) {
  if (!PyUnicode_Check(given)) wrong_type(place, "text", given);
  const auto bytes =
      py::reinterpret_steal<py::object>(PyUnicode_AsEncodedString(given, "utf-8", "surrogateescape"));
  if (!bytes) {
    PyErr_Clear();
    throw InputError(place.text(), shown(given), "text that UTF-8 can say");
  }
  std::string text(PyBytes_AS_STRING(bytes.ptr()), static_cast<std::size_t>(PyBytes_GET_SIZE(bytes.ptr())));
  if (text.find('\0') != std::string::npos)
    throw InputError(place.text(), shown(given), "text without a zero byte");
  return text;
}

std::filesystem::path Convert<std::filesystem::path>::from(PyObject* given, const Place& place) {
  PyObject* text = PyOS_FSPath(given);
  if (!text) {
    if (!PyErr_ExceptionMatches(PyExc_TypeError)) throw py::error_already_set();
    PyErr_Clear();
    wrong_type(place, "a path", given);
  }
  const auto held = py::reinterpret_steal<py::object>(text);
  if (PyBytes_Check(text)) {
    if (std::strlen(PyBytes_AS_STRING(text)) != static_cast<std::size_t>(PyBytes_GET_SIZE(text)))
      wrong_type(place, "a path, without zeros", given);
    return std::string(PyBytes_AS_STRING(text));
  }
  return text_from(text, place);
}
PyObject* Convert<std::filesystem::path>::to(const std::filesystem::path& path) {
  static constinit Imported make("pathlib", "Path");
  return make.get()(py::reinterpret_steal<py::object>(Convert<std::string>::to(path.string())))
      .release()
      .ptr();
}
bool Convert<std::filesystem::path>::could(PyObject* given) {
  return PyUnicode_Check(given) || PyBytes_Check(given) || PyObject_HasAttrString(given, "__fspath__");
}

Numbers<double> doubles_from(PyObject* given, std::span<const Py_ssize_t> shape, const Place& place) {
  return numbers_of<double>(array_from(given, shape, place, false));
}
Numbers<std::int64_t> integers_from(PyObject* given, std::span<const Py_ssize_t> shape, const Place& place) {
  return numbers_of<std::int64_t>(array_from(given, shape, place, true));
}
void require_range(long long x, long long least, unsigned long long most, const Place& place) {
  if (x < least || (x > 0 && static_cast<unsigned long long>(x) > most))
    (void)integer_from(py::int_(x).ptr(), least, most, place);
}
PyObject* numbers_to(const void* data, const std::string& type, std::span<const Py_ssize_t> shape) {
  py::array array(py::dtype(type), std::vector<Py_ssize_t>(shape.begin(), shape.end()));
  if (array.size() > 0) std::memcpy(array.mutable_data(), data, static_cast<std::size_t>(array.nbytes()));
  return array.release().ptr();
}
PyObject* doubles_to(const double* data, std::span<const Py_ssize_t> shape) {
  py::array_t<double> array(std::vector<Py_ssize_t>(shape.begin(), shape.end()));
  if (array.size() > 0) std::memcpy(array.mutable_data(), data, static_cast<std::size_t>(array.size()) * 8);
  return array.release().ptr();
}

void fixed_from(PyObject* given, int rows, int columns, double* out, const Place& place) {
  const int count = rows * columns;
  if (is_array(given)) {
    require_unmasked(given, place);
    const auto* array = py::detail::array_proxy(given);
    if (columns == 1 && array->nd == 1 && array->dimensions[0] == rows && array->strides[0] == 8 &&
        py::detail::array_descriptor_proxy(array->descr)->type == 'd' &&
        (array->flags & py::detail::npy_api::NPY_ARRAY_ALIGNED_) &&
        py::detail::array_descriptor_proxy(array->descr)->byteorder != '>') {
      std::memcpy(out, array->data, static_cast<std::size_t>(count) * 8);
      return;
    }
  } else if (columns == 1 && (PyList_Check(given) || PyTuple_Check(given)) &&
             PySequence_Fast_GET_SIZE(given) == rows) {
    for (Py_ssize_t i = 0; i < rows; ++i) {
      if (PySequence_Fast_GET_SIZE(given) != rows)  // a number's own conversion has changed the list
        wrong_type(place, "a list that stays as it is", given);
      const auto number = py::reinterpret_borrow<py::object>(PySequence_Fast_GET_ITEM(given, i));
      out[i] = number_from(number.ptr(), {&place, nullptr, i});
    }
    return;
  }
  const Py_ssize_t shape[2] = {rows, columns};
  const auto array = doubles_from(given, {shape, columns == 1 ? 1u : 2u}, place);
  std::memcpy(out, array.data, static_cast<std::size_t>(count) * 8);
}

Eigen::Isometry3d Convert<Eigen::Isometry3d>::from(PyObject* given, const Place& place) {
  const auto m = Convert<Eigen::Matrix4d>::from(given, place);
  if (m.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    throw InputError(place.text() + "[3]", "another row", "0, 0, 0, 1, the last row of a rigid motion");
  Eigen::Isometry3d t;
  t.matrix() = m;
  return t;
}

namespace {

struct HeldFunction {
  std::shared_ptr<void> function;
  PyObject* (*call)(void*, PyObject*);
};

PyObject* call_held(PyObject* capsule, PyObject* arguments) {
  const auto* held = static_cast<const HeldFunction*>(PyCapsule_GetPointer(capsule, nullptr));
  try {
    return held->call(held->function.get(), arguments);
  } catch (...) {
    return raise_current();
  }
}

}  // namespace

PyObject* function_to(std::shared_ptr<void> function, PyObject* (*call)(void*, PyObject*)) {
  static PyMethodDef method = {"function", call_held, METH_VARARGS, "A function of the library."};
  auto held = std::make_unique<HeldFunction>(HeldFunction{std::move(function), call});
  const py::capsule capsule(held.get(), [](void* at) { delete static_cast<HeldFunction*>(at); });
  held.release();
  return PyCFunction_New(&method, capsule.ptr());
}

const char* kept_text(const std::string& text) {
  static auto& kept = *new std::set<std::string>;
  return kept.insert(text).first->c_str();
}

Callable::Callable(PyObject* function)
    : function_(Py_NewRef(function), [](PyObject* held) {
        if (!Py_IsInitialized()) return;
        const py::gil_scoped_acquire hold;
        Py_DECREF(held);
      }) {}

Reference Callable::operator()(std::initializer_list<PyObject*> arguments) const {
  py::tuple all(arguments.size());
  Py_ssize_t i = 0;
  for (PyObject* argument : arguments) PyTuple_SET_ITEM(all.ptr(), i++, argument);
  PyObject* answer = PyObject_CallObject(function_.get(), all.ptr());
  if (!answer) throw py::error_already_set();
  return Reference(answer);
}

void* object_from(PyObject* given, const TypeInfo& info, std::shared_ptr<void>& made, const Place& place) {
  if (is_instance(given, info)) return value_of(given, info);
  if (info.stand_in) made = info.stand_in(given, place);
  if (!made) wrong_type(place, (std::string("a vericone.") + info.name).c_str(), given);
  return made.get();
}

bool could_be(PyObject* given, const TypeInfo& info) {
  return is_instance(given, info) || (info.has_stand_in && info.has_stand_in(given));
}

// Rationals.

namespace {

py::object negated(const py::object& number) {
  return py::reinterpret_steal<py::object>(PyNumber_Negative(number.ptr()));
}

}  // namespace

WholeNumber whole_from(PyObject* given, const Place& place) {
  if (PyBool_Check(given) || !PyIndex_Check(given)) wrong_type(place, "an integer", given);
  const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(given));
  if (!whole) throw py::error_already_set();
  const bool negative = py::bool_(whole < py::int_(0));
  const auto digits = py::reinterpret_steal<py::object>(
      PyNumber_ToBase(negative ? negated(whole).ptr() : whole.ptr(), 16));  // "0x..."
  const WholeNumber x{std::string(py::str(digits))};
  return negative ? WholeNumber(-x) : x;
}

PyObject* whole_to(const WholeNumber& x) {
  const auto& own = x.backend();
  static_assert(std::endian::native == std::endian::little);
  const py::bytes bytes(reinterpret_cast<const char*>(own.limbs()), own.size() * sizeof(own.limbs()[0]));
  auto whole = py::reinterpret_steal<py::object>(PyObject_CallMethod(
      reinterpret_cast<PyObject*>(&PyLong_Type), "from_bytes", "Os", bytes.ptr(), "little"));
  if (!whole) throw py::error_already_set();
  return x < 0 ? negated(whole).release().ptr() : whole.release().ptr();
}

Rational rational_from(PyObject* given, const Place& place) {
  if (PyFloat_Check(given)) {
    const double x = PyFloat_AS_DOUBLE(given);
    if (!std::isfinite(x)) throw InputError(place.text(), to_text(x), "a rational number");
    return Rational(x);
  }
  if (PyIndex_Check(given) && !PyBool_Check(given)) return Rational(whole_from(given, place));
  if (!PyBool_Check(given) && PyObject_HasAttrString(given, "numerator") &&
      PyObject_HasAttrString(given, "denominator")) {
    const py::object top = py::handle(given).attr("numerator"),
                     bottom = py::handle(given).attr("denominator");
    const WholeNumber divisor = whole_from(bottom.ptr(), place);
    if (divisor == 0) throw InputError(place.text(), shown(given), "a rational number");
    return Rational(whole_from(top.ptr(), place), divisor);
  }
  if (!PyBool_Check(given) && is_number(given)) {  // of numpy: what a double holds
    const double x = number_from(given, place);
    if (std::isfinite(x)) return Rational(x);
    throw InputError(place.text(), to_text(x), "a rational number");
  }
  wrong_type(place, "a Fraction, an int or a float", given);
}

PyObject* rational_to(const Rational& x) {
  static constinit Imported make("fractions", "Fraction");
  const auto top =
      py::reinterpret_steal<py::object>(whole_to(WholeNumber(boost::multiprecision::numerator(x))));
  const auto bottom =
      py::reinterpret_steal<py::object>(whole_to(WholeNumber(boost::multiprecision::denominator(x))));
  return make.get()(top, bottom).release().ptr();
}

}  // namespace vericone::python
