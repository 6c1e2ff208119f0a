// SPDX-License-Identifier: BSD-3-Clause
//
// C++ types from and to Python objects: numbers, text, vectors and matrices, lists, optional values,
// callbacks, rationals, and the types of the library.
#pragma once

#include <vericone/geometry/error.h>
#include <vericone/geometry/interval.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "object.h"

namespace vericone::python {

/// Convert<T>::from(object, place) throws WrongType or InputError; ::to(value) returns a new reference;
/// ::could(object) says at once whether it may be one; kColumn is how arrays of records hold it.
template <class T>
struct Convert;
/// Where Convert<T> has no column, kColumn is null by its type: sanitizers take comparisons of addresses out
/// of constant expressions.
template <bool Has>
using ColumnOrNone = std::conditional_t<Has, const Column*, std::nullptr_t>;
template <class T>
inline constexpr bool kIsColumn = !std::is_same_v<decltype(Convert<T>::kColumn), const std::nullptr_t>;

[[nodiscard]] double number_from(PyObject* given, const Place& place);
[[nodiscard]] long long integer_from(PyObject* given, long long least, unsigned long long most,
                                     const Place& place);
[[nodiscard]] std::string text_from(PyObject* given, const Place& place);
/// For ever, once: names that C++ has as constants.
[[nodiscard]] const char* kept_text(const std::string& text);
/// An array of another shape than a parameter takes, or a number that no double is: the next overload is
/// tried, and none is this.
class Unfit : public InputError {
 public:
  using InputError::InputError;
};
/// An array as it is; one of what is none, each number of which is a double.
[[nodiscard]] Reference strict_array(PyObject* given, const Place& place);
/// Numbers in C order, rows x columns of them, which an array holds.
template <class T>
struct Numbers {
  Reference array;
  const T* data = nullptr;
  Py_ssize_t rows = 0, columns = 1;
  [[nodiscard]] Py_ssize_t size() const { return rows * columns; }
};
/// Doubles from anything that is an array of these sizes (-1: any), without rounding.
[[nodiscard]] Numbers<double> doubles_from(PyObject* given, std::span<const Py_ssize_t> shape,
                                           const Place& place);
/// The same of integers.
[[nodiscard]] Numbers<std::int64_t> integers_from(PyObject* given, std::span<const Py_ssize_t> shape,
                                                  const Place& place);
void require_range(long long x, long long least, unsigned long long most, const Place& place);
[[nodiscard]] PyObject* doubles_to(const double* data, std::span<const Py_ssize_t> shape);
[[nodiscard]] bool is_number(PyObject* given);    // float, int, Fraction, scalars of numpy
[[nodiscard]] bool is_sequence(PyObject* given);  // list, tuple, or numpy array; no text
/// The items of a sequence as a tuple.
[[nodiscard]] Reference fast_sequence(PyObject* given, const Place& place);
/// Each part of such a tuple to the item of an array that has its index.
void items_from(const Reference& parts, const Place& place, void* first, std::size_t size,
                void (*from)(void* item, PyObject* part, const Place& place));
/// The items of an array as a list.
[[nodiscard]] PyObject* list_to(const void* first, std::size_t count, std::size_t size,
                                PyObject* (*to)(const void* item));
/// Numbers as an array of this type ("f8") and these sizes.
[[nodiscard]] PyObject* numbers_to(const void* data, const std::string& type,
                                   std::span<const Py_ssize_t> shape);
/// Calls a Python callable with the global lock held; what it raises goes through C++ to the caller.
class Callable {
 public:
  explicit Callable(PyObject* function);
  [[nodiscard]] PyObject* function() const { return function_.get(); }
  /// Arguments as new references, which it takes.
  [[nodiscard]] Reference operator()(std::initializer_list<PyObject*> arguments) const;

