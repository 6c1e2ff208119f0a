// SPDX-License-Identifier: BSD-3-Clause
//
// Many questions at once: arguments that broadcast, parts of them for threads, answers in columns.
#pragma once

#include "call.h"

namespace vericone::python {

/// An argument that may be one or many: numbers (a scalar, a vector) or objects.
class Many {
 public:
  /// Numbers: `components` of one (0: a scalar).
  Many(Given& given, int i, int components);
  /// Objects of a type.
  Many(Given& given, int i, const TypeInfo& info);
  /// Exact vectors: sequences of N numbers, within as many sequences as there are axes.
  template <std::size_t N>
  Many(Given& given, int i, const std::array<Rational, N>*) : name_(given.place(i).name) {
    using V = std::array<Rational, N>;
    read_exact(given.value(i), given.place(i), [](PyObject* vector, const Place& place) {
      return own(new V(Convert<V>::from(vector, place)));
    });
  }
  /// One, where nothing is given: a number, or a vector that outlives this.
  Many(const char* name, double number) : name_(name), components_(1), scalar_(true) {
    numbers_[0] = number;
    one_ = numbers_;
  }
  template <int N>
  Many(const char* name, const Eigen::Matrix<double, N, 1>* vector) : name_(name), components_(N) {
    std::memcpy(numbers_, vector->data(), sizeof(double) * N);
    one_ = numbers_;
  }
  /// One object, which outlives this.
  template <class T>
  Many(const char* name, const T* object) : name_(name), one_(object) {}
  Many(const Many&) = delete;
  Many& operator=(const Many&) = delete;

  [[nodiscard]] bool single() const { return single_; }
  [[nodiscard]] const std::vector<Py_ssize_t>& shape() const { return shape_; }
  [[nodiscard]] const void* one() const { return one_; }
  [[nodiscard]] const char* name() const { return name_; }
  [[nodiscard]] bool scalar() const { return scalar_; }

 private:
  friend class Walk;
  using MakeExact = std::shared_ptr<void> (*)(PyObject* vector, const Place& place);
  void read_numbers(PyObject* given, const Place& place);
  void read_exact(PyObject* given, const Place& place, MakeExact make);
  void add_exact(PyObject* given, std::size_t axis, const Place& place, MakeExact make);

