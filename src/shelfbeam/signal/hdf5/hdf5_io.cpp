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
#include "shelfbeam/signal/text_file.hpp"

namespace shelfbeam::detail {

namespace {

/// An HDF5 identifier that is released with its owner.
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

/// HDF5 prints its errors by itself; not while one of these lives.
class Silence {
 public:
  Silence() {
    // After a damaged file the library may still hold parts of it, and would complain when the program ends.
    // All files are closed here, so nothing is left for it to do then.
    H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

template <class T>
hid_t memory_type() {
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
  if constexpr (std::is_same_v<T, std::uint32_t>) return H5T_NATIVE_UINT32;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_NATIVE_UINT64;
}

template <class T>
hid_t file_type() {
  if constexpr (std::is_same_v<T, float>) return H5T_IEEE_F32LE;
  if constexpr (std::is_same_v<T, double>) return H5T_IEEE_F64LE;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_STD_U8LE;
  if constexpr (std::is_same_v<T, std::uint32_t>) return H5T_STD_U32LE;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_STD_U64LE;
}

bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 128; });
}

// Fixed length, padded with zeros: nothing in the file points anywhere. Octave reads no texts that are marked
// as UTF-8, so only those are marked that need it.
Handle text_type(std::size_t length, bool ascii) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(1, length));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8);
  return type;
}

Handle scalar() {
  return {H5Screate(H5S_SCALAR), H5Sclose};
}

}  // namespace

struct Hdf5Writer::File {
  Silence silence;
  std::string name;
  Handle id;

  [[noreturn]] void fail(const std::string& what) const {
    const std::string reason = errno != 0 ? system_reason() : "no reason given";
    cannot_write(name, fmt::format("{}, at {}", reason, what));
  }
  void check(bool good, const std::string& what) const {
    if (!good) fail(what);
  }

