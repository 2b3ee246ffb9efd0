#pragma once

#include <mpi.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "suffuse/common/hdf5_file.h"
#include "suffuse/coupling/coupled_simulation.h"

namespace suffuse::coupling {

/// What later samples of monitors refer to, by monitor and columns: first values, counts at the start.
using MonitorReferences = std::map<std::string, std::vector<double>>;

/// Adds to a saved fluid the settings that may not change while it lives, and the monitors' references.
/// Collective.
void save_settings(Hdf5File& file, const CoupledSimulation& simulation);
void save_references(Hdf5File& file, const MonitorReferences& references, MPI_Comm communicator);

/// The part of automatic coefficients that belongs to the cells. Loading leaves a simulation without them as
/// it is, and one whose file has none to survey anew. Collective.
void save_pore_coefficients(Hdf5File& file, const CoupledSimulation& simulation);
void load_pore_coefficients(const std::string& path, CoupledSimulation& simulation);

/// Which cells lie behind walls, with the walls that this is true for; nothing without walls. Collective.
void save_walls(Hdf5File& file, const CoupledSimulation& simulation);
/// The cells that a state was saved with, one value a cell of this rank as lbm::Walls::closed, if it was
/// saved with these walls (CoupledSimulation::acting_walls). Collective.
std::optional<std::vector<std::uint8_t>> load_closed_cells(const std::string& path,
                                                           const lbm::Decomposition& decomposition,
                                                           const std::string& acting_walls);

/// A UserError for the first setting that the file was saved with and this simulation has otherwise; those
/// of `lbm fluid`, `lattice`, `collision`, `solid` and `effect` (as `auto` decided) are compared. False if
/// the file says nothing about them. Collective.
bool require_same_settings(const std::string& path, const CoupledSimulation& simulation);

/// None if the file has none. Collective.
MonitorReferences load_references(const std::string& path, MPI_Comm communicator);

/// What a method of its own for the water (water_method.h) keeps, and back. A UserError if the state was
/// saved with another one. Collective.
void save_method(Hdf5File& file, const CoupledSimulation& simulation);
void load_method(const std::string& path, CoupledSimulation& simulation);

}  // namespace suffuse::coupling
