#pragma once

#include <string>
#include <vector>

namespace suffuse {

/// The vector instructions that a kernel was compiled for. All that the compiler knows are in the program.
enum class InstructionSet { portable, avx2, avx512 };

std::string name_of(InstructionSet instruction_set);

/// Those that this machine can run, the widest last. Never empty: `portable` runs everywhere.
std::vector<InstructionSet> available_instruction_sets();

/// The widest that this machine can run, or the one that the environment variable SUFFUSE_INSTRUCTION_SET
/// names; a UserError if that one is unknown or cannot run here.
InstructionSet default_instruction_set();

}  // namespace suffuse