  // Matrices are chunked by whole rows, about 1 MB a chunk, so that readers can take some of the rows.
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
      // What a chunk at the edge has beyond the matrix must not be left to chance.
      const std::uint64_t zero = 0;
      H5Pset_fill_value(plan, H5T_STD_U64LE, &zero);
      H5Pset_fill_time(plan, H5D_FILL_TIME_ALLOC);
    }
    return plan;
  }

  static Handle space_of(const Shape& shape) {
    const std::vector<hsize_t> extents(shape.begin(), shape.end());
    return {H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose};
  }

  Handle create(const std::string& path, hid_t in_file, const Shape& shape) const {
    const Handle plan = layout(shape, H5Tget_size(in_file));
    return {H5Dcreate2(id, path.c_str(), in_file, space_of(shape), H5P_DEFAULT, plan, H5P_DEFAULT), H5Dclose};
  }

  void write(const std::string& path, hid_t in_memory, hid_t in_file, const Shape& shape,
             const void* data) const {
    Handle set = create(path, in_file, shape);
    check(set && H5Dwrite(set, in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0 && set.release(), path);
  }

  void write_attribute(const std::string& attribute, hid_t in_memory, hid_t in_file, const void* data) const {
    Handle item(H5Acreate2(id, attribute.c_str(), in_file, scalar(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    check(item && H5Awrite(item, in_memory, data) >= 0 && item.release(), attribute);
  }
};

Hdf5Writer::Hdf5Writer(const std::filesystem::path& path, const std::string& name)
    : file_(std::make_unique<File>()) {
  file_->name = name;
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false);
  // One version of the format whatever the library's: the same bytes, and checksums on all metadata.
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
  // AtomicFile has locked it; where both kinds of locks are one (NFS) the library's would fail.
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

template <Hdf5Number T>
void Hdf5Writer::numbers(const std::string& path, std::span<const T> values, const Shape& shape) {
  file_->write(path, memory_type<T>(), file_type<T>(), shape, values.data());
}

template <Hdf5Number T>
void Hdf5Writer::rows(const std::string& path, const Shape& shape, const FillRow<T>& fill) {
  Handle set = file_->create(path, file_type<T>(), shape);
  file_->check(bool(set), path);
  const Handle space = File::space_of(shape);
  const std::size_t columns = shape[1], at_once = File::chunk_of(shape, sizeof(T))[0];
  std::vector<T> values;
  for (std::size_t first = 0; first < shape[0]; first += at_once) {
    const std::size_t count = std::min(at_once, shape[0] - first);
    values.resize(count * columns);
    for (std::size_t k = 0; k < count; ++k) fill(first + k, std::span(values).subspan(k * columns, columns));
    const hsize_t start[] = {first, 0}, extents[] = {count, columns};
    const Handle part(H5Screate_simple(2, extents, nullptr), H5Sclose);
    file_->check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, extents, nullptr) >= 0 &&
                     H5Dwrite(set, memory_type<T>(), part, space, H5P_DEFAULT, values.data()) >= 0,
                 path);
  }
  file_->check(set.release(), path);
}

void Hdf5Writer::texts(const std::string& path, std::span<const std::string> values) {
  std::size_t length = 1;
  for (const std::string& value : values) length = std::max(length, value.size());
  std::vector<char> padded(length * values.size(), '\0');
  for (std::size_t i = 0; i < values.size(); ++i)
    std::copy(values[i].begin(), values[i].end(), padded.begin() + static_cast<std::ptrdiff_t>(i * length));
  const Handle type = text_type(length, std::all_of(values.begin(), values.end(), is_ascii));
  file_->write(path, type, type, {values.size()}, padded.data());
}

template <Hdf5Number T>
void Hdf5Writer::attribute(const std::string& name, T value) {
  file_->write_attribute(name, memory_type<T>(), file_type<T>(), &value);
}

void Hdf5Writer::attribute(const std::string& name, const std::string& value) {
  const Handle type = text_type(value.size(), is_ascii(value));
  file_->write_attribute(name, type, type, value.c_str());
}

void Hdf5Writer::close() {
  file_->check(file_->id.release(), "its end");
}

struct Hdf5Reader::File {
  Silence silence;
  std::string name;
  std::size_t size = 0;
  Handle id;

  [[noreturn]] void fail(const std::string& place, const std::string& problem) const {
    throw InputError(name + ": " + place, problem, "simulate or export it again");
  }

  Handle open(const std::string& path) const {
    Handle set(H5Dopen2(id, path.c_str(), H5P_DEFAULT), H5Dclose);
    if (!set) fail(path, "is missing or damaged");
    return set;
  }

  Shape shape(const std::string& path, hid_t set) const {
    const Handle space(H5Dget_space(set), H5Sclose);
    const int rank = space ? H5Sget_simple_extent_ndims(space) : -1;
    if (rank < 0 || rank > 2) fail(path, "has neither one dimension nor two");
    std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space, extents.data(), nullptr);
    return {extents.begin(), extents.end()};
  }

  // Throws unless the data set has this shape, and the file the bytes for it: a claim alone takes no memory.
  void check(const std::string& path, hid_t set, hid_t type, const Shape& expected) const {
    if (const Shape found = shape(path, set); found != expected)
      fail(path, fmt::format("has the shape ({}) where ({}) is expected", fmt::join(found, ", "),
                             fmt::join(expected, ", ")));
    const Handle plan(H5Dget_create_plist(set), H5Pclose);
    double bytes = static_cast<double>(H5Tget_size(type));
    for (const std::size_t extent : expected) bytes *= static_cast<double>(extent);
    const auto stored = static_cast<double>(H5Dget_storage_size(set));
    constexpr double best_deflate = 1032;  // no stream unpacks to a larger multiple (zlib's manual)
    const double ratio = H5Pget_nfilters(plan) > 0 ? best_deflate : 1;
    if (stored > static_cast<double>(size) || bytes > stored * ratio)
      fail(path, fmt::format("claims {} bytes and holds {}", bytes, stored));
    if (bytes > static_cast<double>(most_of_the_memory()))
      fail(path, fmt::format("takes {} bytes, more than the memory holds", bytes));
    if (H5Pget_layout(plan) == H5D_CHUNKED) {
      hsize_t extents[2] = {1, 1};
      H5Pget_chunk(plan, 2, extents);
      const double chunk = static_cast<double>(extents[0]) * static_cast<double>(extents[1]) *
                           static_cast<double>(H5Tget_size(type));
      if (chunk > std::max(bytes, double{1 << 24})) fail(path, "has chunks that are larger than itself");
    }
  }

  template <class T>
  static bool fits(hid_t type) {
    return H5Tget_class(type) == (std::is_floating_point_v<T> ? H5T_FLOAT : H5T_INTEGER);
  }

  Handle open_attribute(const std::string& attribute) const {
    Handle item(H5Aopen(id, attribute.c_str(), H5P_DEFAULT), H5Aclose);
    if (!item) fail("attribute " + attribute, "is missing or damaged");
    const Handle space(H5Aget_space(item), H5Sclose);
    if (H5Sget_simple_extent_npoints(space) != 1) fail("attribute " + attribute, "is no single value");
    return item;
  }

  static bool is_fixed_text(hid_t type) {
    return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
  }

  // The text type with zeros behind the text, however the file marks its end.
  static Handle padded(hid_t type) {
    Handle in_memory(H5Tcopy(type), H5Tclose);
    H5Tset_strpad(in_memory, H5T_STR_NULLPAD);
    return in_memory;
  }
};

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path) : file_(std::make_unique<File>()) {
  file_->name = path.string();
  // Byte 8 is the version of the superblock. The library trusts old metadata blindly where they are damaged.
  if (const std::string head = read_first_bytes(path, 9); head.size() == 9 && head[8] < 2)
    throw InputError(path.string(), "is in the old HDF5 format, whose metadata have no checksums",
                     "write it with libver='latest' (h5py) or convert it with h5repack --low=2");
  file_->id = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file_->id)
    throw InputError(path.string(), "is no HDF5 file, or a truncated or damaged one",
                     "simulate or export it again");
  file_->size = static_cast<std::size_t>(std::filesystem::file_size(path));
}

