#pragma once

#include <optional>
#include <string>
#include <vector>

namespace suffuse::analysis {

/// A row of the thesis's Table 4.1 or 5.1: an isotropic sample at 200 kPa. What a table does not have is not
/// there.
struct ThesisRow {
  std::string sample;                  ///< "8b", "A(30%)"
  std::string state;                   ///< loose, medium, dense
  double relative_density = 0;         ///< 0 to 1
  std::optional<double> kezdi;         ///< max D15c/d85f
  std::optional<double> constriction;  ///< Dc35/d85f (Indraratna 2011)
  std::optional<double> kenney_lau;    ///< (H/F)min
  std::optional<double> grains;
  std::optional<double> porosity;
  std::optional<double> void_ratio;
  std::optional<double> coordination;  ///< Z, rattlers included
  std::optional<double> alpha;         ///< Shire's, by pair halves
  std::string experiment;              ///< stable, unstable, or empty
  std::string note;                    ///< what is doubtful in the row
};

/// As in analysis/data/thesis_table_4_1.csv and thesis_table_5_1.csv, which are compiled in.
const std::vector<ThesisRow>& thesis_table_4_1();
const std::vector<ThesisRow>& thesis_table_5_1();

}  // namespace suffuse::analysis
