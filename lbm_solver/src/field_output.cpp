#include "suffuse/lbm/field_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "suffuse/common/grain_series_names.h"
#include "suffuse/common/hdf5_file.h"
#include "suffuse/common/provenance.h"
#include "suffuse/lbm/cell_array.h"

namespace suffuse::lbm {

namespace names = grain_series;

namespace {

struct Snapshot {
  std::string group;
  double time_si = 0;
  std::vector<std::string> fields;
};

ArrayPart part_of(const Decomposition& d, bool vector) {
  ArrayPart part = cells_of(d);
  if (vector) {
    part.whole.push_back(3);
    part.offset.push_back(0);
    part.count.push_back(3);
  }
  return part;
}

std::vector<float> values_of(Field field, const Fluid& fluid, const Units& units,
                             const FieldOutputSettings& settings) {
  std::vector<float> values;
  values.reserve(fluid.decomposition().local_box().volume() * facts_of(field).components);
  const auto add = [&](double value) { values.push_back(static_cast<float>(value)); };
  const CellBox& box = fluid.decomposition().local_box();
  if (field == Field::solid_fraction) {
    for_each_cell(box, [&](int x, int y, int z) {
      const Index3 cell{x, y, z};
      add(settings.solid_fraction ? settings.solid_fraction(cell) : fluid.is_solid(cell) ? 1. : 0.);
    });
    return values;
  }
  const auto visit = [&](const Index3&, const FluidPoint& point, double) {
    if (field == Field::velocity)
      for (int a = 0; a < 3; ++a) add(units.velocity_to_si(point.velocity[a]));
    if (field == Field::pressure) add(units.density_lattice_to_pressure(point.density));
    if (field == Field::density) add(units.density_to_si(point.density));
  };
  if (settings.for_each_point)
    settings.for_each_point(visit);
  else
    fluid.for_each_point(visit);
  return values;
}

std::string xdmf_array(const std::string& file, const Snapshot& snapshot, const std::string& field,
                       const Index3& cells) {
  const bool vector = std::any_of(std::begin(kFields), std::end(kFields), [&](const FieldFacts& facts) {
    return facts.word == field && facts.components == 3;
  });
  return fmt::format(
      "        <Attribute Name=\"{0}\" AttributeType=\"{1}\" Center=\"Cell\">\n"
      "          <DataItem Dimensions=\"{2} {3} {4}{5}\" NumberType=\"Float\" Precision=\"4\" Format=\"HDF\">"
      "{6}:/{7}/{0}</DataItem>\n"
      "        </Attribute>\n",
      field, vector ? "Vector" : "Scalar", cells[2], cells[1], cells[0], vector ? " 3" : "", file,
      snapshot.group);
}

std::string xdmf_grid(const std::string& file, const Snapshot& snapshot, const Index3& cells,
                      const Vec3& origin, double spacing) {
  std::string text = fmt::format(
      "      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{:.17g}\"/>\n"
      "        <Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"{} {} {}\"/>\n"
      "        <Geometry GeometryType=\"ORIGIN_DXDYDZ\">\n"
      "          <DataItem Dimensions=\"3\" Format=\"XML\" Precision=\"8\">{:.17g} {:.17g} "
      "{:.17g}</DataItem>\n"
      "          <DataItem Dimensions=\"3\" Format=\"XML\" Precision=\"8\">{:.17g} {:.17g} "
      "{:.17g}</DataItem>\n"
      "        </Geometry>\n",
      snapshot.group, snapshot.time_si, cells[2] + 1, cells[1] + 1, cells[0] + 1, origin[2], origin[1],
      origin[0], spacing, spacing, spacing);
  for (const std::string& field : snapshot.fields) text += xdmf_array(file, snapshot, field, cells);
  return text + "      </Grid>\n";
}

}  // namespace

std::string xdmf_beside(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".xdmf").string();
}

FieldOutput::FieldOutput(const FieldOutputSettings& settings, const Units& units)
    : settings_(settings), units_(units), series_(xdmf_beside(settings.path), "fluid") {}

void FieldOutput::write(const Fluid& fluid) {
  const Decomposition& d = fluid.decomposition();
  const std::string group = fmt::format("{}{:012d}", names::kStep, fluid.steps());
  const double time = units_.time_to_si(static_cast<double>(fluid.steps()));
  Snapshot snapshot{group, time, {}};
  for (const Field field : settings_.fields) snapshot.fields.emplace_back(facts_of(field).word);
  std::sort(snapshot.fields.begin(), snapshot.fields.end());  // as names_in has them
  const bool anew = last_.empty() && !settings_.append;
  // After what this object has written?
  const bool is_next = group > last_ && is_as_left(settings_.path, growth_, d.communicator());
  if (!anew && !is_next) remove_states_from(group, names::kStep, settings_.path, growth_, d.communicator());
  {
    const auto mode = anew ? Hdf5File::Mode::create : Hdf5File::Mode::append;
    Hdf5File file(settings_.path, mode, d.communicator(), &growth_);
    std::size_t values = 0;
    for (const Field field : settings_.fields) values += facts_of(field).components;
    file.reserve(values * sizeof(float) * CellBox{{0, 0, 0}, d.cells()}.volume());
    write_provenance(file);
    for (int axis = 0; axis < 3; ++axis)
      file.set_attribute("/", fmt::format("origin_{}_m", "xyz"[axis]), settings_.origin[axis]);
    file.set_attribute("/", "spacing_m", units_.spacing());
    file.create_group("/" + group);
    file.set_attribute("/" + group, names::kTime, time);
    for (const Field field : settings_.fields) {
      const ArrayPart part = part_of(d, facts_of(field).components > 1);
      const std::string array = "/" + group + "/" + facts_of(field).word;
      file.create_array<float>(array, part.whole);
      file.set_attribute(array, "units", facts_of(field).unit);
      file.write(array, part, values_of(field, fluid, units_, settings_));
    }
    file.close();
  }
  last_ = group;
  const std::string file_name = std::filesystem::path(settings_.path).filename().string();
  const auto grid = [&](const Snapshot& of) {
    return xdmf_grid(file_name, of, d.cells(), settings_.origin, units_.spacing());
  };
  if (is_next && series_.add(grid(snapshot), d.communicator())) return;
  std::string grids;
  const Hdf5File file(settings_.path, Hdf5File::Mode::read, d.communicator());
  for (const std::string& name : file.names_in("/"))
    if (name.starts_with(names::kStep))
      grids += grid({name, file.number_attribute("/" + name, names::kTime), file.names_in("/" + name)});
  series_.write(grids, d.communicator());
}

}  // namespace suffuse::lbm
