#pragma once

#include <string>
#include <utility>
#include <vector>

#include "suffuse/common/word_facts.h"
#include "suffuse/lbm/boundary.h"
#include "suffuse/lbm/fluid.h"

namespace suffuse::lbm {

/// Words that mean the same in a script's `lbm` lines and in the file of `suffuse-flow`.
inline constexpr NumberWord kDensityWord{"density", "RHO", "kg/m³", kPositive, "of the fluid"};
inline constexpr NumberWord kViscosityWord{"viscosity", "NU", "m²/s", kPositive, "kinematic"};
inline constexpr NumberWord kSpacingWord{"spacing", "DX", "m", kPositive, "edge of a cell"};
inline constexpr NumberWord kRelaxationTimeWord{"relaxation_time", "TAU", "", kPositive,
                                                "above 0.5: viscosity = (TAU - 1/2)/3 dx²/dt"};
inline constexpr NumberWord kTimestepWord{"timestep", "DT", "s", kPositive, "of the fluid"};
inline constexpr NumberWord kMaxVelocityWord{"max_velocity", "U", "m/s", kPositive,
                                             "the fastest flow expected"};
inline constexpr NumberWord kMachWord{"mach", "MA", "", kPositive, "U over the lattice's speed of sound"};
inline constexpr NumberWord kMagicWord{"magic", "LAMBDA", "", kPositive,
                                       "1e-4 to 100; ties the odd relaxation time to the even one"};
inline constexpr NumberWord kEveryWord{"every", "T", "s", kPositive, "between two, in whole fluid steps"};

inline constexpr const char* kPrecisionMeaning = "of the stored populations; `float` halves the memory";
inline constexpr const char* kIncompressibleMeaning = "He and Luo's equilibrium";

/// Words of the file of `suffuse-flow` alone.
inline constexpr NumberWord kPressureDifferenceWord{
    "pressure_difference", "P", "Pa", {}, "expected over the box: for the density difference"};
inline constexpr NumberWord kSmagorinskyWord{"smagorinsky", "C", "", kNotNegative,
                                             "0.1 to 0.2 for under-resolved flow; 0: none"};
inline constexpr NumberWord kFrequencyWord{"frequency", "F", "Hz", kNotNegative,
                                           "both times cos(2 pi F t); 0: constant"};
inline constexpr NumberWord kRampWord{"ramp", "T", "s", kNotNegative,
                                      "over which the value is reached from 0, linearly"};
inline constexpr NumberWord kTimeWord{"time", "T", "s", kPositive,
                                      "to run, from the start or from the state that was read"};
inline constexpr NumberWord kUntilSteadyWord{"until_steady", "SHARE", "", kPositive,
                                             "below 1: end early where the mean velocity changes by less "
                                             "than this share of itself in a tenth of the run"};

/// A table of that file and its keys. What the program reads and refuses, and the tables of
/// docs/lbm/suffuse-flow.md (by `suffuse-flow --words`), come from these alone.
struct FlowTable {
  std::string name;  ///< "boundary.FACE" for the table that a face may have
  std::string meaning;
  std::vector<WordFacts> words;
};
const std::vector<FlowTable>& flow_tables();

/// What `suffuse-flow --words` prints.
std::string flow_words_text();

std::vector<std::pair<std::string, Precision>> precision_words();
std::vector<std::pair<std::string, FaceKind>> face_kind_words();

}  // namespace suffuse::lbm
