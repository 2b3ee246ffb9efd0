#pragma once

#include <string>

#include "suffuse/study/study_file.h"
#include "suffuse/study/study_table.h"

namespace suffuse::study {

/// How a study is run.
struct StudyRunSettings {
  std::string out;      ///< folder of the runs and the results
  std::string program;  ///< suffuse; empty: beside this program, or on PATH
  int cores = 0;        ///< that runs may take together; 0: those of one run
  StudyTime time = StudyTime::wall;
  bool resume = false, retry_failed = false, dry_run = false, figure = true;
};

/// Runs what a study asks for, as many at once as the cores hold, each in a folder of its own
/// (OUT/runs/NAME), and leaves
/// OUT/study.csv, OUT/study.png and a table on the screen. Runs that have ended are taken as they are with
/// `resume`. Returns the exit code: 0, or 128 and the signal's number where it was interrupted. Throws
/// UserError for what is wrong with the study.
int run_study(const Study& study, const StudyRunSettings& settings);

}  // namespace suffuse::study
