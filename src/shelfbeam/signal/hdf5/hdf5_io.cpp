#include "shelfbeam/signal/hdf5/hdf5_io.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/memory.hpp"
#include "shelfbeam/signal/hdf5/file_checksum.hpp"
#include "shelfbeam/signal/text_file.hpp"

namespace shelfbeam::detail {

namespace {

/// Owns an HDF5 identifier.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() { release(); }

  explicit operator bool() const { return id_ >= 0; }
  operator hid_t() const { return id_; }
  bool release() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Suppresses HDF5's own error output during its lifetime.
class SuppressErrorOutput {
 public:
  SuppressErrorOutput() {
    // The library may keep parts of a corrupt file and report them when the program exits. Its exit handler
    // is not needed, because all files are closed explicitly.
    H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~SuppressErrorOutput() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  SuppressErrorOutput(const SuppressErrorOutput&) = delete;
  SuppressErrorOutput& operator=(const SuppressErrorOutput&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

hid_t number_type(Hdf5Type type) {
  if (type.kind == Hdf5Type::real) return type.size == 4 ? H5T_NATIVE_FLOAT : H5T_NATIVE_DOUBLE;
  return type.size == 1 ? H5T_NATIVE_UINT8 : type.size == 4 ? H5T_NATIVE_UINT32 : H5T_NATIVE_UINT64;
}

// The type in memory and in files: all supported machines are little-endian, like the files.
Handle make_type(Hdf5Type type) {
  const bool is_text = type.kind == Hdf5Type::text;
  Handle made(H5Tcopy(is_text ? H5T_C_S1 : number_type(type)), H5Tclose);
  if (is_text) {
    H5Tset_size(made, type.size);
    H5Tset_strpad(made, H5T_STR_NULLPAD);
    H5Tset_cset(made, type.is_ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8);
  }
  return made;
}

Handle space_of(const Shape& shape) {
  const std::vector<hsize_t> extents(shape.begin(), shape.end());
  return {H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose};
}

// Texts have fixed length, so that the file contains no references. Octave cannot read texts marked as UTF-8,
// so only texts that require UTF-8 are marked.
bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 128; });
}

}  // namespace

struct Hdf5Writer::File {
  SuppressErrorOutput silence;
  std::filesystem::path path;
  std::string name;
  Handle id;

  [[noreturn]] void fail(const std::string& what) const {
    const std::string reason = errno != 0 ? system_reason() : "no reason given";
    cannot_write(name, fmt::format("{}, at {}", reason, what));
  }
  void check(bool good, const std::string& what) const {
    if (!good) fail(what);
  }

  // Matrices are chunked by whole rows, about 1 MB per chunk, so that readers can read single rows.
  static std::array<hsize_t, 2> chunk_of(const Shape& shape, std::size_t element_size) {
    const std::size_t columns = std::min<std::size_t>(shape[1], 1 << 18);
    return {std::clamp<std::size_t>((1 << 20) / (columns * element_size), 1, shape[0]), columns};
  }

  static Handle layout(const Shape& shape, std::size_t element_size) {
    Handle plan(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(plan, false);
    if (shape.size() == 2) {
      const auto chunk = chunk_of(shape, element_size);
      H5Pset_chunk(plan, 2, chunk.data());
      // Chunks may extend beyond the matrix; their unused entries must have a fixed value.
      const std::uint64_t zero = 0;
      H5Pset_fill_value(plan, H5T_STD_U64LE, &zero);
      H5Pset_fill_time(plan, H5D_FILL_TIME_ALLOC);
    }
    return plan;
  }

  Handle create(const std::string& set, Hdf5Type type, const Shape& shape) const {
    return {H5Dcreate2(id, set.c_str(), make_type(type), space_of(shape), H5P_DEFAULT,
                       layout(shape, type.size), H5P_DEFAULT),
            H5Dclose};
  }
};

Hdf5Writer::Hdf5Writer(const std::filesystem::path& path, const std::string& name)
    : file_(std::make_unique<File>()) {
  file_->path = path;
  file_->name = name;
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false);
  H5Pset_userblock(creation, checksum_block);
  // A fixed version of the format gives the same bytes with every version of the library.
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
  // AtomicFile has locked the file. On NFS both kinds of locks are the same, and the library's would fail.
  H5Pset_file_locking(access, false, true);
  file_->id = Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose);
  file_->check(bool(file_->id), "its creation");
}

Hdf5Writer::~Hdf5Writer() = default;

