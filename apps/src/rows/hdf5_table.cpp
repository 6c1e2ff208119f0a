// SPDX-License-Identifier: BSD-3-Clause
#include "rows/hdf5_table.h"

#include <hdf5.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "json/plain_text.h"
#include "rows/csv_rows.h"

namespace vericone::rows {
namespace {

constexpr unsigned kPacking = 4;  // of zlib's 9
constexpr const char *kVersion = "vericone-rows", *kComments = "comments", *kColumns = "columns",
                     *kName = "name";

/// What the library hands out, given back by the function for its kind.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id < 0) throw std::runtime_error("HDF5: a call failed");
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: what all its functions take

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void require(herr_t status) {
  if (status < 0) throw std::runtime_error("HDF5: a call failed");
}

Handle text_type(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(length, 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

void write_text(hid_t object, const char* name, const std::string& text) {
  const Handle type = text_type(text.size()), space(H5Screate(H5S_SCALAR), H5Sclose),
               attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  require(H5Awrite(attribute, type, text.empty() ? "\0" : text.c_str()));
}

std::string read_text(hid_t object, const char* name) {
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose),
      type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  const std::size_t length = H5Tget_size(type);
  if (H5Sget_simple_extent_npoints(space) != 1 || length > kLongestComments ||
      H5Tequal(type, text_type(length)) <= 0)
    throw std::runtime_error(std::string("another attribute ") + name);
  std::string text(length, '\0');
  require(H5Aread(attribute, type, text.data()));
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

constexpr const char* kEmptyWord = "(empty)";  // one without a sign cannot be in an enumeration

/// Of a column's cells, in memory (numbers of both kinds are doubles there) or in the file.
Handle type_of(const ColumnKind& column, bool in_file) {
  if (column.cell == Cell::text) return text_type(column.width);
  if (column.cell == Cell::whole && in_file) return {H5Tcopy(H5T_STD_I64LE), H5Tclose};
  if (column.cell != Cell::word) return {H5Tcopy(in_file ? H5T_IEEE_F64LE : H5T_NATIVE_DOUBLE), H5Tclose};
  Handle type(H5Tenum_create(H5T_STD_U16LE), H5Tclose);
  for (std::size_t i = 0; i < column.words.size(); ++i) {
    const std::array<unsigned char, 2> value{static_cast<unsigned char>(i & 255),
                                             static_cast<unsigned char>(i >> 8)};
    require(
        H5Tenum_insert(type, column.words[i].empty() ? kEmptyWord : column.words[i].c_str(), value.data()));
  }
  return in_file ? std::move(type) : Handle(H5Tget_native_type(type, H5T_DIR_ASCEND), H5Tclose);
}

/// Data sets are called by their number and have the column's name beside them: a name may have any sign.
std::string dataset_of(std::size_t column) { return "column" + std::to_string(column); }

/// The rows [first, first + count) of a data set's space.
Handle selected(hid_t dataset, hsize_t first, hsize_t count) {
  Handle space(H5Dget_space(dataset), H5Sclose);
  require(H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &count, nullptr));
  return space;
}

/// A form in which what stands beside the rows has check sums, as zlib's rows have.
Handle with_sums() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  require(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110));
  return access;
}

/// Without a cache: pieces are read and written whole, and there may be many columns.
Handle without_cache() {
  Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  require(H5Pset_chunk_cache(access, 0, 0, 0));
  return access;
}

const void* data_of(const ColumnKind& column, const Cells& cells) {
  if (column.cell == Cell::text) return cells.text.data();
  return column.cell == Cell::word ? static_cast<const void*>(cells.words.data()) : cells.numbers.data();
}

}  // namespace

std::size_t bytes_of(const std::vector<ColumnKind>& columns) {
  std::size_t bytes = 0;
  for (const ColumnKind& column : columns)
    bytes += column.cell == Cell::text ? column.width : column.cell == Cell::word ? 2 : 8;
  return bytes;
}

struct Hdf5Writer::File {
  std::string name;
  Handle file;
  std::vector<ColumnKind> columns;
  std::vector<Handle> types, sets;
  hsize_t rows = 0;
};

namespace {

/// Lets the file go as it is: the library crashes where it closes what it could not write.
template <typename File>
[[noreturn]] void not_written(const std::string& name, std::unique_ptr<File>& file) {
  const int error = errno;
  static_cast<void>(file.release());
  throw std::runtime_error("could not write " + plain_text(name) +
                           (error ? std::string(": ") + std::strerror(error) : std::string()));
}

}  // namespace

