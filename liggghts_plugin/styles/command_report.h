#ifdef COMMAND_CLASS

// clang-format off
CommandStyle(report, CommandReport)
// clang-format on

#else

#ifndef SUFFUSE_COMMAND_REPORT_H
#define SUFFUSE_COMMAND_REPORT_H

#include "pointers.h"

namespace LAMMPS_NS {

/// report EXPECTED.csv CASE [write RESULT.csv] values NAME VALUE NAME VALUE ...
///
/// Prints a table of measured against expected values. Page: docs/reference/report.md.
class CommandReport : protected Pointers {
 public:
  explicit CommandReport(LAMMPS* lmp_in) : Pointers(lmp_in) {}
  void command(int narg, char** arg);
};

}  // namespace LAMMPS_NS

#endif
#endif
