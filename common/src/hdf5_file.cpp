#include "suffuse/common/hdf5_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "hdf5_undo.h"
#include "suffuse/common/collective_text.h"
#include "suffuse/common/end_together.h"
#include "suffuse/common/error.h"

namespace suffuse {

namespace {

/// Before MPI starts, in every program that opens files here: Open MPI keeps a semaphore for pointers that
/// ranks share into files, which nothing here uses, by the file's name alone. One left by a killed run makes
/// each later run that opens a file of that name wait for ever.
[[maybe_unused]] const int kNoSharedFilePointers = setenv("OMPI_MCA_sharedfp", "^sm", 0);

/// Closes an HDF5 identifier when it goes out of scope.
class Id {
 public:
  Id(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id < 0) throw std::runtime_error("HDF5: cannot " + what);
  }
  ~Id() { close_(id_); }
  Id(const Id&) = delete;
  Id& operator=(const Id&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void ensure(herr_t status, const std::string& what) {
  if (status < 0) throw std::runtime_error("HDF5: cannot " + what);
}

template <class T>
hid_t type_of();
template <>
hid_t type_of<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t type_of<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
hid_t type_of<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}
template <>
hid_t type_of<std::int64_t>() {
  return H5T_NATIVE_INT64;
}

std::vector<hsize_t> sizes(const std::vector<std::size_t>& values) {
  return {values.begin(), values.end()};
}

hid_t space_for(const std::vector<std::size_t>& extents) {
  const std::vector<hsize_t> dims = sizes(extents);
  return H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr);
}

/// Selects a rank's part in the file's array; an empty part takes part with nothing.
void select(hid_t space, const ArrayPart& part) {
  if (std::find(part.count.begin(), part.count.end(), std::size_t{0}) != part.count.end()) {
    ensure(H5Sselect_none(space), "select nothing");
    return;
  }
  const std::vector<hsize_t> offset = sizes(part.offset), count = sizes(part.count);
  ensure(H5Sselect_hyperslab(space, H5S_SELECT_SET, offset.data(), nullptr, count.data(), nullptr),
         "select a part");
}

/// An array without values: there is nothing to write or read.
bool nothing_in(const ArrayPart& part) {
  return std::find(part.whole.begin(), part.whole.end(), std::size_t{0}) != part.whole.end();
}

std::size_t volume(const ArrayPart& part) {
  std::size_t product = 1;
  for (const std::size_t n : part.count) product *= n;
  return product;
}

template <class T>
void set_scalar(hid_t file, const std::string& object, const std::string& name, T value) {
  if (H5Aexists_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT) > 0)
    ensure(H5Adelete_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT), "replace attribute " + name);
  const Id space(H5Screate(H5S_SCALAR), H5Sclose, "make a scalar");
  const Id attribute(H5Acreate_by_name(file, object.c_str(), name.c_str(), type_of<T>(), space, H5P_DEFAULT,
                                       H5P_DEFAULT, H5P_DEFAULT),
                     H5Aclose, "create attribute " + name);
  ensure(H5Awrite(attribute, type_of<T>(), &value), "write attribute " + name);
}

template <class T>
T get_scalar(hid_t file, const std::string& object, const std::string& name) {
  const Id attribute(H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                     "find attribute " + name + " of " + object);
  T value{};
  ensure(H5Aread(attribute, type_of<T>(), &value), "read attribute " + name);
  return value;
}

bool some_left_open = false;

/// Has HDF5 failed on some rank? Where it has on some only, the others may wait for these in one of its own
/// calls, for ever: then all are ended.
bool any_failed(int failed, const std::string& path, MPI_Comm communicator) {
  int any = 0;
  MPI_Request all = MPI_REQUEST_NULL;
  MPI_Iallreduce(&failed, &any, 1, MPI_INT, MPI_MAX, communicator, &all);
  if (failed != 0)
    end_unless_all_come(
        all, 1,
        fmt::format("suffuse: error: HDF5: file = {}, must be read or written by every rank; is "
                    "the disk full, or has one rank a limit of its own (ulimit)?",
                    path));
  else
    MPI_Wait(&all, MPI_STATUS_IGNORE);
  return any != 0;
}