 private:
  std::shared_ptr<PyObject> function_;
};

/// A function of C++ as one of Python, which keeps it.
[[nodiscard]] PyObject* function_to(std::shared_ptr<void> function,
                                    PyObject* (*call)(void* function, PyObject* arguments));

// Numbers.
template <class T>
struct NumberColumn {
  static std::string format() {
    if constexpr (std::is_same_v<T, bool>) return "?";
    return std::string(1, std::is_floating_point_v<T> ? 'f'
                          : std::is_signed_v<T>       ? 'i'
                                                      : 'u') +
           std::to_string(sizeof(T));
  }
  static void write(void* row, const void* value) { std::memcpy(row, value, sizeof(T)); }
  static void write_nothing(void* row) {
    T none{};
    if constexpr (std::is_floating_point_v<T>) none = std::numeric_limits<T>::quiet_NaN();
    std::memcpy(row, &none, sizeof(T));
  }
  static constexpr Column kColumn{&format, sizeof(T), &write, &write_nothing};
};

template <class T>
requires std::is_floating_point_v<T>
struct Convert<T> {
  static T from(PyObject* given, const Place& place) {
    const double x = number_from(given, place);
    return static_cast<T>(x);
  }
  static PyObject* to(T x) { return PyFloat_FromDouble(x); }
  static bool could(PyObject* given) { return is_number(given); }
  static constexpr const Column* kColumn = &NumberColumn<T>::kColumn;
};
template <class T>
requires(std::is_integral_v<T> && !std::is_same_v<T, bool>) struct Convert<T> {
  static T from(PyObject* given, const Place& place) {
    return static_cast<T>(integer_from(given, static_cast<long long>(std::numeric_limits<T>::min()),
                                       std::numeric_limits<T>::max(), place));
  }
  static PyObject* to(T x) {
    if constexpr (std::is_signed_v<T>) return PyLong_FromLongLong(x);
    return PyLong_FromUnsignedLongLong(x);
  }
  static bool could(PyObject* given) { return PyIndex_Check(given) && !is_sequence(given); }
  static constexpr const Column* kColumn = &NumberColumn<T>::kColumn;
};
template <>
struct Convert<bool> {
  static bool from(PyObject* given, const Place& place);
  static PyObject* to(bool x) { return PyBool_FromLong(x); }
  static bool could(PyObject*) { return true; }
  static constexpr const Column* kColumn = &NumberColumn<bool>::kColumn;
};

// Text and paths.
template <>
struct Convert<std::string> {
  static std::string from(PyObject* given, const Place& place) { return text_from(given, place); }
  static PyObject* to(const std::string& text) {
    return PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "surrogateescape");
  }
  static bool could(PyObject* given) { return PyUnicode_Check(given); }
  static constexpr std::nullptr_t kColumn = nullptr;
};
template <>
struct Convert<const char*> {
  static const char* from(PyObject* given, const Place& place) { return kept_text(text_from(given, place)); }
  static PyObject* to(const char* text) {
    if (!text) Py_RETURN_NONE;
    return PyUnicode_DecodeUTF8(text, static_cast<Py_ssize_t>(std::strlen(text)), "surrogateescape");
  }
  static constexpr std::nullptr_t kColumn = nullptr;
};
template <>
struct Convert<std::string_view> {
  static PyObject* to(std::string_view text) { return Convert<std::string>::to(std::string(text)); }
  static constexpr std::nullptr_t kColumn = nullptr;
};
template <>
struct Convert<std::filesystem::path> {
  static std::filesystem::path from(PyObject* given, const Place& place);
  static PyObject* to(const std::filesystem::path& path);
  static bool could(PyObject* given);
  static constexpr std::nullptr_t kColumn = nullptr;
};

// Vectors and matrices of fixed size.
template <int R, int C>
struct FixedColumn {
  static std::string format() {
    return C == 1 ? "(" + std::to_string(R) + ",)f8"
                  : "(" + std::to_string(R) + "," + std::to_string(C) + ")f8";
  }
  static void write(void* row, const void* value) {
    const auto& m = *static_cast<const Eigen::Matrix<double, R, C>*>(value);
    auto* out = static_cast<double*>(row);
    for (int i = 0; i < R; ++i)
      for (int j = 0; j < C; ++j) *out++ = m(i, j);
  }
  static void write_nothing(void* row) {
    auto* out = static_cast<double*>(row);
    for (int i = 0; i < R * C; ++i) *out++ = std::numeric_limits<double>::quiet_NaN();
  }
  static constexpr Column kColumn{&format, R* C * 8, &write, &write_nothing};
};
/// Into `out`, C order; a (3,) array of doubles at once.
void fixed_from(PyObject* given, int rows, int columns, double* out, const Place& place);

