// Lines of `lbm` in a script, read into settings; whatever is refused leaves them as they were.

#include <mpi.h>

#include <cstdlib>
#include <sstream>
#include <vector>

#include "commands/lbm_words.h"
#include "fuzz_input.h"
#include "input.h"
#include "lammps.h"

using namespace suffuse;
using coupling::LbmRequest;

namespace {

LAMMPS_NS::LAMMPS* lmp = nullptr;

void read_line(const std::string& line, LbmRequest& settings) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  if (words.size() > 1 && words[0] == "lbm") words.erase(words.begin());
  if (words.empty()) return;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  ArgumentReader reader("lbm " + words[0], static_cast<int>(arguments.size()), arguments.data(), 1);
  fuzz::refused_or_read([&] { coupling::read_request(words[0], reader, lmp, settings); });
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
  LbmRequest settings;
  for (std::string line; std::getline(lines, line);) read_line(line, settings);
  return fuzz::refused_or_read([&] {
    if (!settings.lattice_given) return;
    coupling::settings_now(settings, lmp);
    coupling::values_change(settings);
    for (const auto& output : settings.outputs) coupling::files_of(output);
  });
}
