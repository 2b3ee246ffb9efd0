#pragma once

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace suffuse {

/// A part of an array in a file: `offset` and `count` for each of its dimensions (slowest first).
struct ArrayPart {
  std::vector<std::size_t> whole;   ///< extents of the array in the file
  std::vector<std::size_t> offset;  ///< where this rank's part begins
  std::vector<std::size_t> count;   ///< its extents; a zero means that this rank has nothing
};

/// A part of a file that holds an array's values.
struct ArrayBytes {
  std::uint64_t from = 0, length = 0;
};

/// A file that grows state by state, opened for each, and stays one that can be opened whenever its writer is
/// killed: the next one that is to write it finds PATH.undo, and takes back what was half written
/// (hdf5_undo.h). Of one file, for as long as its writer lives: what is known of it from one state to the
/// next need not be looked up in it again.
class Hdf5Growth {
  friend class Hdf5File;
  friend bool is_as_left(const std::string&, const Hdf5Growth&, MPI_Comm);
  // On rank 0
  bool known_ = false;
  std::uint64_t length_ = 0;        ///< of the file that `arrays_` are those of
  std::vector<ArrayBytes> arrays_;  ///< there are or were: HDF5 does not use the room of removed ones again
  std::vector<ArrayBytes> unused_;  ///< of removed ones
  bool unused_is_told_ = true;      ///< in the file
};

/// Is the file the one that this Hdf5Growth left, with what was written then and no more? Collective.
bool is_as_left(const std::string& path, const Hdf5Growth& growth, MPI_Comm communicator);

/// keep_earlier (safe_file.h) of a file that may have grown state by state: what a killed writer left half
/// written in it is taken back before. On one rank.
std::optional<std::string> keep_earlier_hdf5(const std::string& path, const std::string& who);

/// Removes from a file that grows, if there is one, the groups under its root whose names begin with `prefix`
/// and are not less than `first`. In an opening of its own: what HDF5 would put in their place then could be
/// anything. Collective.
void remove_states_from(const std::string& first, const std::string& prefix, const std::string& path,
                        Hdf5Growth& growth, MPI_Comm communicator);

/// An HDF5 file that all ranks of a communicator write and read together. Every call is collective. No HDF5
/// type is visible here. What a file or its disk does not take or hold is a UserError, the same on every
/// rank, so that no rank waits for another.
class Hdf5File {
 public:
  enum class Mode { create, append, read };  ///< `append` creates the file if there is none

  /// With `growth`, which outlives it, the file is one that grows state by state.
  Hdf5File(const std::string& path, Mode mode, MPI_Comm communicator, Hdf5Growth* growth = nullptr);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// Sees to it that so many bytes more can be written: blocks of the disk are taken for them before. A
  /// UserError where there are none, before anything has been changed. Collective.
  void reserve(std::size_t bytes);

  /// The last step of a file that was written: a UserError where the disk did not take all. A destructor
  /// closes too, and cannot say it. Collective.
  void close();

  /// Did a file of this process not close, for its disk did not take it? HDF5 then fails when MPI ends: the
  /// process is to end without.
  static bool left_open();

  bool exists(const std::string& object) const;
  void create_group(const std::string& group);
  void remove(const std::string& object);
  /// Names of the objects right under a group, sorted.
  std::vector<std::string> names_in(const std::string& group) const;

  /// Element types: double, float, std::uint8_t, std::int64_t. `dataset` is created by create_array.
  template <class T>
  void create_array(const std::string& dataset, const std::vector<std::size_t>& extents);
  template <class T>
  void write(const std::string& dataset, const ArrayPart& part, const std::vector<T>& values);
  template <class T>
  std::vector<T> read(const std::string& dataset, const ArrayPart& part) const;
  std::vector<std::size_t> extents(const std::string& dataset) const;

  void set_attribute(const std::string& object, const std::string& name, double value);
  void set_attribute(const std::string& object, const std::string& name, std::int64_t value);
  void set_attribute(const std::string& object, const std::string& name, const std::string& value);
  double number_attribute(const std::string& object, const std::string& name) const;
  std::int64_t integer_attribute(const std::string& object, const std::string& name) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;

 private:
  void together(const std::function<void()>& work) const;
  void note_growth(bool anew);
  void tell_unused();

  struct Handle;
  std::unique_ptr<Handle> handle_;
  std::string path_;
};

}  // namespace suffuse
