// SPDX-License-Identifier: BSD-3-Clause
//
// Calls from Python: arguments bound to parameters, overloads chosen, one question or many answered without
// the global lock, and what C++ throws made an exception of Python.
#pragma once

#include <initializer_list>
#include <tuple>

#include "convert.h"

namespace vericone::python {

struct Parameter {
  const char* name;
  bool (*could)(PyObject*);  // null: anything
  bool optional = false, keyword_only = false;
};

class Given;
struct Overload {
  std::span<const Parameter> parameters;
  PyObject* (*call)(Given&);
};

/// The arguments of one call.
class Given {
 public:
  static constexpr int kMost = 40;
  /// Of the object itself; of a function about many objects `self` may be a sequence of them.
  PyObject* self = nullptr;
  bool long_work = false;  // may take more than a few tenths of a second: can be interrupted

  [[nodiscard]] bool has(int i) const { return values_[i] != nullptr; }
  [[nodiscard]] PyObject* value(int i) const { return i < 0 ? self : values_[i]; }  // -1: self
  [[nodiscard]] Place place(int i) const { return {nullptr, i < 0 ? "self" : parameters_[i].name}; }

  template <class T>
  [[nodiscard]] T get(int i) const {
    return Convert<T>::from(values_[i], place(i));
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

  /// Binds; false where they do not fit these parameters, and `why` says it.
  bool bind(std::span<const Parameter> parameters, PyObject* const* positional, Py_ssize_t n, PyObject* names,
            PyObject* const* named, std::string& why);

  /// What was made of arguments that stand for others.
  [[nodiscard]] std::vector<std::shared_ptr<void>>& made() { return made_; }

 private:
  [[nodiscard]] void* object(int i, const TypeInfo& info);

  std::span<const Parameter> parameters_;
  PyObject* values_[kMost] = {};
  std::vector<std::shared_ptr<void>> made_;
};

/// `name`, for messages. The vectorcall convention of methods.
PyObject* call(const char* name, std::span<const Overload> overloads, PyObject* self,
               PyObject* const* arguments, Py_ssize_t n, PyObject* names) noexcept;
/// As call(), of a tuple and a dictionary.
PyObject* construct(const char* name, std::span<const Overload> overloads, PyTypeObject* type,
                    PyObject* arguments, PyObject* named) noexcept;
/// A record from the values of its fields, in their order or by name.
PyObject* construct_record(const TypeInfo& info, PyObject* arguments, PyObject* named) noexcept;
/// A method about many objects: the first argument is the object, or a list of them.
PyObject* call_many(const char* name, std::span<const Overload> overloads, PyObject* const* arguments,
                    Py_ssize_t n, PyObject* names) noexcept;
/// What is being thrown, as an exception of Python; returns null.
PyObject* raise_current(const std::string& at = {}) noexcept;

/// The global lock is released, and a machine is locked, as long as this lives.
class Quiet {
 public:
  explicit Quiet(PyObject* self);
  ~Quiet();
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  std::recursive_mutex* lock_ = nullptr;
  PyThreadState* state_;
};

/// Runs `work` in a thread of its own while this one waits for it and for signals: what a signal raises is
/// thrown here, once `work` has heard of it and ended. For work in the main thread; elsewhere it is run at
/// once.
void run_interruptibly(PyObject* self, const std::function<void()>& work);

template <class F>
auto run(Given& given, F&& f) {
  const Quiet quiet(given.self);
  return std::remove_cvref_t<std::invoke_result_t<F>>(f());
}
/// Of work that may take long.
template <class F>
auto run_long(Given& given, F&& f) {
  using R = std::remove_cvref_t<std::invoke_result_t<F>>;
  if constexpr (std::is_void_v<R>) {
    run_interruptibly(given.self, f);
  } else {
    std::optional<R> result;
    run_interruptibly(given.self, [&] { result.emplace(f()); });
    return std::move(*result);
  }
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

// Many questions at once ------------------------------------------------------------------------------------

/// An argument that may be one or many: numbers (a scalar, a vector) or objects.
class Many {
 public:
  /// Numbers: `components` of one (0: a scalar).
  Many(const Given& given, int i, int components);
  /// Objects of a type.
  Many(const Given& given, int i, const TypeInfo& info);
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
  void read_numbers(PyObject* given, const Place& place);

  bool single_ = true;
  const char* name_;
  int components_ = 0;  // doubles; 0: objects
  bool scalar_ = false;
  double numbers_[16] = {};
  const void* one_ = nullptr;
  std::vector<Py_ssize_t> shape_, strides_;  // of the questions; bytes
  py::object array_;
  const char* data_ = nullptr;
  Py_ssize_t inner_ = 8;  // bytes between the numbers of one
  char kind_ = 'd';       // struct code
  std::vector<void*> objects_;
  std::vector<std::shared_ptr<void>> made_;
};

/// A part of the questions, as a kernel sees it: in[k] + i * step[k] is argument k of question i.
struct Part {
  Py_ssize_t count = 0;
  const char* in[8] = {};
  Py_ssize_t step[8] = {};
  char* out[2] = {};
};
/// Answers the questions of a part; `at` is the one under way when it throws.
using Kernel = void (*)(void* f, const Part& part, Py_ssize_t& at);

struct Output {
  Py_ssize_t size = 0;
  py::object array;
  char* data = nullptr;
};
[[nodiscard]] Output make_output(const Column* column, std::span<const Py_ssize_t> shape);
[[nodiscard]] std::vector<Py_ssize_t> broadcast(std::span<const Many* const> many);
void answer_all(Given& given, std::span<const Many* const> many, std::span<const Py_ssize_t> shape,
                std::span<const Output> outputs, int threads, Kernel kernel, void* f, Kernel whole = nullptr);
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
  static_assert(sizeof...(E) == sizeof...(M));
  using R = std::remove_cvref_t<std::invoke_result_t<F, decltype(load<E>(nullptr))...>>;
  if ((m.single() && ...)) return to_python(run(given, [&]() -> R { return f(one<E>(m)...); }));
  const Many* all[] = {&m...};
  const std::vector<Py_ssize_t> shape = broadcast(all);
  using Function = std::remove_reference_t<F>;
  const Output outputs[] = {make_output(Convert<R>::kColumn, shape)};
  const Kernel kernel = [](void* function, const Part& part, Py_ssize_t& at) {
    const Py_ssize_t size = part.step[7];
    for (at = 0; at < part.count; ++at) {
      [&]<std::size_t... K>(std::index_sequence<K...>) {
        const R result = (*static_cast<Function*>(function))(load<E>(part.in[K] + at * part.step[K])...);
        Convert<R>::kColumn->write(part.out[0] + at * size, &result);
      }
      (std::index_sequence_for<E...>{});
    }
  };
  answer_all(given, all, shape, outputs, threads, kernel, &f);
  return outputs[0].array.inc_ref().ptr();
}

/// As answer(), where the answers are no columns of numbers: an array of objects.
template <class... E, class F, class... M>
PyObject* answer_objects(Given& given, int threads, F&& f, const M&... m) {
  using R = std::remove_cvref_t<std::invoke_result_t<F, decltype(load<E>(nullptr))...>>;
  if ((m.single() && ...)) return to_python(run(given, [&]() -> R { return f(one<E>(m)...); }));
  const Many* all[] = {&m...};
  const std::vector<Py_ssize_t> shape = broadcast(all);
  using Function = std::remove_reference_t<F>;
  Py_ssize_t count = 1;
  for (const Py_ssize_t n : shape) count *= n;
  std::vector<std::optional<R>> results(static_cast<std::size_t>(count));
  Output output;
  output.size = sizeof(std::optional<R>);
  output.data = reinterpret_cast<char*>(results.data());
  const Output outputs[] = {output};
  const Kernel kernel = [](void* function, const Part& part, Py_ssize_t& at) {
    for (at = 0; at < part.count; ++at) [&]<std::size_t... K>(std::index_sequence<K...>) {
        reinterpret_cast<std::optional<R>*>(part.out[0])[at].emplace(
            (*static_cast<Function*>(function))(load<E>(part.in[K] + at * part.step[K])...));
      }
    (std::index_sequence_for<E...>{});
  };
  answer_all(given, all, shape, outputs, threads, kernel, &f);
  return objects_of(
      shape, [&](Py_ssize_t i) { return Convert<R>::to(std::move(*results[static_cast<std::size_t>(i)])); });
}

/// Of work that may take long.
template <class... E, class F, class... M>
PyObject* answer_long(Given& given, int threads, F&& f, const M&... m) {
  if ((m.single() && ...)) return to_python(run_long(given, [&] { return f(one<E>(m)...); }));
  return answer<E...>(given, threads, std::forward<F>(f), m...);
}
template <class... E, class F, class... M>
PyObject* answer_objects_long(Given& given, int threads, F&& f, const M&... m) {
  if ((m.single() && ...)) return to_python(run_long(given, [&] { return f(one<E>(m)...); }));
  return answer_objects<E...>(given, threads, std::forward<F>(f), m...);
}

/// As answer(), of f(argument..., X&) that fills in an X as well (a rung): both are returned.
template <class X, class... E, class F, class... M>
PyObject* answer_with(Given& given, int threads, F&& f, const M&... m) {
  using R = std::remove_cvref_t<std::invoke_result_t<F, decltype(load<E>(nullptr))..., X&>>;
  if ((m.single() && ...)) {
    X more{};
    R result = run(given, [&]() -> R { return f(one<E>(m)..., more); });
    return tuple_of({to_python(std::move(result)), to_python(more)});
  }
  const Many* all[] = {&m...};
  const std::vector<Py_ssize_t> shape = broadcast(all);
  using Function = std::remove_reference_t<F>;
  if constexpr (Convert<R>::kColumn != nullptr && Convert<X>::kColumn != nullptr) {
    const Output outputs[] = {make_output(Convert<R>::kColumn, shape),
                              make_output(Convert<X>::kColumn, shape)};
    const Kernel kernel = [](void* function, const Part& part, Py_ssize_t& at) {
      const Py_ssize_t size = part.step[7], more_size = part.step[6];
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
    answer_all(given, all, shape, outputs, threads, kernel, &f);
    return tuple_of({outputs[0].array.inc_ref().ptr(), outputs[1].array.inc_ref().ptr()});
  } else {
    throw WrongType{"many at once is not possible here with what is filled in; ask one by one"};
  }
}

/// As answer(), where C++ has a call of its own for many vectors: whole(span of vectors, span of answers).
template <class V, class F, class G>
PyObject* answer_whole(Given& given, int threads, F&& f, G&& whole, const Many& m) {
  using R = std::remove_cvref_t<std::invoke_result_t<F, const V&>>;
  if (m.single()) return answer<V>(given, threads, f, m);
  struct Both {
    std::remove_reference_t<F>* f;
    std::remove_reference_t<G>* whole;
  } both{&f, &whole};
  const Many* all[] = {&m};
  const std::vector<Py_ssize_t> shape = broadcast(all);
  const Output outputs[] = {make_output(Convert<R>::kColumn, shape)};
  const Kernel each = [](void* function, const Part& part, Py_ssize_t& at) {
    for (at = 0; at < part.count; ++at)
      reinterpret_cast<R*>(part.out[0])[at] =
          (*static_cast<Both*>(function)->f)(load<V>(part.in[0] + at * part.step[0]));
  };
  const Kernel at_once = [](void* function, const Part& part, Py_ssize_t&) {
    (*static_cast<Both*>(function)->whole)(
        std::span<const V>(reinterpret_cast<const V*>(part.in[0]), static_cast<std::size_t>(part.count)),
        std::span<R>(reinterpret_cast<R*>(part.out[0]), static_cast<std::size_t>(part.count)));
  };
  answer_all(given, all, shape, outputs, threads, each, &both, at_once);
  return outputs[0].array.inc_ref().ptr();
}

}  // namespace vericone::python
