#include "suffuse/common/hdf5_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "hdf5_handle.h"
#include "hdf5_undo.h"
#include "suffuse/common/collective_text.h"
#include "suffuse/common/end_together.h"
#include "suffuse/common/error.h"
#include "suffuse/common/paths.h"

namespace suffuse {

namespace {

/// Before MPI starts, in every program that opens files here: Open MPI keeps a semaphore for pointers that
/// ranks share into files, which nothing here uses, by the file's name alone. One left by a killed run makes
/// each later run that opens a file of that name wait for ever.
[[maybe_unused]] const int kNoSharedFilePointers = setenv("OMPI_MCA_sharedfp", "^sm", 0);

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

/// HDF5 shortens a file by what was removed at its end, and uses that room for anything again.
void keep_within(std::uint64_t length, std::vector<ArrayBytes>& arrays) {
  std::erase_if(arrays, [&](const ArrayBytes& bytes) { return bytes.from >= length; });
  for (ArrayBytes& bytes : arrays) bytes.length = std::min(bytes.length, length - bytes.from);
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

/// A failure on one rank is the same UserError on all: what follows is collective.
void Hdf5File::together(const std::function<void()>& work) const {
  int failed = 0;
  try {
    work();
  } catch (const std::exception&) {  // of ensure and Id, or no memory; the sentence below says what a person
                                     // can do
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
  try {
    together([this] {
      const hid_t file = std::exchange(handle_->file, -1);
      if (file >= 0 && H5Fclose(file) < 0) throw std::runtime_error("HDF5: cannot close " + path_);
    });
  } catch (const UserError&) {
    some_left_open = true;  // on some rank: all of them end in the same way
    throw;
  }
  int rank = 0;
  MPI_Comm_rank(handle_->communicator, &rank);
  Hdf5Growth* const growth = std::exchange(handle_->growth, nullptr);
  if (growth == nullptr || rank != 0) return;
  drop_undo(path_);
  std::error_code unknown;
  growth->length_ = std::filesystem::file_size(path_, unknown);
  growth->known_ = !unknown;
  growth->arrays_.insert(growth->arrays_.end(), handle_->new_arrays.begin(), handle_->new_arrays.end());
  growth->unused_.insert(growth->unused_.end(), handle_->removed_arrays.begin(),
                         handle_->removed_arrays.end());
  growth->unused_is_told_ = handle_->removed_arrays.empty();
  if (growth->unused_is_told_) return;
  keep_within(growth->length_, growth->arrays_);
  keep_within(growth->length_, growth->unused_);
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
    if (H5Iget_type(object) == H5I_DATASET) add_bytes_of(object, all);
  }
}

/// Of the root: pairs of first byte and length.
constexpr const char* kUnused = "unused_bytes";

std::vector<ArrayBytes> unused_of(hid_t file) {
  std::vector<ArrayBytes> unused;
  if (H5Aexists_by_name(file, "/", kUnused, H5P_DEFAULT) <= 0) return unused;
  const Id attribute(H5Aopen_by_name(file, "/", kUnused, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "open unused");
  const Id space(H5Aget_space(attribute), H5Sclose, "shape unused");
  std::vector<std::uint64_t> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  ensure(H5Aread(attribute, H5T_NATIVE_UINT64, values.data()), "read unused");
  for (std::size_t n = 0; n + 1 < values.size(); n += 2) unused.push_back({values[n], values[n + 1]});
  return unused;
}

}  // namespace

void add_bytes_of(hid_t dataset, std::vector<ArrayBytes>& all) {
  const haddr_t from = H5Dget_offset(dataset);  // none where there are no values yet, or they lie in pieces
  if (from != HADDR_UNDEF) all.push_back({from, H5Dget_storage_size(dataset)});
}

/// On one rank: takes back what a killed writer left, and notes what there is.
void Hdf5File::note_growth(bool anew) {
  Hdf5Growth& growth = *handle_->growth;
  if (anew)
    drop_undo(path_);
  else
    undo_if_killed(path_);
  const bool grows = !anew && is_there(path_);
  const std::uint64_t length = grows ? std::filesystem::file_size(path_) : 0;
  if (!growth.known_ || growth.length_ != length) {
    growth = {};
    if (grows) {
      const Id file(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open " + path_);
      growth.unused_ = unused_of(file);
      growth.arrays_ = growth.unused_;
      add_array_bytes(file, growth.arrays_);
    }
  }
  write_undo(path_, length, growth.arrays_);
}

Hdf5File::Hdf5File(const std::string& path, Mode mode, MPI_Comm communicator, Hdf5Growth* growth)
    : handle_(std::make_unique<Handle>()), path_(path) {
  handle_->communicator = communicator;
  handle_->growth = growth;
  handle_->reads = mode == Mode::read;
  H5Eset_auto(H5E_DEFAULT, nullptr, nullptr);  // what went wrong is thrown, not printed
  int rank = 0, there = 0;
  MPI_Comm_rank(communicator, &rank);
  if (growth != nullptr) {
    on_first_rank("HDF5", communicator, [&] {
      try {
        note_growth(mode == Mode::create);
      } catch (const std::runtime_error& problem) {
        if (dynamic_cast<const UserError*>(&problem) != nullptr) throw;
        throw_user_error({"HDF5", "file", path, "be writable, and HDF5 where it is continued",
                          "check its folder, or take another name"});
      }
    });
  }
  if (rank == 0) there = is_there(path) ? 1 : 0;
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
  if (growth != nullptr) tell_unused();
}

Hdf5File::~Hdf5File() {
  if (handle_->file < 0) return;
  // What the disk of one rank did not take closing would write again, and fail on that rank alone: the others
  // would wait for it within HDF5.
  if (handle_->spoilt || H5Fclose(handle_->file) < 0) some_left_open = true;
}

/// So that who opens the file next need not take unused room for HDF5's own. An attribute holds 64 kB: the
/// longest parts are told.
void Hdf5File::tell_unused() {
  constexpr std::size_t most = 3000;
  std::vector<std::uint64_t> values;
  if (!handle_->growth->unused_is_told_) {
    std::vector<ArrayBytes> unused = handle_->growth->unused_;
    std::sort(unused.begin(), unused.end(),
              [](const ArrayBytes& a, const ArrayBytes& b) { return a.length > b.length; });
    unused.resize(std::min(unused.size(), most));
    for (const ArrayBytes& bytes : unused) values.insert(values.end(), {bytes.from, bytes.length});
  }
  auto count = static_cast<int>(values.size());
  MPI_Bcast(&count, 1, MPI_INT, 0, handle_->communicator);
  if (count == 0) return;
  values.resize(static_cast<std::size_t>(count));
  MPI_Bcast(values.data(), count, MPI_UINT64_T, 0, handle_->communicator);
  together([&] {
    if (H5Aexists_by_name(handle_->file, "/", kUnused, H5P_DEFAULT) > 0)
      ensure(H5Adelete_by_name(handle_->file, "/", kUnused, H5P_DEFAULT), "replace unused");
    const hsize_t length = values.size();
    const Id space(H5Screate_simple(1, &length, nullptr), H5Sclose, "shape unused");
    const Id attribute(H5Acreate_by_name(handle_->file, "/", kUnused, H5T_NATIVE_UINT64, space, H5P_DEFAULT,
                                         H5P_DEFAULT, H5P_DEFAULT),
                       H5Aclose, "create unused");
    ensure(H5Awrite(attribute, H5T_NATIVE_UINT64, values.data()), "write unused");
  });
}

bool is_as_left(const std::string& path, const Hdf5Growth& growth, MPI_Comm communicator) {
  int rank = 0, as_left = 0;
  MPI_Comm_rank(communicator, &rank);
  std::error_code absent;
  if (rank == 0 && growth.known_ && !has_undo(path))
    as_left = std::filesystem::file_size(path, absent) == growth.length_ && !absent ? 1 : 0;
  MPI_Bcast(&as_left, 1, MPI_INT, 0, communicator);
  return as_left == 1;
}

void remove_states_from(const std::string& first, const std::string& prefix, const std::string& path,
                        Hdf5Growth& growth, MPI_Comm communicator) {
  Hdf5File file(path, Hdf5File::Mode::append, communicator, &growth);
  for (const std::string& name : file.names_in("/"))
    if (name.starts_with(prefix) && name >= first) file.remove("/" + name);
  file.close();
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
    {
      const Id group(H5Oopen(handle_->file, object.c_str(), H5P_DEFAULT), H5Oclose, "open " + object);
      if (H5Iget_type(group) == H5I_GROUP) add_array_bytes(group, handle_->removed_arrays);
    }
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

}  // namespace suffuse