/// Takes blocks of the disk behind the file's end; 0, or why there are none. Where a file system cannot do
/// that the room that it says to have counts.
int no_room(const std::string& path, std::size_t bytes) {
  const int file = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return errno;
  int problem = 0;
  const off_t size = lseek(file, 0, SEEK_END);
  if (fallocate(file, FALLOC_FL_KEEP_SIZE, size, static_cast<off_t>(bytes)) != 0) problem = errno;
  if (problem == EOPNOTSUPP || problem == ENOSYS) {
    struct statvfs room {};
    problem = fstatvfs(file, &room) == 0 && room.f_bavail * room.f_frsize < bytes ? ENOSPC : 0;
  }
  close(file);
  return problem;
}

}  // namespace

struct Hdf5File::Handle {
  hid_t file = -1;
  MPI_Comm communicator = MPI_COMM_NULL;
  bool reads = false;
  bool noted = false;
  bool spoilt = false;  ///< a write has failed on some rank
};

/// A failure on one rank is the same UserError on all: what follows is collective.
void Hdf5File::together(const std::function<void()>& work) const {
  int failed = 0;
  try {
    work();
  } catch (const std::runtime_error&) {  // of ensure and Id; the sentence below says what a person can do
    failed = 1;
  }
  if (!any_failed(failed, path_, handle_->communicator)) return;
  handle_->spoilt = !handle_->reads;
  if (handle_->reads)
    throw_user_error(
        {"HDF5", "file", path_, "hold what is read from it", "it may be damaged or of another kind"});
  throw_user_error({"HDF5", "file", path_, "take what is written", "is the disk full?"});
}

bool Hdf5File::left_open() {
  return some_left_open;
}

void Hdf5File::close() {
  together([this] {
    const hid_t file = std::exchange(handle_->file, -1);
    if (file >= 0 && H5Fclose(file) < 0) {
      some_left_open = true;
      throw std::runtime_error("HDF5: cannot close " + path_);
    }
  });
  int rank = 0;
  MPI_Comm_rank(handle_->communicator, &rank);
  if (rank == 0 && std::exchange(handle_->noted, false)) drop_undo(path_);
}

void Hdf5File::reserve(std::size_t bytes) {
  constexpr std::size_t structure = 1 << 16;  // what HDF5 itself writes about some arrays
  int rank = 0, problem = 0;
  MPI_Comm_rank(handle_->communicator, &rank);
  if (rank == 0) problem = no_room(path_, bytes + structure);
  MPI_Bcast(&problem, 1, MPI_INT, 0, handle_->communicator);
  if (problem != 0)
    throw_user_error({"HDF5", "file", path_,
                      fmt::format("have room for {:.3g} MB more", 1e-6 * static_cast<double>(bytes)),
                      std::string(std::strerror(problem)) + "; what was written before is whole"});
}

namespace {

/// Adds where a group's arrays, and those of groups in it, have their values in the file.
void add_array_bytes(hid_t group, std::vector<ArrayBytes>& all) {
  H5G_info_t info;
  ensure(H5Gget_info(group, &info), "list a group");
  for (hsize_t n = 0; n < info.nlinks; ++n) {
    const Id object(H5Oopen_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, n, H5P_DEFAULT), H5Oclose,
                    "open an object");
    if (H5Iget_type(object) == H5I_GROUP) add_array_bytes(object, all);
    if (H5Iget_type(object) != H5I_DATASET) continue;
    const haddr_t from = H5Dget_offset(object);  // none where there are no values yet, or they lie in pieces
    if (from != HADDR_UNDEF) all.push_back({from, H5Dget_storage_size(object)});
  }
}

/// On one rank: takes back what a killed writer left, and notes what there is.
void note_growth(const std::string& path, bool anew) {
  if (anew)
    drop_undo(path);
  else
    undo_if_killed(path);
  std::vector<ArrayBytes> all;
  const bool grows = !anew && std::filesystem::exists(path);
  if (grows) {
    const Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open " + path);
    add_array_bytes(file, all);
  }
  write_undo(path, grows ? std::filesystem::file_size(path) : 0, std::move(all));
}

}  // namespace

