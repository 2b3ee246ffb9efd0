#pragma once

#include <string>
#include <vector>

#include "suffuse/study/study_file.h"

namespace suffuse::study {

/// One run of a study.
struct StudyCase {
  VariableValues swept;  ///< every swept variable, in the order in which the file names them first
  std::string name;      ///< of its folder: "resolution=5,precision=float"
  bool is_reference = false;
};

/// Names of all swept variables, in the order in which they come first.
std::vector<std::string> swept_names(const Study& study);

/// The runs: every combination of each block (the last variable fastest), or the base and each value of each
/// variable around it; a combination that comes twice is one run. Variables that a block leaves out have
/// their value of `base`. The finest run stands last, or where it is one of the others. Throws UserError
/// where a value is missing.
std::vector<StudyCase> study_cases(const Study& study);

/// "resolution=5, precision=float".
std::string variables_text(const VariableValues& variables);

}  // namespace suffuse::study