Hdf5Reader::~Hdf5Reader() = default;

bool Hdf5Reader::has(const std::string& path) const {
  return H5Lexists(file_->id, path.c_str(), H5P_DEFAULT) != 0;
}

std::size_t Hdf5Reader::length(const std::string& path) const {
  const Shape shape = file_->shape(path, file_->open(path));
  if (shape.size() != 1) file_->fail(path, "has not one dimension");
  return shape[0];
}

template <Hdf5Number T>
std::vector<T> Hdf5Reader::numbers(const std::string& path, const Shape& shape) const {
  const Handle set = file_->open(path);
  const Handle type(H5Dget_type(set), H5Tclose);
  if (!File::fits<T>(type)) file_->fail(path, "holds data of the wrong type");
  file_->check(path, set, type, shape);
  std::size_t count = 1;
  for (const std::size_t extent : shape) count *= extent;
  std::vector<T> values(count);
  if (H5Dread(set, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    file_->fail(path, "cannot be read: the file is damaged");
  return values;
}

std::vector<std::string> Hdf5Reader::texts(const std::string& path, std::size_t count) const {
  const Handle set = file_->open(path);
  const Handle type(H5Dget_type(set), H5Tclose);
  if (!File::is_fixed_text(type)) file_->fail(path, "holds no texts of fixed length");
  file_->check(path, set, type, {count});
  const std::size_t length = H5Tget_size(type);
  std::vector<char> bytes(length * count);
  if (H5Dread(set, File::padded(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
    file_->fail(path, "cannot be read: the file is damaged");
  std::vector<std::string> values;
  for (std::size_t i = 0; i < count; ++i) {
    const char* begin = bytes.data() + i * length;
    values.emplace_back(begin, strnlen(begin, length));
  }
  return values;
}

bool Hdf5Reader::has_attribute(const std::string& name) const {
  return H5Aexists(file_->id, name.c_str()) > 0;
}

template <Hdf5Number T>
T Hdf5Reader::attribute(const std::string& name) const {
  const Handle item = file_->open_attribute(name);
  const Handle type(H5Aget_type(item), H5Tclose);
  T value{};
  if (!File::fits<T>(type) || H5Aread(item, memory_type<T>(), &value) < 0)
    file_->fail("attribute " + name, "is of the wrong type");
  return value;
}

std::string Hdf5Reader::text_attribute(const std::string& name) const {
  const Handle item = file_->open_attribute(name);
  const Handle type(H5Aget_type(item), H5Tclose);
  if (!File::is_fixed_text(type) || H5Tget_size(type) > file_->size)
    file_->fail("attribute " + name, "is no text of fixed length");
  std::string value(H5Tget_size(type), '\0');
  if (H5Aread(item, File::padded(type), value.data()) < 0)
    file_->fail("attribute " + name, "cannot be read: the file is damaged");
  value.resize(strnlen(value.data(), value.size()));
  return value;
}

#define SHELFBEAM_INSTANTIATE(T)                                                              \
  template void Hdf5Writer::numbers<T>(const std::string&, std::span<const T>, const Shape&); \
  template void Hdf5Writer::rows<T>(const std::string&, const Shape&, const FillRow<T>&);     \
  template void Hdf5Writer::attribute<T>(const std::string&, T);                              \
  template std::vector<T> Hdf5Reader::numbers<T>(const std::string&, const Shape&) const;     \
  template T Hdf5Reader::attribute<T>(const std::string&) const;
SHELFBEAM_INSTANTIATE(float)
SHELFBEAM_INSTANTIATE(double)
SHELFBEAM_INSTANTIATE(std::uint8_t)
SHELFBEAM_INSTANTIATE(std::uint32_t)
SHELFBEAM_INSTANTIATE(std::uint64_t)
#undef SHELFBEAM_INSTANTIATE

}  // namespace shelfbeam::detail
