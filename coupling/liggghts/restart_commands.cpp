#include "restart_commands.h"

#include <mpi.h>

#include <string>

#include "../commands/saved_set.h"
#include "lammps.h"
#include "read_restart.h"
#include "register_styles.h"
#include "restart_file.h"
#include "styles/scene_checks.h"
#include "suffuse/common/collective_text.h"
#include "suffuse/common/error.h"
#include "write_restart.h"

namespace suffuse::coupling {

namespace {

/// One file under a name as it stands: no pattern, and not a file a rank.
bool is_one_file(int narg, char** arg) {
  return narg > 0 && std::string(arg[0]).find_first_of("*%") == std::string::npos;
}

void read_restart(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg) {
  if (is_one_file(narg, arg))
    on_first_rank("read_restart", lmp->world, [&] { require_whole_restart_file(arg[0]); });
  LAMMPS_NS::ReadRestart(lmp).command(narg, arg);
  require_unique_grains(lmp, "read_restart");
}

void write_restart(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg) {
  LAMMPS_NS::WriteRestart(lmp).command(narg, arg);
  if (!is_one_file(narg, arg)) return;
  on_first_rank("write_restart", lmp->world, [&] {
    if (!is_whole_restart_file(arg[0]))
      throw_user_error({"write_restart", "file", arg[0], "take what is written", "is the disk full?"});
  });
}

}  // namespace

void add_restart_commands(LAMMPS_NS::LAMMPS* lmp) {
  add_command(lmp, "read_restart", &read_restart);
  add_command(lmp, "write_restart", &write_restart);
}

}  // namespace suffuse::coupling
