#pragma once

#include <cstdint>
#include <string>

#include "suffuse/common/safe_file.h"
#include "suffuse/micromechanics/grain_sample.h"

namespace suffuse::analysis {

/// What a scene needs to know of a sample.
struct SampleScript {
  std::string title;  ///< first line: what it is and how it was made
  micromechanics::GrainSample sample;
  double box_edge = 0;               ///< m, of the cube that the grains are placed in
  double box_height = 0;             ///< m, along z where that is another; 0: a cube
  std::string name;                  ///< of the grading
  std::string table_4_1, table_5_1;  ///< its names in the thesis's tables; may be empty
};

/// LIGGGHTS variables, each of which `-var` on the command line overrides: sample_name, sample_grains,
/// coarse_grains, split, fines_share, box_edge, smallest_diameter, largest_diameter, sauter_diameter (m, the
/// size of equal surface per volume), solid_volume (m³, of all grains), skin; and row_table_4_1 and
/// row_table_5_1, lines for a file sample.toml (sample_folder.h) with the names in the thesis's tables or
/// "none".
void write_sample_variables(SafeFile& file, const SampleScript& script);

/// Particle templates and the distribution `grading`, to include once the box is there. The scene sets
/// ${density}, kg/m³, and ${distribution_seed}.
void write_sample_templates(SafeFile& file, const SampleScript& script);

/// The grains themselves, placed at random, for LIGGGHTS's read_data (atom_style granular).
void write_sample_data(SafeFile& file, const SampleScript& script, double density, std::uint64_t seed);

/// The classes as a grading that can be read again: diameter_m, mass_fraction, grains.
void write_sample_classes(SafeFile& file, const SampleScript& script);

}  // namespace suffuse::analysis