void Hdf5Writer::group(const std::string& path) {
  const Handle plan(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(plan, false);
  const Handle group(H5Gcreate2(file_->id, path.c_str(), H5P_DEFAULT, plan, H5P_DEFAULT), H5Gclose);
  file_->check(bool(group), path);
}

void Hdf5Writer::write(const std::string& path, Hdf5Type type, const Shape& shape, const void* data) {
  Handle set = file_->create(path, type, shape);
  file_->check(
      set && H5Dwrite(set, make_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0 && set.release(), path);
}

void Hdf5Writer::write_rows(const std::string& path, Hdf5Type type, const Shape& shape,
                            const std::function<void(std::size_t row, void* values)>& fill) {
  Handle set = file_->create(path, type, shape);
  file_->check(bool(set), path);
  const Handle space = space_of(shape), in_memory = make_type(type);
  const std::size_t at_once = File::chunk_of(shape, type.size)[0], length = shape[1] * type.size;
  std::vector<std::byte> values(at_once * length);
  for (std::size_t first = 0; first < shape[0]; first += at_once) {
    const std::size_t count = std::min(at_once, shape[0] - first);
    for (std::size_t k = 0; k < count; ++k) fill(first + k, values.data() + k * length);
    const hsize_t start[] = {first, 0}, extents[] = {count, shape[1]};
    const Handle part(H5Screate_simple(2, extents, nullptr), H5Sclose);
    file_->check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, extents, nullptr) >= 0 &&
                     H5Dwrite(set, in_memory, part, space, H5P_DEFAULT, values.data()) >= 0,
                 path);
  }
  file_->check(set.release(), path);
}

void Hdf5Writer::write_attribute(const std::string& name, Hdf5Type type, const void* value) {
  const Handle id = make_type(type), scalar(H5Screate(H5S_SCALAR), H5Sclose);
  Handle item(H5Acreate2(file_->id, name.c_str(), id, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  file_->check(item && H5Awrite(item, id, value) >= 0 && item.release(), name);
}

void Hdf5Writer::close() {
  file_->check(file_->id.release(), "its end");
  write_file_checksum(file_->path, file_->name);
}

struct Hdf5Reader::File {
  SuppressErrorOutput silence;
  std::string name;
  Handle id;

  [[noreturn]] void fail(const std::string& place, const std::string& problem) const {
    throw InputError(name + ": " + place, problem, "simulate or export it again");
  }

  Handle open(const std::string& path) const {
    Handle set(H5Dopen2(id, path.c_str(), H5P_DEFAULT), H5Dclose);
    if (!set) fail(path, "is missing or corrupt");
    return set;
  }

  Shape shape(const std::string& path, hid_t set) const {
    const Handle space(H5Dget_space(set), H5Sclose);
    const int rank = space ? H5Sget_simple_extent_ndims(space) : -1;
    if (rank < 0 || rank > 2) fail(path, "has neither one nor two dimensions");
    std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space, extents.data(), nullptr);
    return {extents.begin(), extents.end()};
  }

  Handle open_attribute(const std::string& attribute) const {
    Handle item(H5Aopen(id, attribute.c_str(), H5P_DEFAULT), H5Aclose);
    if (!item) fail("attribute " + attribute, "is missing or corrupt");
    const Handle space(H5Aget_space(item), H5Sclose);
    if (H5Sget_simple_extent_npoints(space) != 1) fail("attribute " + attribute, "is not a single value");
    return item;
  }

  Hdf5Type type_of(const std::string& place, const Handle& type, Hdf5Type::Kind kind) const {
    constexpr H5T_class_t classes[] = {H5T_FLOAT, H5T_INTEGER, H5T_STRING};  // of real, whole, text
    if (H5Tget_class(type) != classes[kind] || H5Tis_variable_str(type) > 0)
      fail(place, kind == Hdf5Type::text ? "has no strings of fixed length" : "has data of the wrong type");
    return {kind, H5Tget_size(type), H5Tget_cset(type) == H5T_CSET_ASCII};
  }
};

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path) : file_(std::make_unique<File>()) {
  file_->name = path.string();
  input_size(path, memory_limit());
  if (has_file_checksum(path))
    verify_file_checksum(path);
  else if (const std::string head = read_first_bytes(path, 9); head.size() == 9 && head[8] < 2)
    // Byte 8 is the version of the superblock. HDF5 cannot detect corrupt metadata of the old format.
    throw InputError(path.string(), "is in the old HDF5 format, whose metadata have no checksums",
                     "write it with libver='latest' (h5py) or convert it with h5repack --low=2");
  file_->id = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file_->id)
    throw InputError(path.string(), "is not an HDF5 file, or is truncated or corrupt",
                     "simulate or export it again");
}

Hdf5Reader::~Hdf5Reader() = default;