template <int R, int C, int O, int MR, int MC>
requires(R > 0 && C > 0) struct Convert<Eigen::Matrix<double, R, C, O, MR, MC>> {
  using M = Eigen::Matrix<double, R, C, O, MR, MC>;
  static M from(PyObject* given, const Place& place) {
    double numbers[R * C];
    fixed_from(given, R, C, numbers, place);
    M m;
    for (int i = 0; i < R; ++i)
      for (int j = 0; j < C; ++j) m(i, j) = numbers[i * C + j];
    return m;
  }
  static PyObject* to(const M& m) {
    double numbers[R * C];
    for (int i = 0; i < R; ++i)
      for (int j = 0; j < C; ++j) numbers[i * C + j] = m(i, j);
    const Py_ssize_t shape[2] = {R, C};
    return doubles_to(numbers, {shape, C == 1 ? 1u : 2u});
  }
  static bool could(PyObject* given) { return is_sequence(given); }
  static constexpr const Column* kColumn = &FixedColumn<R, C>::kColumn;
};
template <int R, int C, int O, int MR, int MC>
requires(R < 0) struct Convert<Eigen::Matrix<double, R, C, O, MR, MC>> {
  using M = Eigen::Matrix<double, R, C, O, MR, MC>;
  static M from(PyObject* given, const Place& place) {
    const Py_ssize_t shape[2] = {R, C};
    const auto a = doubles_from(given, {shape, C == 1 ? 1u : 2u}, place);
    M m(a.rows, a.columns);
    for (Py_ssize_t i = 0; i < a.rows; ++i)
      for (Py_ssize_t j = 0; j < a.columns; ++j) m(i, j) = a.data[i * a.columns + j];
    return m;
  }
  static PyObject* to(const M& m) {
    std::vector<double> numbers(static_cast<std::size_t>(m.size()));
    for (Eigen::Index i = 0; i < m.rows(); ++i)
      for (Eigen::Index j = 0; j < m.cols(); ++j)
        numbers[static_cast<std::size_t>(i * m.cols() + j)] = m(i, j);
    const Py_ssize_t shape[2] = {m.rows(), m.cols()};
    return doubles_to(numbers.data(), {shape, C == 1 ? 1u : 2u});
  }
  static bool could(PyObject* given) { return is_sequence(given); }
  static constexpr std::nullptr_t kColumn = nullptr;
};
/// Points, one a column; in Python one a row, as all points: (n, R).
template <int R, int O, int MR, int MC>
requires(R > 0) struct Convert<Eigen::Matrix<double, R, Eigen::Dynamic, O, MR, MC>> {
  using M = Eigen::Matrix<double, R, Eigen::Dynamic, O, MR, MC>;
  static M from(PyObject* given, const Place& place) {
    const Py_ssize_t shape[2] = {-1, R};
    const auto a = doubles_from(given, shape, place);
    return a.rows == 0 ? M(R, 0) : M(Eigen::Map<const M>(a.data, R, a.rows));
  }
  static PyObject* to(const M& m) {
    const Py_ssize_t shape[2] = {m.cols(), R};
    return doubles_to(m.data(), shape);
  }
  static bool could(PyObject* given) { return is_sequence(given); }
  static constexpr std::nullptr_t kColumn = nullptr;
};
template <>
struct Convert<Eigen::Isometry3d> {  // 4 x 4
  static Eigen::Isometry3d from(PyObject* given, const Place& place);
  static PyObject* to(const Eigen::Isometry3d& t) {
    return Convert<Eigen::Matrix4d>::to(Eigen::Matrix4d(t.matrix()));
  }
  static bool could(PyObject* given) { return is_sequence(given); }
  static constexpr std::nullptr_t kColumn = nullptr;
};

