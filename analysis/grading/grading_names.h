#pragma once

#include <optional>
#include <string>

namespace suffuse::analysis {

/// A sample of the thesis whose grading is known: a row of input_scripts/gradings/samples.csv.
struct NamedGrading {
  std::string name;                  ///< B20
  std::string path;                  ///< of its grading
  std::string table_4_1, table_5_1;  ///< its names in the thesis's tables; may be empty
  double thesis_grains = 0;          ///< printed number of grains
};

/// Found by its name or one of the thesis's, "7b", "B(20%)"; none otherwise. The table is looked for in
/// $SUFFUSE_GRADINGS, the installation and the source tree.
std::optional<NamedGrading> named_grading(const std::string& name, const std::string& who);

/// A file of this name, or else the file of a named grading. Throws UserError, with the names there are,
/// where it is neither.
std::string grading_path(const std::string& name, const std::string& who);

}  // namespace suffuse::analysis
