#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/csv_cell.h"
#include "suffuse/study/study_launcher.h"

namespace suffuse::study {

/// Script variables with their values as `-var` takes them, in the order of the file.
using VariableValues = std::vector<std::pair<std::string, std::string>>;

/// Values of some variables of which every combination is run.
using SweepBlock = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// What is read from every run, and what it should be.
struct StudyQuantity {
  std::string name;
  analysis::CsvCell cell;           ///< file: relative to the folder of the run
  std::optional<double> reference;  ///< without one it is only reported, unless `by_finest`
  bool by_finest = false;           ///< the reference is what the finest run gives
  std::string source;               ///< where the reference is from
  double uncertainty = 0;           ///< of the reference, a share: no error counts as less
};

/// A run of another script before all others, whose files they may use.
struct Preparation {
  std::string script;
  VariableValues variables;
};

/// By which swept variable results are extrapolated to no spacing at all.
struct StudyExtrapolationRule {
  std::string variable;
  bool counts_cells = true;  ///< a number of cells, else a spacing
  double order = 2;          ///< of the method
};

/// What a study file asks for (docs/analysis/suffuse-study.md). Files are absolute.
struct Study {
  std::string file, title, script;
  int ranks = 1;
  StudyLauncher launcher;
  double time_limit = 0;       ///< seconds a run; 0: none
  double within = 0.03;        ///< the error that the study's last sentence asks for
  bool one_at_a_time = false;  ///< each variable by itself around `base`, instead of every combination
  VariableValues fixed, base;
  std::vector<SweepBlock> sweeps;
  VariableValues finest;  ///< swept variables of the run that is the reference; empty: none
  std::vector<StudyQuantity> quantities;
  std::optional<Preparation> preparation;
  std::optional<StudyExtrapolationRule> extrapolate;
};

/// Reads and checks a study file; references that are cells of CSV files are looked up. Nothing is run.
/// Throws UserError with the key that is wrong.
Study read_study(const std::string& path);

}  // namespace suffuse::study