// Rationals: fractions.Fraction, int, float.
using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;
using WholeNumber =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;
[[nodiscard]] Rational rational_from(PyObject* given, const Place& place);
[[nodiscard]] PyObject* rational_to(const Rational& x);
[[nodiscard]] WholeNumber whole_from(PyObject* given, const Place& place);
[[nodiscard]] PyObject* whole_to(const WholeNumber& x);
template <>
struct Convert<Rational> {
  static Rational from(PyObject* given, const Place& place) { return rational_from(given, place); }
  static PyObject* to(const Rational& x) { return rational_to(x); }
  static bool could(PyObject* given) { return is_number(given); }
  static constexpr std::nullptr_t kColumn = nullptr;
};
template <>
struct Convert<WholeNumber> {
  static WholeNumber from(PyObject* given, const Place& place) { return whole_from(given, place); }
  static PyObject* to(const WholeNumber& x) { return whole_to(x); }
  static bool could(PyObject* given) { return PyIndex_Check(given) && !is_sequence(given); }
  static constexpr std::nullptr_t kColumn = nullptr;
};

// Types of the library.
template <class T>
requires std::is_enum_v<T>
struct Convert<T> {
  static T from(PyObject* given, const Place& place) {
    return static_cast<T>(enum_value(type_of<T>(), given, place));
  }
  static PyObject* to(T x) { return enum_member(type_of<T>(), static_cast<long long>(x)); }
  static bool could(PyObject* given) { return PyLong_Check(given); }
  static std::string format() { return "i1"; }
  static void write(void* row, const void* value) {
    *static_cast<std::int8_t*>(row) = static_cast<std::int8_t>(*static_cast<const T*>(value));
  }
  static void write_nothing(void* row) { *static_cast<std::int8_t*>(row) = -128; }
  static constexpr Column kOwn{&format, 1, &write, &write_nothing};
  static constexpr const Column* kColumn = &kOwn;
};

/// The value of an object of this type, or of one that stands for it (which `made` then holds).
[[nodiscard]] void* object_from(PyObject* given, const TypeInfo& info, std::shared_ptr<void>& made,
                                const Place& place);
[[nodiscard]] bool could_be(PyObject* given, const TypeInfo& info);

template <class T>
struct IsRecord : std::false_type {};  // the generated tables say which are

/// An enclosure in an array: its two ends.
struct IntervalColumn {
  static std::string format() { return "(2,)f8"; }
  static void write(void* row, const void* value) {
    const auto& interval = *static_cast<const Interval*>(value);
    static_cast<double*>(row)[0] = interval.lo();
    static_cast<double*>(row)[1] = interval.hi();
  }
  static void write_nothing(void* row) {
    static_cast<double*>(row)[0] = static_cast<double*>(row)[1] = std::numeric_limits<double>::quiet_NaN();
  }
  static constexpr Column kColumn{&format, 16, &write, &write_nothing};
};

template <class T>
struct Convert {
  static T from(PyObject* given, const Place& place) requires std::is_copy_constructible_v<T> {
    std::shared_ptr<void> made;
    const Hold hold(given);
    return *static_cast<T*>(object_from(given, type_of<T>(), made, place));
  }
  static PyObject* to(T&& value) { return new_instance(type_of<T>(), own(new T(std::move(value)))); }
  static PyObject* to(const T& value) requires std::is_copy_constructible_v<T> {
    return new_instance(type_of<T>(), own(new T(value)));
  }
  static bool could(PyObject* given) { return could_be(given, type_of<T>()); }
  static std::string format() { return ""; }
  static void write(void* row, const void* value) { write_record(row, type_of<T>(), value); }
  static void write_nothing(void* row) { write_no_record(row, type_of<T>()); }
  static const TypeInfo* record() { return &type_of<T>(); }
  static constexpr Column kOwn{&format, -1, &write, &write_nothing, &record};
  static constexpr ColumnOrNone<std::is_same_v<T, Interval> || IsRecord<T>::value> column() {
    if constexpr (std::is_same_v<T, Interval>)
      return &IntervalColumn::kColumn;
    else if constexpr (IsRecord<T>::value)
      return &kOwn;
    else
      return nullptr;
  }
  static constexpr ColumnOrNone<std::is_same_v<T, Interval> || IsRecord<T>::value> kColumn = column();
};
template <class T>
struct Convert<std::shared_ptr<T>> {
  using V = std::remove_const_t<T>;
  static std::shared_ptr<T> from(PyObject* given, const Place& place) {
    if (given == Py_None) return nullptr;
    if (!is_instance(given, type_of<V>())) wrong_type(place, type_of<V>().name, given);
    return std::static_pointer_cast<V>(shared_of(given, type_of<V>()));
  }
  static PyObject* to(const std::shared_ptr<T>& value) {
    if (!value) Py_RETURN_NONE;
    return new_instance(type_of<V>(), std::const_pointer_cast<V>(value));
  }
  static bool could(PyObject* given) { return given == Py_None || is_instance(given, type_of<V>()); }
  static constexpr std::nullptr_t kColumn = nullptr;
};
template <class E>
struct Convert<std::shared_ptr<const std::vector<E>>> {  // a list
  using V = std::vector<E>;
  static std::shared_ptr<const V> from(PyObject* given, const Place& place) {
    if (given == Py_None) return nullptr;
    return std::make_shared<const V>(Convert<V>::from(given, place));
  }
  static PyObject* to(const std::shared_ptr<const V>& value) {
    if (!value) Py_RETURN_NONE;
    return Convert<V>::to(*value);
  }
  static bool could(PyObject* given) { return given == Py_None || Convert<V>::could(given); }
  static constexpr std::nullptr_t kColumn = nullptr;
};
template <class T>
struct Convert<std::unique_ptr<T>> {
  static PyObject* to(std::unique_ptr<T> value) {
    return Convert<std::shared_ptr<T>>::to(std::shared_ptr<T>(std::move(value)));
  }
  static constexpr std::nullptr_t kColumn = nullptr;
};

