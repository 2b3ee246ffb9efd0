#include "register_styles.h"

#include <dlfcn.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "compute.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "neighbor.h"
#include "pair.h"
#include "read_data.h"
#include "replacements/fix_contact_history_vector.h"
#include "replacements/fix_nve_sphere_vector.h"
#include "replacements/neighbor_by_size.h"
#include "replacements/pair_gran_vector.h"
#include "replicate.h"
#include "run.h"
#include "signal_handling.h"
#include "styles/all_styles.h"
#include "styles/early_stop.h"
#include "styles/scene_checks.h"
#include "suffuse/common/error.h"
#include "suffuse/common/near_word.h"
#include "suffuse/common/processor_time.h"

namespace {

using namespace LAMMPS_NS;

using ComputeCreator = Compute* (*)(LAMMPS*, int, int, char**);
using FixCreator = Fix* (*)(LAMMPS*, int, char**);
using CommandCreator = void (*)(LAMMPS*, int, char**);

// LIGGGHTS keeps its maps of styles private. The arguments of an explicit template instantiation are exempt
// from access control ([temp.spec]), which is the one door the language leaves; it is used here and nowhere
// else.
template <class Tag, typename Tag::type Member>
struct Expose {
  friend typename Tag::type member_of(Tag) { return Member; }
};
struct ComputeMap {
  using type = std::map<std::string, ComputeCreator>* Modify::*;
  friend type member_of(ComputeMap);
};
struct FixMap {
  using type = std::map<std::string, FixCreator>* Modify::*;
  friend type member_of(FixMap);
};
struct CommandMap {
  using type = std::map<std::string, CommandCreator>* Input::*;
  friend type member_of(CommandMap);
};
template struct Expose<ComputeMap, &Modify::compute_map>;
template struct Expose<FixMap, &Modify::fix_map>;
template struct Expose<CommandMap, &Input::command_map>;

template <class Style>
Compute* make_compute(LAMMPS* lmp, int iarg, int narg, char** arg) {
  return new Style(lmp, iarg, narg, arg);
}
template <class Style>
Fix* make_fix(LAMMPS* lmp, int narg, char** arg) {
  return new Style(lmp, narg, arg);
}
template <class Style>
void make_command(LAMMPS* lmp, int narg, char** arg) {
  Style(lmp).command(narg, arg);
}

void read_data(LAMMPS* lmp, int narg, char** arg) {
  ReadData(lmp).command(narg, arg);
  suffuse::require_unique_grains(lmp, "read_data");
}

void replicate(LAMMPS* lmp, int narg, char** arg) {
  Replicate(lmp).command(narg, arg);
  suffuse::require_unique_grains(lmp, "replicate");
}

const std::map<std::string, ComputeCreator>& our_computes() {
  static const std::map<std::string, ComputeCreator> styles{
#define COMPUTE_CLASS
#define ComputeStyle(key, Class) {#key, &make_compute<Class>},
#include "styles/all_styles.h"
#undef ComputeStyle
#undef COMPUTE_CLASS
  };
  return styles;
}

const std::map<std::string, FixCreator>& our_fixes() {
  static const std::map<std::string, FixCreator> styles{
#define FIX_CLASS
#define FixStyle(key, Class) {#key, &make_fix<Class>},
#include "styles/all_styles.h"
#undef FixStyle
#undef FIX_CLASS
  };
  return styles;
}

const std::map<std::string, CommandCreator>& our_commands() {
  static const std::map<std::string, CommandCreator> styles{
#define COMMAND_CLASS
#define CommandStyle(key, Class) {#key, &make_command<Class>},
#include "styles/all_styles.h"
#undef CommandStyle
#undef COMMAND_CLASS
  };
  return styles;
}

suffuse::GrainLoop loop_in_use = suffuse::GrainLoop::vector;
std::map<std::string, CommandCreator> added_commands;  // for `clear`

/// Our neighbour lists and contact loop, under LIGGGHTS's names. Every class of LIGGGHTS reaches the lists
/// through a reference to the pointer that is changed here.
void install_grain_loop(LAMMPS* lmp) {
  delete lmp->neighbor;
  lmp->neighbor = new NeighborBySize(lmp);
  (*lmp->force->pair_map)["gran"] = [](LAMMPS* l) -> Pair* { return new PairGranVector(l); };
  (*(lmp->modify->*member_of(FixMap{})))["contacthistory"] = &make_fix<FixContactHistoryVector>;
  (*(lmp->modify->*member_of(FixMap{})))["nve/sphere"] = &make_fix<FixNVESphereVector>;
}

/// A UserError for a style that is not in the map, which names the one that was meant.
template <class Map>
void require_style(const Map* styles, const char* kind, char** arg, const char* suffix) {
  const std::string name = arg[2];
  if (styles->contains(name) || (suffix != nullptr && styles->contains(name + "/" + suffix))) return;
  if (name.starts_with("mesh/surface")) return;  // LIGGGHTS makes one kind of them all
  std::vector<std::string> names;
  for (const auto& [known, creator] : *styles) names.push_back(known);
  const std::string meant = suffuse::did_you_mean(name, names);
  suffuse::throw_user_error({std::string(kind) + " " + arg[0], "style", name, "be one that there is",
                             (meant.empty() ? "" : meant + " ") + "`suffuse --styles` lists ours"});
}

/// Words that LIGGGHTS's interpreter knows by itself, beside the commands of its map.
constexpr const char* kOwnWords =
    "angle_coeff angle_style atom_modify atom_style bond_coeff bond_style boundary box clear "
    "communicate compute compute_modify dielectric dihedral_coeff dihedral_style dimension dump "
    "dump_modify echo fix fix_modify force_dt_reset group hard_particles if improper_coeff "
    "improper_style include jump kspace_modify kspace_style label lattice log mass min_modify "
    "min_style modify_timing neighbor newton next package pair_coeff pair_modify pair_style "
    "pair_write partition print processors quit region reset_timestep restart run_style shell "
    "soft_particles special_bonds suffix thermo thermo_log thermo_modify thermo_style timestep "
    "uncompute undump unfix units variable write_restart_on_signal";

/// A UserError for a word that begins a line and is no command.
void refuse_command(const std::string& word, const std::map<std::string, CommandCreator>& commands) {
  std::istringstream own(kOwnWords);
  std::vector<std::string> names(std::istream_iterator<std::string>(own), {});
  for (const auto& [known, creator] : commands) names.push_back(known);
  const std::string meant = suffuse::did_you_mean(word, names);
  suffuse::throw_user_error({"script", "command", word, "be one of LIGGGHTS's or suffuse's",
                             (meant.empty() ? "" : meant + " ") + "`suffuse --styles` lists ours"});
}

}  // namespace

