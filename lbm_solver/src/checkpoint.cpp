#include "suffuse/lbm/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "suffuse/common/collective_text.h"
#include "suffuse/common/error.h"
#include "suffuse/common/hdf5_file.h"
#include "suffuse/common/safe_file.h"
#include "suffuse/lbm/cell_array.h"
#include "suffuse/lbm/lattice.h"

namespace suffuse::lbm {

namespace {

std::size_t size(int n) {
  return static_cast<std::size_t>(n);
}

/// This rank's cells in an array (direction, z, y, x).
ArrayPart with_direction(const ArrayPart& cells, int direction) {
  ArrayPart part = cells;
  part.whole.insert(part.whole.begin(), kDirections);
  part.offset.insert(part.offset.begin(), size(direction));
  part.count.insert(part.count.begin(), 1);
  return part;
}

std::string name_of(Precision precision) {
  return precision == Precision::double_precision ? "double" : "float";
}

template <class T>
void write_populations(const Fluid& fluid, Hdf5File& file) {
  const ArrayPart cells = cells_of(fluid.decomposition());
  file.create_array<T>("/populations", with_direction(cells, 0).whole);
  for (int i = 0; i < kDirections; ++i) {
    std::vector<T> values;
    values.reserve(fluid.decomposition().local_box().volume());
    for_each_cell(fluid.decomposition().local_box(), [&](int x, int y, int z) {
      values.push_back(static_cast<T>(fluid.population(i, {x, y, z})));
    });
    file.write("/populations", with_direction(cells, i), values);
  }
}

template <class T>
void read_populations(Fluid& fluid, const Hdf5File& file) {
  const ArrayPart cells = cells_of(fluid.decomposition());
  for (int i = 0; i < kDirections; ++i) {
    const std::vector<T> values = file.read<T>("/populations", with_direction(cells, i));
    std::size_t n = 0;
    for_each_cell(fluid.decomposition().local_box(), [&](int x, int y, int z) {
      fluid.set_population(i, {x, y, z}, static_cast<double>(values[n++]));
    });
  }
}

void write_labels(const Fluid& fluid, Hdf5File& file) {
  const ArrayPart cells = cells_of(fluid.decomposition());
  std::vector<std::uint8_t> labels;
  for_each_cell(fluid.decomposition().local_box(), [&](int x, int y, int z) {
    labels.push_back(fluid.solid_label({x, y, z}));
  });
  file.create_array<std::uint8_t>("/solid_labels", cells.whole);
  file.write("/solid_labels", cells, labels);
}

void read_labels(Fluid& fluid, const Hdf5File& file) {
  // One byte a cell of the whole box on every rank: the cells around a sub-box are needed too.
  ArrayPart whole = cells_of(fluid.decomposition());
  whole.offset.assign(3, 0);
  whole.count = whole.whole;
  const std::vector<std::uint8_t> labels = file.read<std::uint8_t>("/solid_labels", whole);
  if (std::all_of(labels.begin(), labels.end(), [](std::uint8_t label) { return label == 0; })) return;
  const Index3& n = fluid.decomposition().cells();
  fluid.set_solids([&](const Index3& c) {
    return labels[size(c[0]) + size(n[0]) * (size(c[1]) + size(n[1]) * size(c[2]))];
  });
}

/// Spacing (m) and time step (s).
constexpr const char* kUnits = "/spacing_and_time_step";

void write_units(const Units& units, Hdf5File& file, bool writes) {
  const std::vector<double> values = {units.spacing(), units.time_step(), units.density()};
  const std::size_t count = values.size();
  file.create_array<double>(kUnits, {count});
  file.write(kUnits, {{count}, {0}, {writes ? count : 0}}, writes ? values : std::vector<double>{});
}

/// States of earlier versions say nothing of them, or of the spacing and the time step only.
void require_units(const Units& units, const Hdf5File& file, const std::string& path) {
  if (!file.exists(kUnits)) return;
  struct Unit {
    const char* name;
    double now;
    const char* hint;
  };
  const Unit all[] = {
      {"spacing", units.spacing(), "m"},
      {"time step", units.time_step(), "s: it follows from viscosity, spacing and relaxation time"},
      {"density", units.density(), "kg/m^3: pressures and forces follow from it"}};
  const std::vector<std::size_t> found = file.extents(kUnits);
  if (found.size() != 1 || found[0] < 2 || found[0] > std::size(all))
    throw_user_error(
        {"fluid restart " + path, kUnits, "damaged", "be two or three numbers", "take another state"});
  const std::vector<double> saved = file.read<double>(kUnits, {found, {0}, found});
  for (std::size_t n = 0; n < saved.size(); ++n)
    if (!(std::abs(saved[n] - all[n].now) <= 1e-9 * all[n].now))
      throw_user_error({"fluid restart " + path, all[n].name, fmt::format("{:g}", all[n].now),
                        fmt::format("be {:g} as in the run that saved it", saved[n]), all[n].hint});
}

}  // namespace

void save_state(const Fluid& fluid, const std::string& path, const Units* units) {
  const Decomposition& d = fluid.decomposition();
  const std::string unfinished = path + ".part";
  on_first_rank("fluid restart", d.communicator(), [&] { require_replaceable(path, "fluid restart"); });
  {
    Hdf5File file(unfinished, Hdf5File::Mode::create, d.communicator());
    const std::size_t each = fluid.settings().precision == Precision::double_precision ? 8 : 4;
    file.reserve((kDirections * each + 1) * CellBox{{0, 0, 0}, d.cells()}.volume());
    file.set_attribute("/", "what", std::string("suffuse fluid state, version 1"));
    file.set_attribute("/", "storage", name_of(fluid.settings().precision));
    file.set_attribute("/", "steps", static_cast<std::int64_t>(fluid.steps()));
    file.set_attribute("/", "at_odd_step", static_cast<std::int64_t>(fluid.at_odd_step() ? 1 : 0));
    if (fluid.settings().precision == Precision::double_precision)
      write_populations<double>(fluid, file);
    else
      write_populations<float>(fluid, file);
    write_labels(fluid, file);
    if (units != nullptr) write_units(*units, file, d.rank() == 0);
    file.close();
  }
  on_first_rank("fluid restart", d.communicator(), [&] {
    wait_for_disk(unfinished, "fluid restart");
    std::filesystem::rename(unfinished, path);
  });
}

void load_state(Fluid& fluid, const std::string& path, const Units* units) {
  const Decomposition& d = fluid.decomposition();
  const Hdf5File file(path, Hdf5File::Mode::read, d.communicator());
  if (!file.exists("/populations") || !file.exists("/solid_labels"))
    throw_user_error({"fluid restart", "file", path, "hold a saved state of a fluid",
                      "take the file that the run's restart line wrote"});
  const std::vector<std::size_t> expected = with_direction(cells_of(d), 0).whole,
                                 found = file.extents("/populations");
  if (found != expected)
    throw_user_error(
        {"fluid restart " + path, "cells (z y x)",
         fmt::format("{}", fmt::join(found.begin() + std::min<long>(1, static_cast<long>(found.size())),
                                     found.end(), " ")),
         fmt::format("be {} as in this run", fmt::join(expected.begin() + 1, expected.end(), " ")), ""});
  const std::string storage = file.text_attribute("/", "storage"),
                    wanted = name_of(fluid.settings().precision);
  if (storage != wanted)
    throw_user_error({"fluid restart " + path, "precision", storage, "be " + wanted + " as in this run",
                      "set precision to " + storage});
  if (units != nullptr) require_units(*units, file, path);
  fluid.set_progress(0, false);
  read_labels(fluid, file);
  fluid.set_progress(static_cast<long>(file.integer_attribute("/", "steps")),
                     file.integer_attribute("/", "at_odd_step") != 0);
  if (storage == "double")
    read_populations<double>(fluid, file);
  else
    read_populations<float>(fluid, file);
}

}  // namespace suffuse::lbm
