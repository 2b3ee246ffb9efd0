#pragma once

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace suffuse {

/// A part of an array in a file: `offset` and `count` for each of its dimensions (slowest first).
struct ArrayPart {
  std::vector<std::size_t> whole;   ///< extents of the array in the file
  std::vector<std::size_t> offset;  ///< where this rank's part begins
  std::vector<std::size_t> count;   ///< its extents; a zero means that this rank has nothing
};

/// An HDF5 file that all ranks of a communicator write and read together. Every call is collective. No HDF5
/// type is visible here. A file that cannot be opened is a UserError, other failures of the file system are
/// thrown as std::runtime_error with the path, the same on every rank.
class Hdf5File {
 public:
  enum class Mode { create, append, read };  ///< `append` creates the file if there is none

  Hdf5File(const std::string& path, Mode mode, MPI_Comm communicator);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

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
  struct Handle;
  std::unique_ptr<Handle> handle_;
  std::string path_;
};

}  // namespace suffuse
