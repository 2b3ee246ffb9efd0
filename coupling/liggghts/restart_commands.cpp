#include "restart_commands.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>

#include "../commands/saved_set.h"
#include "comm.h"
#include "domain.h"
#include "grains_file.h"
#include "lammps.h"
#include "read_restart.h"
#include "register_styles.h"
#include "restart_file.h"
#include "restart_instant.h"
#include "saving_verlet.h"
#include "styles/scene_checks.h"
#include "suffuse/common/collective_text.h"
#include "suffuse/common/safe_file.h"
#include "write_restart.h"

namespace suffuse::coupling {

namespace {

/// One file under a name as it stands: no pattern, and not a file a rank.
bool is_one_file(int narg, char** arg) {
  return narg > 0 && std::string(arg[0]).find_first_of("*%") == std::string::npos;
}

/// LIGGGHTS shares a box among ranks by its shape, which a servo changes: what was written on as many ranks
/// is read on the grid that it was written on, as far as the script's `processors` leaves that open. Gives
/// what the script asked for.
std::array<int, 3> ask_for_rank_grid(LAMMPS_NS::LAMMPS* lmp, const std::string& file) {
  std::array<int, 3> asked{}, grid{};
  std::copy_n(lmp->comm->user_procgrid, 3, asked.begin());
  if (lmp->comm->me == 0) grid = rank_grid_of(file, lmp->comm->nprocs).value_or(grid);
  MPI_Bcast(grid.data(), 3, MPI_INT, 0, lmp->world);
  bool allowed = grid[0] > 0;
  for (std::size_t a = 0; a < 3; ++a) allowed = allowed && (asked[a] == 0 || asked[a] == grid[a]);
  if (allowed) std::copy_n(grid.begin(), 3, lmp->comm->user_procgrid);
  return asked;
}

void read_restart(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg) {
  std::array<int, 3> asked{};
  std::copy_n(lmp->comm->user_procgrid, 3, asked.begin());
  if (is_one_file(narg, arg)) {
    on_first_rank("read_restart", lmp->world, [&] { require_whole_restart_file(arg[0]); });
    asked = ask_for_rank_grid(lmp, arg[0]);
  }
  LAMMPS_NS::ReadRestart(lmp).command(narg, arg);
  std::copy_n(asked.begin(), 3, lmp->comm->user_procgrid);
  require_unique_grains(lmp, "read_restart");
}

/// What is there stays until what takes its place is whole and on the disk.
void write_restart(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg) {
  if (lmp->domain->box_exist == 0 || narg != 1 || !is_one_file(narg, arg)) {
    LAMMPS_NS::WriteRestart(lmp).command(narg, arg);
    return;
  }
  constexpr const char* who = "write_restart";
  const std::string file = arg[0], part = file + ".part";
  on_first_rank(who, lmp->world, [&] {
    require_replaceable(file, who);
    if (const auto folder = std::filesystem::path(file).parent_path(); !folder.empty())
      std::filesystem::create_directories(folder);
    if (lmp->screen != nullptr) fmt::print(lmp->screen, "System init for write_restart ...\n");
  });
  put_grains_in_order(lmp);
  write_grains_file(lmp, part, who);
  on_first_rank(who, lmp->world, [&] { std::filesystem::rename(part, file); });
}

}  // namespace

void add_restart_commands(LAMMPS_NS::LAMMPS* lmp) {
  add_command(lmp, "read_restart", &read_restart);
  add_command(lmp, "write_restart", &write_restart);
  add_command(lmp, "restart_set", &restart_set);
  add_command(lmp, "run", &run_watched);
}

}  // namespace suffuse::coupling