bool Hdf5Reader::has(const std::string& path) const {
  return H5Lexists(file_->id, path.c_str(), H5P_DEFAULT) != 0;
}

std::size_t Hdf5Reader::length(const std::string& path) const {
  const Shape shape = file_->shape(path, file_->open(path));
  if (shape.size() != 1) file_->fail(path, "is not one-dimensional");
  return shape[0];
}

Hdf5Type Hdf5Reader::type_of(const std::string& path, Hdf5Type::Kind kind, const Shape& shape) const {
  const Handle set = file_->open(path);
  const Hdf5Type type = file_->type_of(path, Handle(H5Dget_type(set), H5Tclose), kind);
  if (const Shape found = file_->shape(path, set); found != shape)
    file_->fail(path, fmt::format("has the shape ({}) instead of ({})", fmt::join(found, ", "),
                                  fmt::join(shape, ", ")));
  auto bytes = static_cast<double>(type.size);
  for (const std::size_t extent : shape) bytes *= static_cast<double>(extent);
  if (bytes > static_cast<double>(memory_limit()))
    file_->fail(path, fmt::format("requires {} bytes, more than the memory limit", bytes));
  if (H5Dget_storage_size(set) == 0) file_->fail(path, "has a shape but no data");
  return type;
}

void Hdf5Reader::read(const std::string& path, Hdf5Type type, void* data) const {
  if (H5Dread(file_->open(path), make_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
    file_->fail(path, "cannot be read: the file is corrupt");
}

std::vector<float> Hdf5Reader::numbers_of_rows(const std::string& path, std::size_t first,
                                               const Shape& shape) const {
  const Handle set = file_->open(path);
  const Shape whole = file_->shape(path, set);
  if (whole.size() != 2 || whole[1] != shape[1] || first + shape[0] > whole[0])
    file_->fail(path,
                fmt::format("has no rows {} to {} of {} numbers", first + 1, first + shape[0], shape[1]));
  file_->type_of(path, Handle(H5Dget_type(set), H5Tclose), hdf5_type<float>.kind);
  std::vector<float> values(shape[0] * shape[1]);
  const Handle space = space_of(whole), rows = space_of(shape);
  const hsize_t start[] = {first, 0}, extents[] = {shape[0], shape[1]};
  if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, extents, nullptr) < 0 ||
      H5Dread(set, make_type(hdf5_type<float>), rows, space, H5P_DEFAULT, values.data()) < 0)
    file_->fail(path, "cannot be read: the file is corrupt");
  return values;
}

bool Hdf5Reader::has_attribute(const std::string& name) const {
  return H5Aexists(file_->id, name.c_str()) > 0;
}

Hdf5Type Hdf5Reader::type_of_attribute(const std::string& name, Hdf5Type::Kind kind) const {
  return file_->type_of("attribute " + name, Handle(H5Aget_type(file_->open_attribute(name)), H5Tclose),
                        kind);
}

void Hdf5Reader::read_attribute(const std::string& name, Hdf5Type type, void* value) const {
  if (H5Aread(file_->open_attribute(name), make_type(type), value) < 0)
    file_->fail("attribute " + name, "cannot be read: the file is corrupt");
}

void Hdf5Writer::texts(const std::string& path, std::span<const std::string> values) {
  std::size_t length = 1;
  for (const std::string& value : values) length = std::max(length, value.size());
  std::string padded;
  for (const std::string& value : values) padded += value + std::string(length - value.size(), '\0');
  write(path, {Hdf5Type::text, length, is_ascii(padded)}, {values.size()}, padded.data());
}

void Hdf5Writer::attribute(const std::string& name, const std::string& value) {
  const std::size_t length = std::max<std::size_t>(1, value.size());
  write_attribute(name, {Hdf5Type::text, length, is_ascii(value)}, value.c_str());
}

std::vector<std::string> Hdf5Reader::texts(const std::string& path, std::size_t count) const {
  const Hdf5Type type = type_of(path, Hdf5Type::text, {count});
  std::string padded(type.size * count, '\0');
  read(path, type, padded.data());
  std::vector<std::string> values;
  for (std::size_t i = 0; i < count; ++i) {
    const char* begin = padded.data() + i * type.size;
    values.emplace_back(begin, strnlen(begin, type.size));
  }
  return values;
}

std::string Hdf5Reader::text_attribute(const std::string& name) const {
  const Hdf5Type type = type_of_attribute(name, Hdf5Type::text);
  std::string value(type.size, '\0');
  read_attribute(name, type, value.data());
  value.resize(strnlen(value.data(), value.size()));
  return value;
}

}  // namespace shelfbeam::detail
