// SPDX-License-Identifier: BSD-3-Clause
#include "batch.h"

#include "pybind.h"

#include <vericone/geometry/error.h>
#include <atomic>
#include <chrono>
#include <limits>
#include <system_error>
#include <thread>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace vericone::python {
namespace {

/// Questions whose numbers are copied together: they stay in the first cache.
constexpr Py_ssize_t kBlock = 256;

}  // namespace

Many::Many(Given& given, int i, int components)
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
  if (!is_sequence(given) && !py::detail::npy_api::get().PyArray_Check_(given))
    wrong_type(place, ("an array " + wanted).c_str(), given);
  array_ = strict_array(given, place);
  if (!scalar_ && PyList_Check(given) && PyList_GET_SIZE(given) == 0)  // none, of any number of components
    array_ = Reference(py::array_t<double>(std::vector<Py_ssize_t>{0, components_}).release().ptr());
  auto array = as_pybind<py::array>(array_);
  const char kind = array.dtype().kind();
  if ((kind != 'f' && kind != 'i' && kind != 'u') || (kind == 'f' && array.itemsize() > 8))
    throw InputError(place.text(), "an array of " + dtype_name(array),
                     "an array of real numbers that doubles hold exactly");
  const auto dimensions = static_cast<std::size_t>(array.ndim());
  if (!scalar_ && (dimensions == 0 || array.shape(array.ndim() - 1) != components_)) {
    std::string own = "(";
    for (std::size_t d = 0; d < dimensions; ++d)
      own += std::to_string(array.shape(static_cast<Py_ssize_t>(d))) +
             (d + 1 < dimensions || d == 0 ? ", " : "");
    if (dimensions > 1 || own.ends_with(", "))
      own = own.ends_with(", ") ? own.substr(0, own.size() - 1) : own;
    throw Unfit(place.text(), "an array of shape " + own + ")", wanted);
  }
  if (!scalar_ && dimensions == 1) {  // one, of what is no array
    fixed_from(array.ptr(), components_, 1, numbers_, place);
    one_ = numbers_;
    return;
  }
  // Halves, and numbers of another byte order, become doubles first: rare, and exact.
  const py::dtype type = array.dtype();
  if (type.byteorder() == '>' || (kind == 'f' && array.itemsize() == 2) ||
      !(array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_)) {
    array = py::module_::import("numpy").attr("ascontiguousarray")(
        array, kind == 'f' ? py::dtype("f8") : py::dtype(kind == 'i' ? "i8" : "u8"));
    array_ = Reference::to(array.ptr());
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

Many::Many(Given& given, int i, const TypeInfo& info) : name_(given.place(i).name) {
  PyObject* value = given.value(i);
  const Place place = given.place(i);
  if (could_be(value, info)) {
    std::shared_ptr<void> made;
    one_ = object_from(value, info, made, place);
    if (made)
      made_.push_back(std::move(made));
    else
      given.machines.add(value);
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
  array_ = Reference::to(list.ptr());
  for (Py_ssize_t k = 0; k < PyTuple_GET_SIZE(list.ptr()); ++k) {
    std::shared_ptr<void> made;
    objects_.push_back(object_from(PyTuple_GET_ITEM(list.ptr(), k), info, made, {&place, nullptr, k}));
    if (made)
      made_.push_back(std::move(made));
    else
      given.machines.add(PyTuple_GET_ITEM(list.ptr(), k));
  }
  data_ = reinterpret_cast<const char*>(objects_.data());
}

void Many::read_exact(PyObject* given, const Place& place, MakeExact make) {
  constexpr std::size_t kMostAxes = 32;  // as numpy
  if (py::detail::npy_api::get().PyArray_Check_(given)) {
    const auto array = py::reinterpret_borrow<py::array>(given);
    for (Py_ssize_t d = 0; d + 1 < array.ndim(); ++d) shape_.push_back(array.shape(d));
  } else {
    // As deep as the first of the first are sequences.
    Reference at = Reference::to(given);
    while (shape_.size() < kMostAxes) {
      const Reference parts = fast_sequence(at.get(), place);
      const Py_ssize_t n = PyTuple_GET_SIZE(parts.get());
      if (n > 0 && !is_sequence(PyTuple_GET_ITEM(parts.get(), 0))) break;
      shape_.push_back(n);
      if (n == 0) break;
      at = Reference::to(PyTuple_GET_ITEM(parts.get(), 0));
    }
  }
  strides_.resize(shape_.size());
  Py_ssize_t step = sizeof(void*);
  for (std::size_t d = shape_.size(); d-- > 0; step *= shape_[d]) strides_[d] = step;
  add_exact(given, 0, place, make);
  single_ = shape_.empty();
  if (single_) one_ = made_.back().get();
  data_ = reinterpret_cast<const char*>(objects_.data());
}

void Many::add_exact(PyObject* given, std::size_t axis, const Place& place, MakeExact make) {
  if (axis == shape_.size()) {
    made_.push_back(make(given, place));
    objects_.push_back(made_.back().get());
    return;
  }
  const Reference parts = fast_sequence(given, place);
  if (PyTuple_GET_SIZE(parts.get()) != shape_[axis])
    throw InputError(place.text(), std::to_string(PyTuple_GET_SIZE(parts.get())) + " of them",
                     std::to_string(shape_[axis]) + " of them, as in the first: rows equally long");
  for (Py_ssize_t i = 0; i < shape_[axis]; ++i)
    add_exact(PyTuple_GET_ITEM(parts.get(), i), axis + 1, {&place, nullptr, i}, make);
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

namespace {

/// A new array of a column, and where it is.
py::object make_output(const Column* column, std::span<const Py_ssize_t> shape, Output& output) {
  static constinit Imported empty("numpy", "empty"), zeros("numpy", "zeros"), records("numpy", "recarray");
  py::tuple sizes(shape.size());
  for (std::size_t d = 0; d < shape.size(); ++d) sizes[d] = shape[d];
  py::object array;
  if (column->record) {
    // Zeros, since between its fields a row has bytes that nobody writes.
    array = zeros.get()(sizes, as_pybind(record_dtype(*column->record()))).attr("view")(records.get());
    output.size = record_size(*column->record());
  } else {
    array = empty.get()(sizes, column->format());
    output.size = column->size;
  }
  output.data = static_cast<char*>(py::reinterpret_borrow<py::array>(array).mutable_data());
  return array;
}

}  // namespace

PyObject* answer_columns(Given& given, std::span<const Many* const> many,
                         std::initializer_list<const Column*> columns, int threads, Kernel kernel, void* f,
                         Kernel whole) {
  const std::vector<Py_ssize_t> shape = broadcast(many);
  Output outputs[2];
  py::object arrays[2];
  std::size_t n = 0;
  for (const Column* column : columns) {
    arrays[n] = make_output(column, shape, outputs[n]);
    ++n;
  }
  answer_all(given, many, shape, {outputs, n}, threads, kernel, f, whole);
  if (n == 1) return arrays[0].release().ptr();
  return tuple_of({arrays[0].release().ptr(), arrays[1].release().ptr()});
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
      if (in_place(k, dense)) {
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

  /// Whether a dense part has to be copied.
  [[nodiscard]] bool copies() const {
    for (std::size_t k = 0; k < many_.size(); ++k)
      if (!many_[k]->single_ && !in_place(k, true)) return true;
    return false;
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
  /// Whether the kernel reads the numbers of argument k where they are.
  [[nodiscard]] bool in_place(std::size_t k, bool dense) const {
    const Many& m = *many_[k];
    return (m.components_ == 0 || (m.kind_ == 'd' && (m.inner_ == 8 || m.components_ == 1))) && even_[k] &&
           (!dense || single_step_[k] % 8 == 0);
  }
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
        if (step == 3 * sizeof(T) && inner == sizeof(T)) {
          for (Py_ssize_t i = 0; i < 3 * count; ++i) out[i] = static_cast<double>(x[i]);
          return;
        }
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
  Stop own;  // where nobody beyond asks to stop
  const Stop* const outer = stop_of_this_thread();
  const Stop* const heard = outer ? outer : &own;
  std::mutex mutex;
  Py_ssize_t failed_at = walk.count();
  std::exception_ptr failure;

  const auto fail = [&](Py_ssize_t question) {
    const std::lock_guard lock(mutex);
    if (question < failed_at) {
      failed_at = question;
      failure = std::current_exception();
    }
  };
  // Questions first to first + count; false: one failed.
  const auto answer_block = [&](Py_ssize_t first, Py_ssize_t count, std::span<std::vector<double>> room) {
    Part part;
    const auto place_outputs = [&](Py_ssize_t question) {
      for (std::size_t o = 0; o < outputs.size(); ++o) {
        part.out[o] = outputs[o].data + question * outputs[o].size;
        part.out_step[o] = outputs[o].size;
      }
    };
    place_outputs(first);
    Py_ssize_t at = 0;
    try {
      walk.part(first, count, room, part, whole != nullptr);
      (whole ? whole : kernel)(f, part, at);
      return true;
    } catch (const Rounded&) {  // of any of them
    } catch (...) {
      if (!whole) {
        fail(first + at);
        return false;
      }
    }
    for (Py_ssize_t i = first; i < first + count; ++i) {  // again one by one: which question it was
      place_outputs(i);
      try {
        walk.part(i, 1, room, part, true);
        kernel(f, part, at);
      } catch (...) {
        fail(i);
        return false;
      }
    }
    return true;  // each alone is answered
  };
  const Py_ssize_t block = whole && walk.copies() ? kBlock : std::numeric_limits<Py_ssize_t>::max();
  // One thread's work; the caller's looks for signals between its parts. What one raises is returned.
  const auto work = [&](bool watches) {
    std::vector<std::vector<double>> room(many.size());
    // Long parts, of which a processor reads ahead, and yet some for each thread; where a question's cost is
    // not known, parts grow to half a millisecond.
    Py_ssize_t size = whole ? std::clamp<Py_ssize_t>(walk.count() / (8 * threads), 512, 16384) : 16;
    auto looked = std::chrono::steady_clock::now();
    std::optional<py::error_already_set> raised;
    while (!heard->requested()) {
      const Py_ssize_t begin = next.fetch_add(size);
      if (begin >= walk.count()) break;
      const Py_ssize_t end = std::min(begin + size, walk.count());
      const auto started = std::chrono::steady_clock::now();
      Py_ssize_t at = begin;
      while (at < end && answer_block(at, std::min(block, end - at), room)) at += std::min(block, end - at);
      if (at < end) {
        next = walk.count();  // earlier parts are all under way: the first failure of all is found
        break;
      }
      const auto now = std::chrono::steady_clock::now();
      if (!whole) {
        if (now - started < std::chrono::microseconds(500) && size < 8192) size *= 2;
        if (now - started > std::chrono::milliseconds(20) && size > 1) size /= 2;
      }
      if (watches && !outer && now - looked > kBetweenSignals) {
        looked = now;
        const py::gil_scoped_acquire hold;
        if (PyErr_CheckSignals() != 0) {
          raised.emplace();
          own.request();
        }
      }
    }
    return raised;
  };

  std::optional<py::error_already_set> raised;
  {
    const Released quiet;
    const std::lock_guard hold(given.machines);
    // Machines: one call at a time.
    const auto useful = given.machines.none() ? std::clamp<Py_ssize_t>(walk.count(), 1, threads) : 1;
    std::vector<std::jthread> others;
    for (Py_ssize_t t = 1; t < useful; ++t) {
      try {
        others.emplace_back([&] {
          const StopScope scope(heard);
          (void)work(false);
        });
      } catch (const std::system_error&) {
        break;  // the system gives no more: these are enough
      }
    }
    const StopScope scope(heard);
    raised = work(true);
  }
  if (raised) throw std::move(*raised);
  if (heard->requested()) throw Interrupted{};
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
