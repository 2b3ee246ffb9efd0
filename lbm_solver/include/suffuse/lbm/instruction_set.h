#pragma once

#include "suffuse/simd/instruction_set.h"

namespace suffuse::lbm {

using suffuse::available_instruction_sets;
using suffuse::default_instruction_set;
using suffuse::InstructionSet;
using suffuse::name_of;

}  // namespace suffuse::lbm
