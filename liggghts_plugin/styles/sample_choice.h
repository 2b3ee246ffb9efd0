#ifndef SUFFUSE_SAMPLE_CHOICE_H
#define SUFFUSE_SAMPLE_CHOICE_H

#include <optional>
#include <string>

#include "pointers.h"
#include "style_support.h"
#include "suffuse/micromechanics/sample_extent.h"

namespace LAMMPS_NS {
class Region;
}

namespace suffuse {

/// What a compute takes for the sample, and whether walls count: the words `region ID`, `bed` and `walls
/// yes|no`. Without them the simulation box.
class SampleChoice {
 public:
  /// The words, for messages.
  static constexpr const char* kWords = "region, bed, walls";

  SampleChoice(LAMMPS_NS::LAMMPS* lmp, std::string who) : lmp_(lmp), who_(std::move(who)) {}

  /// Reads the values of `key` if it is one of the words; false if it is none.
  bool read(const std::string& key, ArgumentReader& reader);
  /// Throws UserError where the region does not exist, or has no bounds on an axis that is not periodic.
  void init();

  bool is_whole_box() const { return region_id_.empty() && !bed_; }
  bool is_region() const { return !region_id_.empty(); }
  /// Throws UserError if the region is no block.
  void require_block() const;
  bool walls = false;  ///< contacts with walls count in stresses

  /// Grains of the region, and its volume or that of the bed; the box becomes that of the region or the bed.
  /// Collective.
  micromechanics::Packing part_of(const micromechanics::Packing& packing);

  /// The simulation box, the bed's or the region's bounds, m. Collective.
  micromechanics::Box bounds(const micromechanics::Packing& packing) const;

  /// Says, once, that another body than the bed is taken for the sample. `axes`: those that the script has
  /// not settled otherwise. Collective.
  void tell_if_not_the_bed(const micromechanics::Packing& packing, const std::array<bool, 3>& axes);
  /// Says, once, that contacts with walls are left out, if there are any walls.
  void tell_if_walls_are_left_out();

 private:
  micromechanics::Box simulation_box(const micromechanics::Packing& packing) const;
  micromechanics::Box bed_of(const micromechanics::Packing& packing) const;
  micromechanics::Box region_box(const micromechanics::Box& simulation_box) const;
  double region_volume(const micromechanics::Box& own);

  LAMMPS_NS::LAMMPS* lmp_;
  std::string who_, region_id_;
  LAMMPS_NS::Region* region_ = nullptr;
  bool bed_ = false, told_bed_ = false, told_walls_ = false;
  std::optional<micromechanics::Box> measured_bounds_;  // of measured_volume_
  double measured_volume_ = 0;
};

}  // namespace suffuse

#endif