Hdf5Writer::Hdf5Writer(const std::string& file, const std::string& comments,
                       std::vector<ColumnKind> columns) {
  // The library's own end would close what was let go: it is not called.
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  errno = 0;
  try {
    file_ = std::make_unique<File>(
        File{file,
             {H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, with_sums()), H5Fclose},
             std::move(columns),
             {},
             {}});
    write_text(file_->file, kVersion, "1");
    write_text(file_->file, kComments, comments);
    write_text(file_->file, kColumns, std::to_string(file_->columns.size()));
    const hsize_t none = 0, any = H5S_UNLIMITED, chunk = kBlock;
    const Handle space(H5Screate_simple(1, &none, &any), H5Sclose),
        how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose), access = without_cache();
    require(H5Pset_chunk(how, 1, &chunk));
    require(H5Pset_shuffle(how));
    require(H5Pset_deflate(how, kPacking));
    // Without times, so that the same table gives the same bytes.
    require(H5Pset_obj_track_times(how, false));
    for (std::size_t k = 0; k < file_->columns.size(); ++k) {
      const ColumnKind& column = file_->columns[k];
      file_->types.push_back(type_of(column, false));
      file_->sets.emplace_back(H5Dcreate2(file_->file, dataset_of(k).c_str(), type_of(column, true), space,
                                          H5P_DEFAULT, how, access),
                               H5Dclose);
      write_text(file_->sets.back(), kName, column.name);
    }
  } catch (const std::runtime_error&) {
    not_written(file, file_);
  }
}

Hdf5Writer::~Hdf5Writer() = default;

void Hdf5Writer::append(const std::vector<Cells>& columns, std::size_t rows) try {
  errno = 0;
  const hsize_t first = file_->rows, more = rows;
  file_->rows += more;
  const Handle memory(H5Screate_simple(1, &more, nullptr), H5Sclose);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    require(H5Dset_extent(file_->sets[k], &file_->rows));
    const Handle space = selected(file_->sets[k], first, more);
    require(H5Dwrite(file_->sets[k], file_->types[k], memory, space, H5P_DEFAULT,
                     data_of(file_->columns[k], columns[k])));
  }
} catch (const std::runtime_error&) {
  not_written(file_->name, file_);
}

void Hdf5Writer::close() {
  errno = 0;
  if (H5Fflush(file_->file, H5F_SCOPE_LOCAL) < 0) not_written(file_->name, file_);
  file_.reset();
}

struct Hdf5Reader::File {
  std::string name;
  Handle file;
  std::string comments;
  std::vector<ColumnKind> columns;
  std::vector<Handle> types, sets;
  hsize_t rows = 0;
};

namespace {

ColumnKind kind_of(hid_t dataset) {
  ColumnKind column{read_text(dataset, kName)};
  const Handle type(H5Dget_type(dataset), H5Tclose);
  switch (H5Tget_class(type)) {
    case H5T_INTEGER:
      break;
    case H5T_FLOAT:
      column.cell = Cell::number;
      break;
    case H5T_STRING:
      column.cell = Cell::text;
      column.width = H5Tget_size(type);
      break;
    case H5T_ENUM:
      column.cell = Cell::word;
      for (int i = 0; i < H5Tget_nmembers(type); ++i) {
        char* const word = H5Tget_member_name(type, unsigned(i));
        if (!word) throw std::runtime_error("a word that cannot be read");
        column.words.emplace_back(word);
        H5free_memory(word);
        if (column.words.back() == kEmptyWord) column.words.back().clear();
        if (!is_cell(column.words.back())) throw std::runtime_error("a word that is no cell of a table");
      }
      break;
    default:
      throw std::runtime_error("another type");
  }
  if (H5Tequal(type, type_of(column, true)) <= 0) throw std::runtime_error("another type");
  return column;
}

/// In pieces as Hdf5Writer packs them, all of them there: a file that says so of more rows is not believed.
hsize_t rows_of(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose), how(H5Dget_create_plist(dataset), H5Pclose);
  hsize_t rows = 0, chunk = 0, pieces = 0;
  if (H5Sget_simple_extent_ndims(space) != 1 || H5Sget_simple_extent_dims(space, &rows, nullptr) != 1 ||
      H5Pget_layout(how) != H5D_CHUNKED || H5Pget_chunk(how, 1, &chunk) != 1 || chunk != kBlock)
    throw std::runtime_error("rows in another arrangement");
  if (H5Dget_num_chunks(dataset, space, &pieces) < 0 || pieces != rows / kBlock + (rows % kBlock != 0))
    throw std::runtime_error("rows that are missing");
  return rows;
}

