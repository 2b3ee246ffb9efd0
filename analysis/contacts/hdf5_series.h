#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contacts/sample_body.h"
#include "contacts/snapshot.h"

namespace suffuse::analysis {

/// Reads what `lbm output … grains` writes, and contacts beside it:
///
///     /step_N                    attribute time_s (s, optional)
///     /step_N/grains/id          (G)      whole numbers ≥ 1, each once
///     /step_N/grains/radius      (G)      m
///     /step_N/grains/position    (G, 3)   m
///     /step_N/contacts/ids       (C, 2)   identifiers of the two grains
///     /step_N/contacts/force     (C, 3)   on the first grain, N
///     /step_N/contacts/branch    (C, 3)   centre of the second to centre of the first, nearest image, m;
///     without
///                                         it from the positions
///     /step_N/contacts/friction  (C)      coefficient (optional)
///     /step_N/contacts/friction_limit (C), spring_force (C)   of the contact law's tangential spring, N
///                                         (optional: from force and friction)
///     /step_N/box                (2, 3)   low and high corner, m (optional with a given volume)
///     /step_N/periodic           (3)      0 or 1 an axis (optional: not periodic)
///
/// Numbers may be of any type that HDF5 turns into doubles. Snapshots without contacts are left out.
class Hdf5Series : public SnapshotSeries {
 public:
  Hdf5Series(std::string path, ReadSettings settings);
  ~Hdf5Series() override;

  bool next(Snapshot& snapshot) override;
  double done() const override;
  std::int64_t bytes() const override { return bytes_; }
  std::string notes() const override;

  static bool is_hdf5(const std::string& path);

 private:
  struct File;
  [[noreturn]] void complain(const std::string& problem, const std::string& remedy) const;
  std::vector<double> numbers(const std::string& dataset, std::size_t columns) const;
  std::array<bool, 3> read_box(micromechanics::Packing& packing) const;
  std::int64_t identifier_of(double value) const;
  void read_grains(micromechanics::Packing& packing) const;
  void read_contacts(micromechanics::Packing& packing, const Vec3& period) const;

  std::string path_;
  ReadSettings settings_;
  SampleBody sample_{settings_};
  std::unique_ptr<File> file_;
  std::vector<std::string> groups_;
  std::string group_;  ///< of the current snapshot, "/step_N"
  std::size_t next_ = 0, left_out_ = 0;
  std::int64_t bytes_ = 0;
};

}  // namespace suffuse::analysis