// Optional, variants, pairs.
template <class T>
struct Convert<std::optional<T>> {
  static std::optional<T> from(PyObject* given, const Place& place) {
    if (given == Py_None) return std::nullopt;
    return Convert<T>::from(given, place);
  }
  static PyObject* to(std::optional<T> value) {
    if (!value) Py_RETURN_NONE;
    return Convert<T>::to(std::move(*value));
  }
  static bool could(PyObject* given) { return given == Py_None || Convert<T>::could(given); }
  static std::string format() {
    if constexpr (std::is_same_v<T, bool>) return "i1";
    if constexpr (std::is_integral_v<T>) return "f8";
    return Convert<T>::kColumn->format();
  }
  static void write(void* row, const void* value) {
    const auto& given = *static_cast<const std::optional<T>*>(value);
    if (!given)
      write_nothing(row);
    else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>)
      *static_cast<double*>(row) = static_cast<double>(*given);
    else
      Convert<T>::kColumn->write(row, &*given);
  }
  static void write_nothing(void* row) {
    if constexpr (std::is_same_v<T, bool>)
      *static_cast<std::int8_t*>(row) = -128;
    else if constexpr (std::is_integral_v<T>)
      *static_cast<double*>(row) = std::numeric_limits<double>::quiet_NaN();
    else
      Convert<T>::kColumn->write_nothing(row);
  }
  static constexpr bool kHas = kIsColumn<T>;
  static constexpr Column make() {
    if constexpr (kHas)
      return {&format, std::is_integral_v<T> && !std::is_same_v<T, bool> ? 8 : Convert<T>::kColumn->size,
              &write, &write_nothing, Convert<T>::kColumn->record};
    else
      return {};
  }
  static constexpr Column kOwn = make();
  static constexpr ColumnOrNone<kHas> column() {
    if constexpr (kHas)
      return &kOwn;
    else
      return nullptr;
  }
  static constexpr ColumnOrNone<kHas> kColumn = column();
};
template <class A, class B>
struct Convert<std::pair<A, B>> {
  static std::pair<A, B> from(PyObject* given, const Place& place) {
    const Reference parts = fast_sequence(given, place);
    if (PyTuple_GET_SIZE(parts.get()) != 2) wrong_type(place, "a pair", given);
    return {Convert<A>::from(PyTuple_GET_ITEM(parts.get(), 0), {&place, nullptr, 0}),
            Convert<B>::from(PyTuple_GET_ITEM(parts.get(), 1), {&place, nullptr, 1})};
  }
  static PyObject* to(const std::pair<A, B>& pair) {
    PyObject* a = Convert<A>::to(pair.first);
    PyObject* b = Convert<B>::to(pair.second);
    PyObject* both = PyTuple_Pack(2, a, b);
    Py_XDECREF(a);
    Py_XDECREF(b);
    return both;
  }
  static bool could(PyObject* given) { return is_sequence(given); }
  static constexpr std::nullptr_t kColumn = nullptr;
};
template <class... A>
struct Convert<std::variant<A...>> {
  using V = std::variant<A...>;
  static V from(PyObject* given, const Place& place) {
    std::optional<V> value;
    ((value || !Convert<A>::could(given) || (value.emplace(Convert<A>::from(given, place)), true)), ...);
    if (!value) wrong_type(place, "one of its kinds", given);
    return std::move(*value);
  }
  static PyObject* to(const V& value) {
    return std::visit(
        [](const auto& x) -> PyObject* { return Convert<std::remove_cvref_t<decltype(x)>>::to(x); }, value);
  }
  static bool could(PyObject* given) { return (Convert<A>::could(given) || ...); }
  static constexpr std::nullptr_t kColumn = nullptr;
};
template <>
struct Convert<std::monostate> {
  static PyObject* to(std::monostate) { Py_RETURN_NONE; }
  static constexpr std::nullptr_t kColumn = nullptr;
};