/// The library's own, after which a word that it does not know is told with the one that was meant. No
/// virtual function: this definition takes the place of the library's in `file()` and `if`.
int LAMMPS_NS::Input::execute_command() {
  using Function = int (*)(Input*);
  static const auto of_library =
      reinterpret_cast<Function>(dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS5Input15execute_commandEv"));
  if (of_library == nullptr) error->all(FLERR, "this LIGGGHTS has no Input::execute_command");
  const int code = of_library(this);
  if (code < 0) refuse_command(command, *(this->*member_of(CommandMap{})));
  return code;
}

/// The script's `clear` makes all of LIGGGHTS's parts anew, and would forget ours. It is no virtual function;
/// this definition takes the place of the library's (which does the same but for the last line).
void LAMMPS_NS::Input::clear() {
  if (narg > 0) error->all(FLERR, "Illegal clear command");
  lmp->destroy();
  lmp->create();
  lmp->post_create();
  suffuse::register_styles(lmp, loop_in_use);
}

/// The script's `fix` and `compute`, as the library has them, after a look at the style's name: LIGGGHTS's
/// own refusal names no other. No virtual functions either.
void LAMMPS_NS::Input::fix() {
  if (narg > 2) require_style(modify->*member_of(FixMap{}), "fix", arg, lmp->suffix);
  modify->add_fix(narg, arg, lmp->suffix);
}

void LAMMPS_NS::Input::compute() {
  if (narg > 2) require_style(modify->*member_of(ComputeMap{}), "compute", arg, lmp->suffix);
  modify->add_compute(narg, arg, lmp->suffix);
}

namespace suffuse {

void run_until_stopped(LAMMPS* lmp, int narg, char** arg) {
  EarlyStop::requested = false;
  tell_meshes_beyond_periodic_faces(lmp);
  tell_box_of_few_grains(lmp);
  const GrainCensus census(lmp);
  const double start = MPI_Wtime(), busy = processor_seconds();
  Run(lmp).command(narg, arg);
  LastRun::share = std::min(1., (processor_seconds() - busy) / std::max(1e-9, MPI_Wtime() - start));
  if (EarlyStop::requested) SignalHandler::request_quit = false;
  census.tell_lost();
}

void register_styles(LAMMPS* lmp, GrainLoop loop) {
  loop_in_use = loop;
  if (loop == GrainLoop::vector) install_grain_loop(lmp);
  for (const auto& [name, creator] : our_computes())
    (*(lmp->modify->*member_of(ComputeMap{})))[name] = creator;
  for (const auto& [name, creator] : our_fixes()) (*(lmp->modify->*member_of(FixMap{})))[name] = creator;
  auto& commands = *(lmp->input->*member_of(CommandMap{}));
  for (const auto& [name, creator] : our_commands()) commands[name] = creator;
  commands["run"] = &run_until_stopped;
  commands["read_data"] = &read_data;
  commands["replicate"] = &replicate;
  for (const auto& [name, creator] : added_commands) commands[name] = creator;
  EarlyStop::supported = true;
}

void add_command(LAMMPS* lmp, const std::string& name, CommandCreator command) {
  added_commands[name] = command;
  (*(lmp->input->*member_of(CommandMap{})))[name] = command;
}

std::vector<std::string> registered_styles() {
  std::vector<std::string> names;
  for (const auto& [name, creator] : our_computes()) names.push_back("compute " + name);
  for (const auto& [name, creator] : our_fixes()) names.push_back("fix " + name);
  for (const auto& [name, creator] : our_commands()) names.push_back("command " + name);
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace suffuse
