#include "checkpoint_contents.h"

#include <fmt/format.h>
#include <mpi.h>

#include "lbm_words.h"
#include "suffuse/common/error.h"
#include "suffuse/lbm/cell_array.h"

namespace suffuse::coupling {

namespace {

constexpr const char* kSettings = "/settings";
constexpr const char* kReferences = "/monitor_references";
constexpr const char* kPoreCoefficients = "/pore_coefficients";
constexpr const char* kMethod = "/method";
constexpr const char* kWalls = "/walls";
constexpr const char* kActingWalls = "/walls/acting";  ///< a text, character by character
constexpr const char* kClosedCells = "/walls/closed_cells";

std::vector<KeptWord> settings_of(const CoupledSimulation& simulation) {
  const lbm::Units& units = simulation.units();
  std::vector<KeptWord> settings = kept_words({units, simulation.settings()});
  for (int a = 0; a < 3; ++a)
    settings.push_back({"lattice", fmt::format("low corner along {}", "xyz"[a]),
                        fmt::format("{:.6g} cells", simulation.origin()[a] / units.spacing())});
  return settings;
}

std::string key(const KeptWord& setting) {
  const bool averaged = setting.line == "method";  // as states have been written ever since
  return setting.line + (averaged ? " averaged " : " ") + setting.name;
}

}  // namespace

void save_settings(Hdf5File& file, const CoupledSimulation& simulation) {
  file.create_group(kSettings);
  for (const KeptWord& setting : settings_of(simulation))
    file.set_attribute(kSettings, key(setting), setting.value);
}

bool require_same_settings(const std::string& path, const CoupledSimulation& simulation) {
  const Hdf5File file(path, Hdf5File::Mode::read, simulation.fluid().decomposition().communicator());
  const bool averaged = simulation.settings().averaged.has_value();
  if (file.exists(kMethod) != averaged)
    throw_user_error({"lbm restart read " + path, "method", averaged ? "averaged" : "resolved",
                      averaged ? "be resolved, as it was saved" : "be averaged, as it was saved",
                      "write the same `lbm method`"});
  if (!file.exists(kSettings)) return false;
  for (const KeptWord& setting : settings_of(simulation)) {
    const std::string saved = file.text_attribute(kSettings, key(setting));
    if (saved != setting.value)
      throw_user_error(
          {"lbm restart read " + path, key(setting), setting.value,
           fmt::format("be {}, as it was saved", saved),
           fmt::format("write the same `lbm {}`; values of boundary and force, couple, monitor, output "
                       "and restart write may differ",
                       setting.line)});
  }
  return true;
}

void save_pore_coefficients(Hdf5File& file, const CoupledSimulation& simulation) {
  const std::vector<float> values = simulation.pore_coefficients();
  if (values.empty()) return;
  const ArrayPart cells = lbm::cells_of(simulation.fluid().decomposition());
  file.create_array<float>(kPoreCoefficients, cells.whole);
  file.write(kPoreCoefficients, cells, values);
}

void load_pore_coefficients(const std::string& path, CoupledSimulation& simulation) {
  const lbm::Decomposition& d = simulation.fluid().decomposition();
  const Hdf5File file(path, Hdf5File::Mode::read, d.communicator());
  if (!simulation.settings().solids.automatic_coefficient || !file.exists(kPoreCoefficients)) return;
  simulation.set_pore_coefficients(file.read<float>(kPoreCoefficients, lbm::cells_of(d)));
}

void save_walls(Hdf5File& file, const CoupledSimulation& simulation) {
  const std::string& acting = simulation.acting_walls();
  if (acting.empty()) return;
  const lbm::Decomposition& d = simulation.fluid().decomposition();
  file.create_group(kWalls);
  file.create_array<std::uint8_t>(kActingWalls, {acting.size()});
  const std::vector<std::uint8_t> text(acting.begin(), d.rank() == 0 ? acting.end() : acting.begin());
  file.write(kActingWalls, {{acting.size()}, {0}, {text.size()}}, text);
  std::vector<std::uint8_t> closed;
  closed.reserve(d.local_box().volume());
  lbm::for_each_cell(d.local_box(), [&](int x, int y, int z) {
    closed.push_back(simulation.fluid().is_closed({x, y, z}) ? 1 : 0);
  });
  const ArrayPart cells = lbm::cells_of(d);
  file.create_array<std::uint8_t>(kClosedCells, cells.whole);
  file.write(kClosedCells, cells, closed);
}

std::optional<std::vector<std::uint8_t>> load_closed_cells(const std::string& path,
                                                           const lbm::Decomposition& decomposition,
                                                           const std::string& acting_walls) {
  const Hdf5File file(path, Hdf5File::Mode::read, decomposition.communicator());
  if (!file.exists(kWalls) || acting_walls.empty()) return std::nullopt;
  const std::size_t size = file.extents(kActingWalls).at(0);
  const auto saved = file.read<std::uint8_t>(kActingWalls, {{size}, {0}, {size}});
  if (std::string(saved.begin(), saved.end()) != acting_walls) return std::nullopt;
  const ArrayPart cells = lbm::cells_of(decomposition);
  if (file.extents(kClosedCells) != cells.whole) return std::nullopt;
  return file.read<std::uint8_t>(kClosedCells, cells);
}

void save_method(Hdf5File& file, const CoupledSimulation& simulation) {
  if (simulation.method() == nullptr) return;
  file.create_group(kMethod);
  const bool mine = simulation.fluid().decomposition().rank() == 0;  // the same on all ranks
  for (const auto& [name, values] : simulation.method()->state()) {
    const std::string array = fmt::format("{}/{}", kMethod, name);
    file.create_array<double>(array, {values->size()});
    file.write(array, {{values->size()}, {0}, {mine ? values->size() : 0}},
               mine ? *values : std::vector<double>{});
  }
}

void load_method(const std::string& path, CoupledSimulation& simulation) {
  if (simulation.method() == nullptr) return;
  const Hdf5File file(path, Hdf5File::Mode::read, simulation.fluid().decomposition().communicator());
  for (const auto& [name, values] : simulation.method()->state()) {
    const std::size_t size = values->size();
    *values = file.read<double>(fmt::format("{}/{}", kMethod, name), {{size}, {0}, {size}});
  }
}

void save_references(Hdf5File& file, const MonitorReferences& references, MPI_Comm communicator) {
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  file.create_group(kReferences);
  int n = 0;
  for (const auto& [columns, values] : references) {
    if (values.empty()) continue;
    const std::string array = fmt::format("{}/{}", kReferences, n++);
    file.create_array<double>(array, {values.size()});
    const std::vector<double> mine = rank == 0 ? values : std::vector<double>{};  // the same on all ranks
    file.write(array, {{values.size()}, {0}, {mine.size()}}, mine);
    file.set_attribute(array, "columns", columns);
  }
}

MonitorReferences load_references(const std::string& path, MPI_Comm communicator) {
  const Hdf5File file(path, Hdf5File::Mode::read, communicator);
  MonitorReferences references;
  if (!file.exists(kReferences)) return references;
  for (const std::string& name : file.names_in(kReferences)) {
    const std::string array = fmt::format("{}/{}", kReferences, name);
    const std::size_t count = file.extents(array).at(0);
    references[file.text_attribute(array, "columns")] = file.read<double>(array, {{count}, {0}, {count}});
  }
  return references;
}

}  // namespace suffuse::coupling