// Lists. Of numbers and vectors they are arrays.
template <class T>
struct Convert<std::vector<T>> {
  static constexpr bool kNumbers = std::is_arithmetic_v<T>;
  static std::vector<T> from(PyObject* given, const Place& place) {
    std::vector<T> list;
    if constexpr (std::is_floating_point_v<T>) {
      const Py_ssize_t shape[1] = {-1};
      const auto a = doubles_from(given, shape, place);
      list.assign(a.data, a.data + a.size());
    } else if constexpr (kNumbers && !std::is_same_v<T, bool>) {
      const Py_ssize_t shape[1] = {-1};
      const auto a = integers_from(given, shape, place);
      list.reserve(static_cast<std::size_t>(a.size()));
      for (Py_ssize_t i = 0; i < a.size(); ++i) {
        require_range(a.data[i], static_cast<long long>(std::numeric_limits<T>::min()),
                      std::numeric_limits<T>::max(), {&place, nullptr, i});
        list.push_back(static_cast<T>(a.data[i]));
      }
    } else {
      const Reference parts = fast_sequence(given, place);
      const Py_ssize_t n = PyTuple_GET_SIZE(parts.get());
      if constexpr (std::is_default_constructible_v<T> && std::is_move_assignable_v<T> &&
                    !std::is_same_v<T, bool>) {
        list = std::vector<T>(static_cast<std::size_t>(n));
        items_from(parts, place, list.data(), sizeof(T), [](void* item, PyObject* part, const Place& at) {
          *static_cast<T*>(item) = Convert<T>::from(part, at);
        });
      } else {
        list.reserve(static_cast<std::size_t>(n));
        for (Py_ssize_t i = 0; i < n; ++i)
          list.push_back(Convert<T>::from(PyTuple_GET_ITEM(parts.get(), i), {&place, nullptr, i}));
      }
    }
    return list;
  }
  static PyObject* to(const std::vector<T>& list) {
    if constexpr (std::is_same_v<T, bool>) {
      const std::vector<std::uint8_t> flags(list.begin(), list.end());
      const Py_ssize_t shape[1] = {static_cast<Py_ssize_t>(list.size())};
      return numbers_to(flags.data(), "?", shape);
    } else if constexpr (kNumbers) {
      const Py_ssize_t shape[1] = {static_cast<Py_ssize_t>(list.size())};
      return numbers_to(list.data(), NumberColumn<T>::format(), shape);
    } else {
      return list_to(list.data(), list.size(), sizeof(T),
                     [](const void* item) { return Convert<T>::to(*static_cast<const T*>(item)); });
    }
  }
  static bool could(PyObject* given) { return is_sequence(given); }
  static constexpr std::nullptr_t kColumn = nullptr;
};
template <int D>
struct Convert<std::vector<Eigen::Matrix<double, D, 1>>> {  // points: (n, D)
  using V = Eigen::Matrix<double, D, 1>;
  static std::vector<V> from(PyObject* given, const Place& place) {
    const Py_ssize_t shape[2] = {-1, D};
    const auto a = doubles_from(given, shape, place);
    std::vector<V> points(static_cast<std::size_t>(a.rows));
    if (!points.empty()) std::memcpy(points.data(), a.data, points.size() * sizeof(V));
    return points;
  }
  static PyObject* to(const std::vector<V>& points) {
    const Py_ssize_t shape[2] = {static_cast<Py_ssize_t>(points.size()), D};
    return doubles_to(points.empty() ? nullptr : points[0].data(), shape);
  }
  static bool could(PyObject* given) { return is_sequence(given); }
  static constexpr std::nullptr_t kColumn = nullptr;
};
template <class T, std::size_t N>
requires std::is_integral_v<T>
struct Convert<std::vector<std::array<T, N>>> {  // triangles: (n, 3)
  using V = std::array<T, N>;
  static std::vector<V> from(PyObject* given, const Place& place) {
    const Py_ssize_t shape[2] = {-1, N};
    const auto a = integers_from(given, shape, place);
    const std::int64_t* x = a.data;
    std::vector<V> list(static_cast<std::size_t>(a.rows));
    for (std::size_t i = 0; i < list.size(); ++i)
      for (std::size_t j = 0; j < N; ++j, ++x) {
        const Place row{&place, nullptr, static_cast<Py_ssize_t>(i)};
        require_range(*x, static_cast<long long>(std::numeric_limits<T>::min()),
                      std::numeric_limits<T>::max(), {&row, nullptr, static_cast<Py_ssize_t>(j)});
        list[i][j] = static_cast<T>(*x);
      }
    return list;
  }
  static PyObject* to(const std::vector<V>& list) {
    const Py_ssize_t shape[2] = {static_cast<Py_ssize_t>(list.size()), static_cast<Py_ssize_t>(N)};
    return numbers_to(list.data(), NumberColumn<T>::format(), shape);
  }
  static bool could(PyObject* given) { return is_sequence(given); }
  static constexpr std::nullptr_t kColumn = nullptr;
};
template <class T, std::size_t N>
struct Convert<std::array<T, N>> {
  static constexpr bool kDouble = std::is_same_v<T, double>;
  static std::array<T, N> from(PyObject* given, const Place& place) {
    std::array<T, N> result{};
    const Reference parts = fast_sequence(given, place);
    if (PyTuple_GET_SIZE(parts.get()) != static_cast<Py_ssize_t>(N))
      wrong_type(place, ("a sequence of " + std::to_string(N)).c_str(), given);
    for (std::size_t i = 0; i < N; ++i) {
      const auto at = static_cast<Py_ssize_t>(i);
      result[i] = Convert<T>::from(PyTuple_GET_ITEM(parts.get(), at), {&place, nullptr, at});
    }
    return result;
  }
  static PyObject* to(const std::array<T, N>& list) {
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      const Py_ssize_t shape[1] = {static_cast<Py_ssize_t>(N)};
      return numbers_to(list.data(), NumberColumn<T>::format(), shape);
    } else {
      Reference result(PyTuple_New(N));
      for (std::size_t i = 0; i < N; ++i) {
        PyObject* item = Convert<T>::to(list[i]);
        if (!item) throw_raised();
        PyTuple_SET_ITEM(result.get(), static_cast<Py_ssize_t>(i), item);
      }
      return result.release();
    }
  }
  static bool could(PyObject* given) { return is_sequence(given); }
  static std::string format() { return "(" + std::to_string(N) + ",)" + Convert<T>::kColumn->format(); }
  static void write(void* row, const void* value) {
    for (std::size_t i = 0; i < N; ++i)
      Convert<T>::kColumn->write(static_cast<char*>(row) + i * sizeof(T), static_cast<const T*>(value) + i);
  }
  static void write_nothing(void* row) {
    for (std::size_t i = 0; i < N; ++i)
      Convert<T>::kColumn->write_nothing(static_cast<char*>(row) + i * sizeof(T));
  }
  static constexpr Column kOwn{&format, static_cast<Py_ssize_t>(N * sizeof(T)), &write, &write_nothing};
  static constexpr ColumnOrNone<std::is_arithmetic_v<T>> column() {
    if constexpr (std::is_arithmetic_v<T>)
      return &kOwn;
    else
      return nullptr;
  }
  static constexpr ColumnOrNone<std::is_arithmetic_v<T>> kColumn = column();
};
/// Only returned: what it views is copied.
template <class T>
struct Convert<std::span<T>> {
  static PyObject* to(std::span<T> list) {
    using V = std::remove_const_t<T>;
    return Convert<std::vector<V>>::to(std::vector<V>(list.begin(), list.end()));
  }
  static constexpr std::nullptr_t kColumn = nullptr;
};

