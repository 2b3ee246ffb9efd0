#pragma once

#include <optional>
#include <vector>

#include "contacts/snapshot.h"
#include "files/record.h"
#include "suffuse/micromechanics/force_distribution.h"

namespace suffuse::analysis {

/// Which contacts are strong: those with f_N of at least …
enum class StrongThreshold {
  mean,    ///< the snapshot's own mean
  frozen,  ///< the mean of the first snapshot that has contacts (thesis §6.5.2)
  force    ///< a force given in N
};

struct MeasureSettings {
  std::optional<double> split;  ///< fines are smaller, m
  /// A contact slides where S ≥ 1 − tolerance. Not given: 1e-6 as in the run; 1e-5 for text of six digits,
  /// whose rounding moves S by up to that.
  std::optional<double> sliding_tolerance;
  StrongThreshold strong = StrongThreshold::mean;
  double strong_force = 0;   ///< N
  int axis = 2;              ///< of the deviator q, β's stays z − x as in App. F
  int rattler_contacts = 2;  ///< fewer: a rattler
  micromechanics::ForceBins force_bins;
};

/// The tolerance that a snapshot gets.
double sliding_tolerance(const MeasureSettings& settings, const Snapshot& snapshot);

/// Measures snapshots one after the other; keeps the frozen threshold. Formulas are those of micromechanics/.
class ContactMeasurer {
 public:
  explicit ContactMeasurer(const MeasureSettings& settings) : settings_(settings) {}

  /// One number a column; the same columns for every snapshot.
  Record measure(const Snapshot& snapshot);
  /// Of the last snapshot measured.
  const micromechanics::ForceDistribution& forces() const { return forces_; }

 private:
  double strong_threshold(double mean_force);

  MeasureSettings settings_;
  std::optional<double> frozen_;
  micromechanics::ForceDistribution forces_;
};

/// A split beside the sizes of the grains, a mistaken unit most likely. Throws UserError, of `who` and
/// `what`, where all grains are smaller, so that none is coarse; returns a warning where none is, so that
/// there are no fines, and nothing else. Of a region all grains of the snapshot count.
std::string warning_of_split(double split, const Snapshot& snapshot, const std::string& who,
                             const std::string& what);

/// The geometric mean of the two neighbouring diameters of a packing that are furthest apart as a ratio, m: a
/// split in the gap of a gap-graded soil. Throws UserError where the widest ratio is below 1.3: no gap.
double split_in_the_gap(const micromechanics::Packing& packing, const std::string& who);

/// The diameter between two sizes of a packing below which the share `finer` of the solid lies as nearly as
/// its sizes allow, m: the split of a fraction that is named by its mass. `finer` in (0, 1); throws UserError
/// where all grains are of one size.
double split_at_finer(const micromechanics::Packing& packing, double finer, const std::string& who);

}  // namespace suffuse::analysis
