// Lines of `lbm` in a script, read into settings; whatever is refused leaves them as they were.

#include <mpi.h>

#include <cstdlib>
#include <functional>
#include <map>
#include <sstream>
#include <vector>

#include "commands/lbm_settings.h"
#include "fuzz_input.h"
#include "input.h"
#include "lammps.h"

using namespace suffuse;
using coupling::LbmSettings;

namespace {

LAMMPS_NS::LAMMPS* lmp = nullptr;

const std::map<std::string, std::function<void(ArgumentReader&, LbmSettings&)>>& commands() {
  static const std::map<std::string, std::function<void(ArgumentReader&, LbmSettings&)>> all{
      {"preset", coupling::read_preset},
      {"fluid", coupling::read_fluid},
      {"lattice", coupling::read_lattice},
      {"boundary", [](ArgumentReader& r, LbmSettings& s) { coupling::read_boundary(r, lmp, s); }},
      {"force", [](ArgumentReader& r, LbmSettings& s) { coupling::read_force(r, lmp, s); }},
      {"collision", coupling::read_collision},
      {"solid", coupling::read_solid},
      {"walls", coupling::read_walls},
      {"effect", coupling::read_effect},
      {"couple", coupling::read_couple},
      {"monitor", coupling::read_monitor},
      {"output", coupling::read_output}};
  return all;
}

void read_line(const std::string& line, LbmSettings& settings) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  if (words.size() > 1 && words[0] == "lbm") words.erase(words.begin());
  if (words.empty() || commands().count(words[0]) == 0) return;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  ArgumentReader reader("lbm " + words[0], static_cast<int>(arguments.size()), arguments.data(), 1);
  fuzz::refused_or_read([&] { commands().at(words[0])(reader, settings); });
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  MPI_Init(argc, argv);
  std::vector<std::string> words{"fuzz", "-screen", "none", "-log", "none"};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  lmp = new LAMMPS_NS::LAMMPS(static_cast<int>(arguments.size()), arguments.data(), MPI_COMM_WORLD);
  lmp->input->one("variable p equal 3.5");
  std::atexit([] { MPI_Finalize(); });
  return 0;
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream lines{std::string(fuzz::text_of(data, size))};
  LbmSettings settings;
  for (std::string line; std::getline(lines, line);) read_line(line, settings);
  return fuzz::refused_or_read([&] {
    if (!settings.fluid_given || !settings.lattice_given) return;
    const lbm::Units units(settings.coupled.units);
    coupling::gravity_now(settings, units, lmp);
    coupling::pressure_gradient_now(settings, units, lmp);
    coupling::values_change(settings);
    for (const auto& output : settings.outputs) coupling::files_of(output);
  });
}
