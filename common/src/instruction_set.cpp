#include "suffuse/simd/instruction_set.h"

#include <algorithm>
#include <cstdlib>

#include "suffuse/common/error.h"

namespace suffuse {

std::string name_of(InstructionSet instruction_set) {
  switch (instruction_set) {
    case InstructionSet::portable:
      return "portable";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::avx512:
      return "avx512";
  }
  return "unknown";
}

std::vector<InstructionSet> available_instruction_sets() {
  std::vector<InstructionSet> sets{InstructionSet::portable};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) sets.push_back(InstructionSet::avx2);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
    sets.push_back(InstructionSet::avx512);
#endif
  return sets;
}

InstructionSet default_instruction_set() {
  const std::vector<InstructionSet> sets = available_instruction_sets();
  const char* wanted = std::getenv("SUFFUSE_INSTRUCTION_SET");
  if (wanted == nullptr || *wanted == '\0') return sets.back();
  const auto found =
      std::find_if(sets.begin(), sets.end(), [&](InstructionSet s) { return name_of(s) == wanted; });
  if (found != sets.end()) return *found;
  std::string names;
  for (InstructionSet s : sets) names += (names.empty() ? "" : ", ") + name_of(s);
  throw_user_error({"environment", "SUFFUSE_INSTRUCTION_SET", wanted, "be one of " + names, ""});
}

}  // namespace suffuse
