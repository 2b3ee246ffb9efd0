#include "grains_file.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include "../commands/saved_set.h"
#include "atom.h"
#include "domain.h"
#include "lammps.h"
#include "restart_file.h"
#include "suffuse/common/collective_text.h"
#include "suffuse/common/error.h"
#include "write_restart.h"

namespace suffuse::coupling {

namespace {

/// Writes with all grains inside of a periodic box. Between two neighbour lists a grain may stand outside,
/// where no rank that reads the file would take it; its neighbours know it there, so that it is put back.
void write_wrapped(LAMMPS_NS::LAMMPS* lmp, char* file) {
  LAMMPS_NS::Atom& atom = *lmp->atom;
  const auto grains = static_cast<std::size_t>(atom.nlocal);
  double *x = grains > 0 ? atom.x[0] : nullptr, *v = grains > 0 ? atom.v[0] : nullptr;
  const std::vector<double> positions(x, x + 3 * grains), velocities(v, v + 3 * grains);
  const std::vector images(atom.image, atom.image + grains);
  lmp->domain->pbc();
  LAMMPS_NS::WriteRestart(lmp).write(file);
  std::copy(positions.begin(), positions.end(), x);
  std::copy(velocities.begin(), velocities.end(), v);
  std::copy(images.begin(), images.end(), atom.image);
}

}  // namespace

/// LIGGGHTS does not check what it writes: its file goes to memory, and from there to the disk.
void write_grains_file(LAMMPS_NS::LAMMPS* lmp, const std::string& path, const std::string& who) {
  int memory = -1;
  on_first_rank(who, lmp->world, [&] {
    memory = memfd_create("grains", MFD_CLOEXEC);
    if (memory < 0) throw_user_error({who, "file", path, "find memory for the grains", std::strerror(errno)});
  });
  std::string in_memory = fmt::format("/proc/self/fd/{}", memory);
  write_wrapped(lmp, in_memory.data());
  on_first_rank(who, lmp->world, [&] {
    const bool whole = is_whole_restart_file(in_memory);
    if (whole) write_checked(memory, path, who);
    close(memory);
    if (!whole)
      throw_user_error({who, "grains", path, "be written whole by LIGGGHTS", "is there memory for them?"});
  });
}

}  // namespace suffuse::coupling
