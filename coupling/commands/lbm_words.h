#pragma once

#include <string>
#include <vector>

#include "declared_words.h"
#include "lbm_request.h"
#include "suffuse/coupling/method_errors.h"

namespace suffuse::coupling {

/// Every kind of line of `lbm`, in the order of docs/reference/lbm.md: what the program reads, its help and
/// the page's tables come from the same declarations.
const std::vector<CommandFacts>& lbm_commands();

/// The one of that name; a UserError that lists them if there is none.
const CommandFacts& lbm_command(const std::string& name);

/// Reads the words after `lbm NAME` into the request. False, and nothing read, if NAME is a line that asks
/// for something to be done at once. A UserError for words that the line has not and values that cannot work:
/// the request stays as it was.
bool read_request(const std::string& name, ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp,
                  LbmRequest& request);

/// `lbm run [until] TIME [until steady SHARE [window T]]`
struct RunLine {
  double time = 0;  ///< s
  bool until = false;
  std::optional<double> steady;
  double window = 0;  ///< s; 0: of the run's choice
};
RunLine read_run(ArgumentReader& reader);

/// `lbm plan TIME`
double read_plan(ArgumentReader& reader);

/// `lbm accuracy 3%|none [of QUANTITY] [max_velocity U] [region ID] [write FILE]`
struct AccuracyRequest {
  std::optional<double> accuracy;  ///< a share; none: `lbm lattice` stands as it was written
  AccuracyOf of = AccuracyOf::permeability;
  std::optional<double> largest_velocity;  ///< m/s; else from what drives water and grains
  std::string region;
  std::string file;  ///< for the script's variables; empty: none
};
AccuracyRequest read_accuracy(ArgumentReader& reader);

/// `lbm restart write FILE [every T] | read FILE`
struct RestartLine {
  bool read = false;
  std::string file;
  std::optional<double> every;  ///< s
};
RestartLine read_restart(ArgumentReader& reader);

/// `lbm stop after TIME`
WallLimit read_stop(ArgumentReader& reader);

/// The end of a line that has no words.
void read_nothing(ArgumentReader& reader);

/// What must be the same where a saved state is taken up, as text. `line` of `lbm`, name of the word.
struct KeptWord {
  std::string line, name, value;
};
std::vector<KeptWord> kept_words(const SettingsOfState& state);

}  // namespace suffuse::coupling