  bool single_ = true;
  const char* name_;
  int components_ = 0;  // doubles; 0: objects
  bool scalar_ = false;
  double numbers_[16] = {};
  const void* one_ = nullptr;
  std::vector<Py_ssize_t> shape_, strides_;  // of the questions; bytes
  Reference array_;
  const char* data_ = nullptr;
  Py_ssize_t inner_ = 8;  // bytes between the numbers of one
  char kind_ = 'd';       // struct code
  std::vector<void*> objects_;
  std::vector<std::shared_ptr<void>> made_;
};

/// Arguments that may be many, of one call.
inline constexpr int kMostMany = 12;

/// A part of the questions, as a kernel sees it: in[k] + i * step[k] is argument k of question i.
struct Part {
  Py_ssize_t count = 0;
  const char* in[kMostMany] = {};
  Py_ssize_t step[kMostMany] = {};
  char* out[2] = {};
  Py_ssize_t out_step[2] = {};
};
/// Answers the questions of a part; `at` is the one under way when it throws.
using Kernel = void (*)(void* f, const Part& part, Py_ssize_t& at);

/// Where answers go: the first of `size` bytes each.
struct Output {
  Py_ssize_t size = 0;
  char* data = nullptr;
};
[[nodiscard]] std::vector<Py_ssize_t> broadcast(std::span<const Many* const> many);
/// Answers all questions, by `whole` (numbers side by side) where it is given.
void answer_all(Given& given, std::span<const Many* const> many, std::span<const Py_ssize_t> shape,
                std::span<const Output> outputs, int threads, Kernel kernel, void* f, Kernel whole = nullptr);
/// As answer_all(), to new arrays of these columns: one, or a tuple of two.
[[nodiscard]] PyObject* answer_columns(Given& given, std::span<const Many* const> many,
                                       std::initializer_list<const Column*> columns, int threads,
                                       Kernel kernel, void* f, Kernel whole = nullptr);
[[nodiscard]] PyObject* objects_of(std::span<const Py_ssize_t> shape,
                                   const std::function<PyObject*(Py_ssize_t)>& item);

template <class E>
decltype(auto) load(const char* at) {
  if constexpr (requires { typename E::Object; })
    return static_cast<const typename E::Object&>(**reinterpret_cast<typename E::Object* const*>(at));
  else if constexpr (alignof(E) <= 8)
    return *reinterpret_cast<const E*>(at);
  else {
    E value;
    std::memcpy(&value, at, sizeof(E));
    return value;
  }
}
template <class T>
struct ObjectOf {
  using Object = T;
};
template <class E>
decltype(auto) one(const Many& many) {
  if constexpr (requires { typename E::Object; })
    return *static_cast<const typename E::Object*>(many.one());
  else
    return load<E>(static_cast<const char*>(many.one()));
}

/// Answers f(argument...) of one question or of all that the arguments broadcast to. E...: the type of each.
template <class... E, class F, class... M>
PyObject* answer(Given& given, int threads, F&& f, const M&... m) {
  static_assert(sizeof...(E) == sizeof...(M) && sizeof...(M) <= kMostMany);
  using R = std::remove_cvref_t<std::invoke_result_t<F, decltype(load<E>(nullptr))...>>;
  if ((m.single() && ...)) return to_python(run(given, [&]() -> R { return f(one<E>(m)...); }));
  const Many* all[] = {&m...};
  using Function = std::remove_reference_t<F>;
  const Kernel kernel = [](void* function, const Part& part, Py_ssize_t& at) {
    const Py_ssize_t size = part.out_step[0];
    for (at = 0; at < part.count; ++at) {
      [&]<std::size_t... K>(std::index_sequence<K...>) {
        const R result = (*static_cast<Function*>(function))(load<E>(part.in[K] + at * part.step[K])...);
        Convert<R>::kColumn->write(part.out[0] + at * size, &result);
      }
      (std::index_sequence_for<E...>{});
    }
  };
  return answer_columns(given, all, {Convert<R>::kColumn}, threads, kernel, &f);
}

/// As answer(), where the answers are no columns of numbers: an array of objects.
template <class... E, class F, class... M>
PyObject* answer_objects(Given& given, int threads, F&& f, const M&... m) {
  static_assert(sizeof...(E) == sizeof...(M) && sizeof...(M) <= kMostMany);
  using R = std::remove_cvref_t<std::invoke_result_t<F, decltype(load<E>(nullptr))...>>;
  if ((m.single() && ...)) return to_python(run(given, [&]() -> R { return f(one<E>(m)...); }));
  const Many* all[] = {&m...};
  const std::vector<Py_ssize_t> shape = broadcast(all);
  using Function = std::remove_reference_t<F>;
  Py_ssize_t count = 1;
  for (const Py_ssize_t n : shape) count *= n;
  std::vector<std::optional<R>> results(static_cast<std::size_t>(count));
  const Output output{sizeof(std::optional<R>), reinterpret_cast<char*>(results.data())};
  const Kernel kernel = [](void* function, const Part& part, Py_ssize_t& at) {
    for (at = 0; at < part.count; ++at) [&]<std::size_t... K>(std::index_sequence<K...>) {
        reinterpret_cast<std::optional<R>*>(part.out[0])[at].emplace(
            (*static_cast<Function*>(function))(load<E>(part.in[K] + at * part.step[K])...));
      }
    (std::index_sequence_for<E...>{});
  };
  answer_all(given, all, shape, {&output, 1}, threads, kernel, &f);
  return objects_of(
      shape, [&](Py_ssize_t i) { return Convert<R>::to(std::move(*results[static_cast<std::size_t>(i)])); });
}

/// As answer(), of f(argument..., X&) that fills in an X as well (a rung): both are returned.
template <class X, class... E, class F, class... M>
PyObject* answer_with(Given& given, int threads, F&& f, const M&... m) {
  static_assert(sizeof...(E) == sizeof...(M) && sizeof...(M) <= kMostMany);
  using R = std::remove_cvref_t<std::invoke_result_t<F, decltype(load<E>(nullptr))..., X&>>;
  if ((m.single() && ...)) {
    X more{};
    R result = run(given, [&]() -> R { return f(one<E>(m)..., more); });
    return tuple_of({to_python(std::move(result)), to_python(more)});
  }
  if constexpr (kIsColumn<R> && kIsColumn<X>) {
    const Many* all[] = {&m...};
    using Function = std::remove_reference_t<F>;
    const Kernel kernel = [](void* function, const Part& part, Py_ssize_t& at) {
      const Py_ssize_t size = part.out_step[0], more_size = part.out_step[1];
      for (at = 0; at < part.count; ++at) {
        [&]<std::size_t... K>(std::index_sequence<K...>) {
          X more{};
          const R result =
              (*static_cast<Function*>(function))(load<E>(part.in[K] + at * part.step[K])..., more);
          Convert<R>::kColumn->write(part.out[0] + at * size, &result);
          Convert<X>::kColumn->write(part.out[1] + at * more_size, &more);
        }
        (std::index_sequence_for<E...>{});
      }
    };
    return answer_columns(given, all, {Convert<R>::kColumn, Convert<X>::kColumn}, threads, kernel, &f);
  } else {
    throw WrongType{"many at once is not possible here with what is filled in; ask one by one"};
  }
}

/// As answer(), where C++ has a call of its own for many vectors: whole(first, doubles
/// to the next, span of answers).
template <class V, class F, class G>
PyObject* answer_whole(Given& given, int threads, F&& f, G&& whole, const Many& m) {
  using R = std::remove_cvref_t<std::invoke_result_t<F, const V&>>;
  if (m.single()) return answer<V>(given, threads, f, m);
  struct Both {
    std::remove_reference_t<F>* f;
    std::remove_reference_t<G>* whole;
  } both{&f, &whole};
  const Many* all[] = {&m};
  const Kernel each = [](void* function, const Part& part, Py_ssize_t& at) {
    for (at = 0; at < part.count; ++at)
      reinterpret_cast<R*>(part.out[0])[at] =
          (*static_cast<Both*>(function)->f)(load<V>(part.in[0] + at * part.step[0]));
  };
  const Kernel at_once = [](void* function, const Part& part, Py_ssize_t&) {
    const auto count = static_cast<std::size_t>(part.count);
    (*static_cast<Both*>(function)->whole)(reinterpret_cast<const double*>(part.in[0]), part.step[0] / 8,
                                           std::span<R>(reinterpret_cast<R*>(part.out[0]), count));
  };
  return answer_columns(given, all, {Convert<R>::kColumn}, threads, each, &both, at_once);
}

}  // namespace vericone::python
