#pragma once

// What the sources of Hdf5File share.

#include <hdf5.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "suffuse/common/hdf5_file.h"

namespace suffuse {

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

/// Adds where a dataset's values lie in its file.
void add_bytes_of(hid_t dataset, std::vector<ArrayBytes>& all);

inline void ensure(herr_t status, const std::string& what) {
  if (status < 0) throw std::runtime_error("HDF5: cannot " + what);
}

struct Hdf5File::Handle {
  hid_t file = -1;
  MPI_Comm communicator = MPI_COMM_NULL;
  bool reads = false;
  Hdf5Growth* growth = nullptr;                        ///< until the file has closed
  std::vector<ArrayBytes> new_arrays, removed_arrays;  ///< of a file that grows
  bool spoilt = false;                                 ///< a write has failed on some rank
};

}  // namespace suffuse
