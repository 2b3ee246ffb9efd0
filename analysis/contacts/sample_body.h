#pragma once

#include <array>
#include <string>

#include "contacts/snapshot.h"
#include "suffuse/micromechanics/sample_extent.h"

namespace suffuse::analysis {

/// Which body a snapshot's sample is: the box, the volume that was given, the bed or a region
/// (micromechanics/sample_extent.h).
class SampleBody {
 public:
  explicit SampleBody(const ReadSettings& settings) : settings_(&settings) {}

  /// The volume of the sample from its grains and its box, where the box is known; of all grains' bed, until
  /// restrict_to_region().
  void set_volume(micromechanics::Packing& packing, const std::array<bool, 3>& periodic);
  /// With a region: leaves grains outside of it out (micromechanics::part_inside), sets its volume and keeps
  /// the whole beside it.
  /// Throws UserError for a region without grains or less than those in it.
  void restrict_to_region(Snapshot& snapshot) const;
  /// That a box was taken that is another body than the bed; empty if none was.
  const std::string& note() const { return note_; }

 private:
  const ReadSettings* settings_;
  std::array<bool, 3> periodic_{};
  std::string note_;
};

/// Two notes on lines of their own, either of which may be empty.
std::string both_notes(const std::string& first, const std::string& second);

}  // namespace suffuse::analysis
