// SPDX-License-Identifier: BSD-3-Clause
//
// Records as rows of numpy arrays. What a record has no room for makes it no row.
#include "object.h"
#include "pybind.h"

namespace vericone::python {
namespace {

template <class F>
bool each_column(const TypeInfo& info, F&& f) {
  for (const Field& field : info.fields)
    if (!field.converter->column || !f(field.name, *field.converter->column)) return false;
  for (const DerivedColumn& derived : info.derived)
    if (!derived.column || !f(derived.name, *derived.column)) return false;
  return true;
}

Py_ssize_t column_size(const Column& column) {
  return column.record ? record_size(*column.record()) : column.size;
}

}  // namespace

Py_ssize_t record_size(const TypeInfo& info) {
  Py_ssize_t size = 0;
  const bool all = each_column(info, [&](const char*, const Column& column) {
    const Py_ssize_t part = column_size(column);
    size += (part + 7) / 8 * 8;
    return part > 0;
  });
  return all && !info.fields.empty() ? size : 0;
}

Reference record_dtype(const TypeInfo& info) {
  py::list names, formats, offsets;
  Py_ssize_t size = 0;
  each_column(info, [&](const char* name, const Column& column) {
    names.append(name);
    if (column.record)
      formats.append(as_pybind(record_dtype(*column.record())));
    else
      formats.append(column.format());
    offsets.append(size);
    size += (column_size(column) + 7) / 8 * 8;
    return true;
  });
  py::dict description;
  description["names"] = names;
  description["formats"] = formats;
  description["offsets"] = offsets;
  description["itemsize"] = size;
  const py::module_ numpy = py::module_::import("numpy");
  return reference_to(
      numpy.attr("dtype")(py::make_tuple(numpy.attr("record"), numpy.attr("dtype")(description))));
}

void write_record(void* row, const TypeInfo& info, const void* record) {
  auto* at = static_cast<char*>(row);
  for (const Field& field : info.fields) {
    const Column& column = *field.converter->column;
    column.write(at, static_cast<const char*>(record) + field.offset);
    at += (column_size(column) + 7) / 8 * 8;
  }
  for (const DerivedColumn& derived : info.derived) {
    derived.write(at, record);
    at += (column_size(*derived.column) + 7) / 8 * 8;
  }
}

void write_no_record(void* row, const TypeInfo& info) {
  auto* at = static_cast<char*>(row);
  each_column(info, [&](const char*, const Column& column) {
    column.write_nothing(at);
    at += (column_size(column) + 7) / 8 * 8;
    return true;
  });
}

}  // namespace vericone::python