void check_comments(const std::string& comments) {
  std::size_t at = 0;
  while (at < comments.size()) {
    const std::size_t end = comments.find('\n', at);
    if (end == std::string::npos || comments[at] != '#' || !is_utf8(comments.substr(at, end - at)) ||
        has_control_characters(comments.substr(at, end - at)))
      throw std::runtime_error("other comments");
    at = end + 1;
  }
}

}  // namespace

Hdf5Reader::Hdf5Reader(const std::string& file) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  std::string where;
  const auto refuse = [&](const std::string& got) {
    throw InputError(plain_text(file) + where, got, "a table that vericone-rows wrote");
  };
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (opened < 0) refuse("an HDF5 file that is cut off or damaged");
  try {
    file_ = std::make_unique<File>(File{file, {opened, H5Fclose}, {}, {}, {}, {}});
    if (H5Aexists(opened, kVersion) <= 0 || read_text(opened, kVersion) != "1")
      throw std::runtime_error("another HDF5 file");
    file_->comments = read_text(opened, kComments);
    check_comments(file_->comments);
    const std::string columns = read_text(opened, kColumns);
    std::size_t count = 0;
    if (std::from_chars(columns.data(), columns.data() + columns.size(), count).ec != std::errc() ||
        std::to_string(count) != columns)
      throw std::runtime_error("another number of columns");
    const Handle access = without_cache();
    std::vector<std::string> names;
    for (std::size_t k = 0; k < count; ++k) {
      where = ": " + dataset_of(k);
      file_->sets.emplace_back(H5Dopen2(opened, dataset_of(k).c_str(), access), H5Dclose);
      file_->columns.push_back(kind_of(file_->sets.back()));
      file_->types.push_back(type_of(file_->columns.back(), false));
      names.push_back(file_->columns.back().name);
      const hsize_t rows = rows_of(file_->sets.back());
      if (k > 0 && rows != file_->rows) throw std::runtime_error("another number of rows");
      if (bytes_of(file_->columns) > kLongestRow) throw std::runtime_error("rows that are too long");
      file_->rows = rows;
    }
    where.clear();
    if (!are_names(names)) throw std::runtime_error("a column without a name of its own");
  } catch (const std::exception& error) {
    refuse(error.what());
  }
}

Hdf5Reader::~Hdf5Reader() = default;
std::uint64_t Hdf5Reader::rows() const { return file_->rows; }
const std::string& Hdf5Reader::comments() const { return file_->comments; }
const std::vector<ColumnKind>& Hdf5Reader::columns() const { return file_->columns; }

std::vector<Cells> Hdf5Reader::read(std::uint64_t first) const {
  const hsize_t n = std::min<hsize_t>(kBlock, file_->rows - first);
  const Handle memory(H5Screate_simple(1, &n, nullptr), H5Sclose);
  std::vector<Cells> all(file_->columns.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const ColumnKind& column = file_->columns[k];
    const auto refuse = [&](const std::string& got) {
      throw InputError(plain_text(file_->name) + ": column " + plain_text(column.name) + ", rows " +
                           std::to_string(first + 1) + " to " + std::to_string(first + n),
                       got, "as vericone-rows wrote them");
    };
    Cells& cells = all[k];
    void* to = nullptr;
    if (column.cell == Cell::text) {
      cells.text.resize(n * column.width);
      to = cells.text.data();
    } else if (column.cell == Cell::word) {
      cells.words.resize(n);
      to = cells.words.data();
    } else {
      cells.numbers.resize(n);
      to = cells.numbers.data();
    }
    const Handle space = selected(file_->sets[k], first, n);
    if (H5Dread(file_->sets[k], file_->types[k], memory, space, H5P_DEFAULT, to) < 0)
      refuse("bytes that cannot be unpacked");
    for (const std::uint16_t word : cells.words)
      if (word >= column.words.size()) refuse("a word that is none of the column's");
    if (column.cell == Cell::whole)
      for (const double x : cells.numbers)
        if (!(std::abs(x) < 0x1p53)) refuse("whole numbers of 2^53 and more");
  }
  return all;
}

bool is_hdf5(const std::string& file) {
  constexpr std::array<char, 8> kSignature{'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
  std::array<char, 8> begin{};
  std::ifstream in(file, std::ios::binary);
  return in.read(begin.data(), begin.size()) && begin == kSignature;
}

}  // namespace vericone::rows