Hdf5File::Hdf5File(const std::string& path, Mode mode, MPI_Comm communicator, Growth growth)
    : handle_(std::make_unique<Handle>()), path_(path) {
  handle_->communicator = communicator;
  handle_->reads = mode == Mode::read;
  H5Eset_auto(H5E_DEFAULT, nullptr, nullptr);  // what went wrong is thrown, not printed
  int rank = 0, there = 0;
  MPI_Comm_rank(communicator, &rank);
  if (growth == Growth::noted) {
    on_first_rank("HDF5", communicator, [&] {
      try {
        note_growth(path, mode == Mode::create);
      } catch (const std::runtime_error& problem) {
        if (dynamic_cast<const UserError*>(&problem) != nullptr) throw;
        throw_user_error({"HDF5", "file", path, "be writable, and HDF5 where it is continued",
                          "check its folder, or take another name"});
      }
    });
    handle_->noted = true;
  }
  std::error_code ignored;
  if (rank == 0) there = std::filesystem::exists(path, ignored) ? 1 : 0;
  MPI_Bcast(&there, 1, MPI_INT, 0, communicator);
  const Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "set up access to " + path);
  ensure(H5Pset_fapl_mpio(access, communicator, MPI_INFO_NULL), "use MPI for " + path);
  if (mode == Mode::read)
    handle_->file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
  else if (mode == Mode::append && there == 1)
    handle_->file = H5Fopen(path.c_str(), H5F_ACC_RDWR, access);
  else
    handle_->file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (any_failed(handle_->file < 0 ? 1 : 0, path, communicator))
    throw_user_error(
        {"HDF5", "file", path,
         mode == Mode::read ? "be a readable HDF5 file" : "be writable, and HDF5 where it is continued",
         mode == Mode::read ? "it may be damaged or of another kind"
                            : "check its folder, or take another name"});
}

Hdf5File::~Hdf5File() {
  if (handle_->file < 0) return;
  // What the disk of one rank did not take closing would write again, and fail on that rank alone: the others
  // would wait for it within HDF5.
  if (handle_->spoilt || H5Fclose(handle_->file) < 0) some_left_open = true;
}

