#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contacts/contact_columns.h"
#include "contacts/dump_file.h"
#include "contacts/sample_body.h"
#include "contacts/snapshot.h"

namespace suffuse::analysis {

/// Dump files of one kind as one row of snapshots with rising steps; one file is open at a time.
class DumpChain {
 public:
  DumpChain(std::vector<std::string> files, std::string who);

  /// Moves to the next snapshot's header; false after the last.
  bool next();
  const DumpHeader& header() const { return header_; }
  DumpFile& file() { return *file_; }
  std::int64_t bytes_read() const;

 private:
  std::deque<std::string> files_;
  std::string who_;
  std::unique_ptr<DumpFile> file_;
  DumpHeader header_;
  bool started_ = false;
  std::int64_t bytes_of_past_files_ = 0;
};

/// Pairs the snapshots of grains and of contacts that have the same step; those without a partner are left
/// out and counted in notes().
class DumpSeries : public SnapshotSeries {
 public:
  DumpSeries(std::vector<std::string> grain_files, std::vector<std::string> contact_files,
             ReadSettings settings, std::int64_t bytes);

  bool next(Snapshot& snapshot) override;
  double done() const override;
  std::int64_t bytes() const override { return bytes_; }
  std::string notes() const override;

 private:
  bool find_common_step();
  void read_grains(micromechanics::Packing& packing);
  void read_contacts(Snapshot& snapshot);
  micromechanics::Contact contact_of(std::span<const double> row, const ColumnPlan& plan,
                                     const micromechanics::Packing& packing);
  int grain_of(double id);

  ReadSettings settings_;
  SampleBody sample_{settings_};
  DumpChain grains_, contacts_;
  std::int64_t bytes_, alone_grains_ = 0, alone_contacts_ = 0, pairs_ = 0;
  std::vector<int> index_of_id_;  ///< −1: no such grain
  bool grains_have_positions_ = false;
  std::size_t digits_ = 0;  ///< most digits that a radius of this snapshot has
};

}  // namespace suffuse::analysis