/// Truth values side by side, which a vector of bool does not have.
struct Flags {
  std::unique_ptr<bool[]> data;
  std::size_t count = 0;
  [[nodiscard]] std::size_t size() const { return count; }
  operator std::span<const bool>() const { return {data.get(), count}; }  // NOLINT: that is what it is for
};
template <>
struct Convert<Flags> {
  static Flags from(PyObject* given, const Place& place) {
    const auto list = Convert<std::vector<bool>>::from(given, place);
    Flags flags{std::make_unique<bool[]>(list.size()), list.size()};
    for (std::size_t i = 0; i < list.size(); ++i) flags.data[i] = list[i];
    return flags;
  }
  static bool could(PyObject* given) { return is_sequence(given); }
};

// Callbacks.
template <class R, class... A>
struct Convert<std::function<R(A...)>> {
  struct Call {
    Callable function;
    R operator()(A... arguments) const {
      const GlobalLock hold;
      const Reference answer = function({Convert<std::remove_cvref_t<A>>::to(arguments)...});
      if constexpr (std::is_same_v<R, bool>) {  // "go on", unless told otherwise
        if (answer.get() == Py_None) return true;
        return Convert<bool>::from(answer.get(), {nullptr, "the callback's answer"});
      } else if constexpr (!std::is_void_v<R>) {
        return Convert<R>::from(answer.get(), {nullptr, "the callback's answer"});
      }
    }
  };
  static std::function<R(A...)> from(PyObject* given, const Place& place) {
    if (given == Py_None) return nullptr;
    if (!PyCallable_Check(given)) wrong_type(place, "a callable", given);
    return Call{Callable(given)};
  }
  static PyObject* to(const std::function<R(A...)>& function) {
    if (const Call* call = function.template target<Call>()) return Py_NewRef(call->function.function());
    if (!function) Py_RETURN_NONE;
    if constexpr ((requires(PyObject * given, const Place& place) {
                    Convert<std::remove_cvref_t<A>>::from(given, place);
                  } &&
                   ...))
      return function_to(own(new std::function(function)), [](void* held, PyObject* arguments) {
        return call(*static_cast<const std::function<R(A...)>*>(held), arguments,
                    std::index_sequence_for<A...>{});
      });
    else
      Py_RETURN_NONE;
  }
  template <std::size_t... I>
  static PyObject* call(const std::function<R(A...)>& function, PyObject* arguments,
                        std::index_sequence<I...>) {
    if (PyTuple_GET_SIZE(arguments) != static_cast<Py_ssize_t>(sizeof...(A)))
      throw WrongType{"takes " + std::to_string(sizeof...(A)) + " arguments"};
    std::tuple<std::remove_cvref_t<A>...> given{
        Convert<std::remove_cvref_t<A>>::from(PyTuple_GET_ITEM(arguments, I), {nullptr, "argument", I})...};
    if constexpr (std::is_void_v<R>) {
      function(std::get<I>(given)...);
      Py_RETURN_NONE;
    } else {
      return Convert<std::remove_cvref_t<R>>::to(function(std::get<I>(given)...));
    }
  }
  static bool could(PyObject* given) { return given == Py_None || PyCallable_Check(given); }
  static constexpr std::nullptr_t kColumn = nullptr;
};

template <class T>
inline constexpr Converter kConverter{
    [](const void* value) -> PyObject* {
      if constexpr (std::is_copy_constructible_v<T>)
        return Convert<T>::to(*static_cast<const T*>(value));
      else
        Py_RETURN_NONE;
    },
    [](void* value, PyObject* given, const Place& place) {
      if constexpr (requires { Convert<T>::from(given, place); } && std::is_move_assignable_v<T>)
        *static_cast<T*>(value) = Convert<T>::from(given, place);
      else
        wrong_type(place, "left out: it comes from C++ only", given);
    },
    Convert<T>::kColumn};

}  // namespace vericone::python