bool Hdf5File::exists(const std::string& object) const {
  // Every group on the way must exist before the last name may be asked for.
  for (std::size_t slash = object.find('/', 1); slash != std::string::npos;
       slash = object.find('/', slash + 1))
    if (H5Lexists(handle_->file, object.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  return H5Lexists(handle_->file, object.c_str(), H5P_DEFAULT) > 0;
}

void Hdf5File::create_group(const std::string& group) {
  together([&] {
    const Id id(H5Gcreate(handle_->file, group.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                "create group " + group + " in " + path_);
  });
}

void Hdf5File::remove(const std::string& object) {
  together([&] {
    ensure(H5Ldelete(handle_->file, object.c_str(), H5P_DEFAULT), "remove " + object + " from " + path_);
  });
}

std::vector<std::string> Hdf5File::names_in(const std::string& group) const {
  std::vector<std::string> names;
  together([&] {
    const Id id(H5Gopen(handle_->file, group.c_str(), H5P_DEFAULT), H5Gclose, "open group " + group);
    H5G_info_t info;
    ensure(H5Gget_info(id, &info), "list " + group);
    for (hsize_t n = 0; n < info.nlinks; ++n) {
      const ssize_t length =
          H5Lget_name_by_idx(id, ".", H5_INDEX_NAME, H5_ITER_INC, n, nullptr, 0, H5P_DEFAULT);
      std::string name(static_cast<std::size_t>(std::max<ssize_t>(length, 0)) + 1, '\0');
      H5Lget_name_by_idx(id, ".", H5_INDEX_NAME, H5_ITER_INC, n, name.data(), name.size(), H5P_DEFAULT);
      name.pop_back();
      names.push_back(name);
    }
  });
  return names;
}

template <class T>
void Hdf5File::create_array(const std::string& dataset, const std::vector<std::size_t>& extents) {
  together([&] {
    const Id space(space_for(extents), H5Sclose, "shape " + dataset);
    const Id id(
        H5Dcreate(handle_->file, dataset.c_str(), type_of<T>(), space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Dclose, "create " + dataset + " in " + path_);
  });
}

namespace {

/// This rank's part of a dataset, the values for it in memory, and that all ranks transfer theirs together.
struct Transfer {
  Transfer(const Id& dataset, const std::string& name, const ArrayPart& part)
      : file(H5Dget_space(dataset), H5Sclose, "shape " + name) {
    select(file, part);
    ensure(H5Pset_dxpl_mpio(together, H5FD_MPIO_COLLECTIVE), "transfer " + name + " together");
    const hsize_t length = volume(part);
    ensure(H5Sset_extent_simple(memory, 1, &length, nullptr), "shape memory");
  }
  Id file;
  Id memory{H5Screate(H5S_SIMPLE), H5Sclose, "shape memory"};
  Id together{H5Pcreate(H5P_DATASET_XFER), H5Pclose, "set up a transfer"};
};

}  // namespace

template <class T>
void Hdf5File::write(const std::string& dataset, const ArrayPart& part, const std::vector<T>& values) {
  if (values.size() != volume(part))
    throw std::logic_error("Hdf5File::write: " + dataset + " has another size");
  if (nothing_in(part)) return;
  together([&] {
    const Id id(H5Dopen(handle_->file, dataset.c_str(), H5P_DEFAULT), H5Dclose, "open " + dataset);
    const Transfer parts(id, dataset, part);
    ensure(H5Dwrite(id, type_of<T>(), parts.memory, parts.file, parts.together, values.data()),
           "write " + dataset + " to " + path_);
  });
}

template <class T>
std::vector<T> Hdf5File::read(const std::string& dataset, const ArrayPart& part) const {
  std::vector<T> values;
  together([&] {
    const Id id(H5Dopen(handle_->file, dataset.c_str(), H5P_DEFAULT), H5Dclose,
                "find " + dataset + " in " + path_);
    const Transfer parts(id, dataset, part);
    values.resize(volume(part));
    ensure(H5Dread(id, type_of<T>(), parts.memory, parts.file, parts.together, values.data()),
           "read " + dataset + " of " + path_);
  });
  return values;
}

std::vector<std::size_t> Hdf5File::extents(const std::string& dataset) const {
  std::vector<std::size_t> extents;
  together([&] {
    const Id id(H5Dopen(handle_->file, dataset.c_str(), H5P_DEFAULT), H5Dclose,
                "find " + dataset + " in " + path_);
    const Id space(H5Dget_space(id), H5Sclose, "shape " + dataset);
    std::vector<hsize_t> dims(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
    H5Sget_simple_extent_dims(space, dims.data(), nullptr);
    extents.assign(dims.begin(), dims.end());
  });
  return extents;
}

void Hdf5File::set_attribute(const std::string& object, const std::string& name, double value) {
  together([&] { set_scalar(handle_->file, object, name, value); });
}
void Hdf5File::set_attribute(const std::string& object, const std::string& name, std::int64_t value) {
  together([&] { set_scalar(handle_->file, object, name, value); });
}
void Hdf5File::set_attribute(const std::string& object, const std::string& name, const std::string& value) {
  together([&] {
    if (H5Aexists_by_name(handle_->file, object.c_str(), name.c_str(), H5P_DEFAULT) > 0)
      ensure(H5Adelete_by_name(handle_->file, object.c_str(), name.c_str(), H5P_DEFAULT),
             "replace attribute " + name);
    const Id type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
    ensure(H5Tset_size(type, value.size() + 1), "size a text");
    const Id space(H5Screate(H5S_SCALAR), H5Sclose, "make a scalar");
    const Id attribute(H5Acreate_by_name(handle_->file, object.c_str(), name.c_str(), type, space,
                                         H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       H5Aclose, "create attribute " + name);
    ensure(H5Awrite(attribute, type, value.c_str()), "write attribute " + name);
  });
}

double Hdf5File::number_attribute(const std::string& object, const std::string& name) const {
  double value{};
  together([&] { value = get_scalar<double>(handle_->file, object, name); });
  return value;
}
std::int64_t Hdf5File::integer_attribute(const std::string& object, const std::string& name) const {
  std::int64_t value{};
  together([&] { value = get_scalar<std::int64_t>(handle_->file, object, name); });
  return value;
}
std::string Hdf5File::text_attribute(const std::string& object, const std::string& name) const {
  std::string value;
  together([&] {
    const Id attribute(H5Aopen_by_name(handle_->file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                       H5Aclose, "find attribute " + name + " of " + object);
    const Id type(H5Aget_type(attribute), H5Tclose, "type attribute " + name);
    value.assign(H5Tget_size(type), '\0');
    ensure(H5Aread(attribute, type, value.data()), "read attribute " + name);
  });
  return value.substr(0, value.find('\0'));
}

#define SUFFUSE_INSTANTIATE(T)                                                                   \
  template void Hdf5File::create_array<T>(const std::string&, const std::vector<std::size_t>&);  \
  template void Hdf5File::write<T>(const std::string&, const ArrayPart&, const std::vector<T>&); \
  template std::vector<T> Hdf5File::read<T>(const std::string&, const ArrayPart&) const;
SUFFUSE_INSTANTIATE(double)
SUFFUSE_INSTANTIATE(float)
SUFFUSE_INSTANTIATE(std::uint8_t)
SUFFUSE_INSTANTIATE(std::int64_t)
#undef SUFFUSE_INSTANTIATE

}  // namespace suffuse
