#include "suffuse/coupling/grain_output.h"

#include <fmt/format.h>

#include <filesystem>
#include <numeric>
#include <utility>
#include <vector>

#include "suffuse/common/grain_series_names.h"
#include "suffuse/common/hdf5_file.h"
#include "suffuse/common/provenance.h"

namespace suffuse::coupling {

namespace names = grain_series;

namespace {

/// Where this rank's rows lie among those of all ranks.
struct Rows {
  std::size_t first = 0, mine = 0, all = 0;
};

Rows rows_of(std::size_t owned, MPI_Comm communicator) {
  long mine = static_cast<long>(owned), before = 0, all = 0;
  MPI_Exscan(&mine, &before, 1, MPI_LONG, MPI_SUM, communicator);
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  if (rank == 0) before = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_LONG, MPI_SUM, communicator);
  return {static_cast<std::size_t>(before), static_cast<std::size_t>(mine), static_cast<std::size_t>(all)};
}

/// Arrays of one group: a row a grain or a contact, those of rank 0 first.
class RowWriter {
 public:
  RowWriter(Hdf5File& file, const std::string& group, const Rows& rows)
      : file_(file), group_(group), rows_(rows) {}

  template <class T>
  void scalars(const std::string& name, const std::string& units, const std::vector<T>& values) {
    file_.create_array<T>(group_ + "/" + name, {rows_.all});
    set_units(name, units);
    file_.write(group_ + "/" + name, {{rows_.all}, {rows_.first}, {rows_.mine}}, values);
  }

  /// `columns` values a row, one row after the other.
  template <class T>
  void table(const std::string& name, const std::string& units, std::size_t columns,
             const std::vector<T>& values) {
    file_.create_array<T>(group_ + "/" + name, {rows_.all, columns});
    set_units(name, units);
    file_.write(group_ + "/" + name, {{rows_.all, columns}, {rows_.first, 0}, {rows_.mine, columns}}, values);
  }

  /// Three values a row, `stride` apart.
  void vectors(const std::string& name, const std::string& units, const double* values, int stride) {
    std::vector<double> packed;
    packed.reserve(3 * rows_.mine);
    for (std::size_t n = 0; n < rows_.mine; ++n) {
      const double* from = values + n * static_cast<std::size_t>(stride);
      packed.insert(packed.end(), from, from + 3);
    }
    table(name, units, 3, packed);
  }

 private:
  void set_units(const std::string& name, const std::string& units) {
    if (!units.empty()) file_.set_attribute(group_ + "/" + name, "units", units);
  }

  Hdf5File& file_;
  std::string group_;
  Rows rows_;
};

/// How many, of all ranks.
std::size_t write_grains(Hdf5File& file, const std::string& step, const GrainArrays& grains,
                         const GrainMemory& memory, MPI_Comm communicator) {
  const Rows rows = rows_of(static_cast<std::size_t>(grains.owned), communicator);
  file.create_group(step + "/" + names::kGrains);
  RowWriter writer(file, step + "/" + names::kGrains, rows);
  writer.scalars(names::kId, "", std::vector<std::int64_t>(grains.id, grains.id + grains.owned));
  std::vector<double> radius(grains.radius, grains.radius + grains.owned);
  writer.scalars(names::kRadius, "m", radius);
  for (double& r : radius) r *= 2;
  writer.scalars("diameter", "m", radius);
  writer.vectors(names::kPosition, "m", grains.position, 3);
  writer.vectors("velocity", "m/s", grains.velocity, 3);
  writer.vectors("angular_velocity", "rad/s", grains.angular_velocity, 3);
  writer.vectors(names::kForce, "N", memory.load, 6);
  writer.vectors("torque", "N m", rows.mine > 0 ? memory.load + 3 : nullptr, 6);
  return rows.all;
}

/// The same on all ranks; rank 0 writes it.
void write_box(Hdf5File& file, const std::string& step, const GrainSnapshot& snapshot, int rank) {
  const std::size_t mine = rank == 0 ? 1 : 0;
  std::vector<double> corners;
  std::vector<std::uint8_t> periodic;
  if (rank == 0) {
    corners.insert(corners.end(), snapshot.box_low.begin(), snapshot.box_low.end());
    corners.insert(corners.end(), snapshot.box_high.begin(), snapshot.box_high.end());
    periodic.assign(snapshot.periodic.begin(), snapshot.periodic.end());
  }
  file.create_array<double>(step + "/" + names::kBox, {2, 3});
  file.write(step + "/" + names::kBox, {{2, 3}, {0, 0}, {2 * mine, 3}}, corners);
  file.create_array<std::uint8_t>(step + "/" + names::kPeriodic, {3});
  file.write(step + "/" + names::kPeriodic, {{3}, {0}, {3 * mine}}, periodic);
}

/// How many, of all ranks.
std::size_t write_contacts(Hdf5File& file, const std::string& step, const micromechanics::Packing& network,
                           MPI_Comm communicator) {
  std::vector<std::int64_t> ids;
  std::vector<double> force, normal, branch, ends, friction, limit, spring;
  for (const micromechanics::Contact& contact : network.contacts) {
    if (!is_counted(network, contact)) continue;
    ids.insert(ids.end(), {first_grain(network, contact).id, second_id(network, contact)});
    force.insert(force.end(), contact.force.begin(), contact.force.end());
    normal.push_back(micromechanics::normal_force(contact));
    branch.insert(branch.end(), contact.branch.begin(), contact.branch.end());
    const Vec3& first = first_grain(network, contact).position;
    const Vec3 second = first - contact.branch;
    ends.insert(ends.end(), first.begin(), first.end());
    ends.insert(ends.end(), second.begin(), second.end());
    friction.push_back(contact.friction);
    limit.push_back(contact.friction_limit);
    spring.push_back(contact.spring_force);
  }
  file.create_group(step + "/" + names::kContacts);
  const Rows rows = rows_of(friction.size(), communicator);
  std::vector<std::int64_t> lines(2 * rows.mine);
  std::iota(lines.begin(), lines.end(), static_cast<std::int64_t>(2 * rows.first));
  RowWriter writer(file, step + "/" + names::kContacts, rows);
  writer.table(names::kIds, "", 2, ids);
  writer.table(names::kForce, "N", 3, force);
  writer.scalars("normal_force", "N", normal);
  writer.table(names::kBranch, "m", 3, branch);
  writer.table("ends", "m", 6, ends);
  writer.table("lines", "", 2, lines);
  writer.scalars(names::kFriction, "1", friction);
  writer.scalars(names::kFrictionLimit, "N", limit);
  writer.scalars(names::kSpringForce, "N", spring);
  return rows.all;
}

/// Bytes of the arrays, of all ranks.
std::size_t room_for(const GrainSnapshot& snapshot, MPI_Comm communicator) {
  constexpr std::size_t grain = 8 * (1 + 2 + 5 * 3), contact = 8 * (2 + 2 + 2 * 3 + 6 + 4);
  std::size_t bytes = grain * rows_of(static_cast<std::size_t>(snapshot.grains.owned), communicator).all;
  if (snapshot.network != nullptr)
    bytes += contact * rows_of(snapshot.network->contacts.size(), communicator).all;
  return bytes;
}

std::string xdmf_attribute(const std::string& file, const std::string& group, const std::string& name,
                           std::size_t rows, bool vector, bool integer, const char* centre = "Node") {
  return fmt::format(
      "        <Attribute Name=\"{0}\" AttributeType=\"{1}\" Center=\"{7}\"><DataItem Dimensions=\"{2}{3}\" "
      "NumberType=\"{4}\" Precision=\"8\" Format=\"HDF\">{5}:{6}/{0}</DataItem></Attribute>\n",
      name, vector ? "Vector" : "Scalar", rows, vector ? " 3" : "", integer ? "Int" : "Float", file, group,
      centre);
}

/// What the XDMF files say of a snapshot.
struct Shown {
  std::string step;  ///< its group
  double time;       ///< s
  std::size_t grains, contacts;
};

std::string grid_of_grains(const std::string& file, const Shown& shown) {
  const std::size_t rows = shown.grains;
  if (rows == 0) return "";
  const std::string group = shown.step + "/" + names::kGrains;
  std::string text = fmt::format(
      "      <Grid Name=\"grains\" GridType=\"Uniform\">\n        <Time Value=\"{:.17g}\"/>\n"
      "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1\"/>\n"
      "        <Geometry GeometryType=\"XYZ\"><DataItem Dimensions=\"{} 3\" NumberType=\"Float\" "
      "Precision=\"8\" Format=\"HDF\">{}:{}/{}</DataItem></Geometry>\n",
      shown.time, rows, rows, file, group, names::kPosition);
  text += xdmf_attribute(file, group, names::kId, rows, false, true);
  for (const char* scalar : {names::kRadius, "diameter"})
    text += xdmf_attribute(file, group, scalar, rows, false, false);
  for (const char* vector : {"velocity", "angular_velocity", names::kForce, "torque"})
    text += xdmf_attribute(file, group, vector, rows, true, false);
  return text + "      </Grid>\n";
}

/// Lines from centre to centre; across a periodic face the second end lies outside of the box.
std::string grid_of_contacts(const std::string& file, const Shown& shown) {
  const std::size_t rows = shown.contacts;
  if (rows == 0) return "";
  const std::string group = shown.step + "/" + names::kContacts;
  std::string text = fmt::format(
      "      <Grid Name=\"contacts\" GridType=\"Uniform\">\n        <Time Value=\"{0:.17g}\"/>\n"
      "        <Topology TopologyType=\"Polyline\" NumberOfElements=\"{1}\" NodesPerElement=\"2\"><DataItem "
      "Dimensions=\"{1} 2\" NumberType=\"Int\" Precision=\"8\" Format=\"HDF\">{3}:{4}/lines</DataItem>"
      "</Topology>\n        <Geometry GeometryType=\"XYZ\"><DataItem Dimensions=\"{2} 3\" "
      "NumberType=\"Float\" "
      "Precision=\"8\" Format=\"HDF\">{3}:{4}/ends</DataItem></Geometry>\n",
      shown.time, rows, 2 * rows, file, group);
  for (const char* scalar : {"normal_force", names::kFriction})
    text += xdmf_attribute(file, group, scalar, rows, false, false, "Cell");
  text += xdmf_attribute(file, group, names::kForce, rows, true, false, "Cell");
  return text + "      </Grid>\n";
}

}  // namespace

std::string contacts_beside(const std::string& path) {
  const std::filesystem::path file(path);
  std::string stem = file.stem().string();
  if (stem.ends_with("_grains")) stem.resize(stem.size() - std::string("_grains").size());
  return (file.parent_path() / (stem + "_contacts.xdmf")).string();
}

GrainOutput::GrainOutput(std::string path, bool append)
    : path_(std::move(path)),
      append_(append),
      grains_(std::filesystem::path(path_).replace_extension(".xdmf").string(), "grains"),
      contacts_(contacts_beside(path_), "contacts") {}

void GrainOutput::write(const GrainSnapshot& snapshot, MPI_Comm communicator) {
  const std::string name = fmt::format("{}{:012d}", names::kStep, snapshot.step), step = "/" + name;
  // After what this object has written?
  const bool is_next = name > last_ && is_as_left(path_, growth_, communicator);
  if (append_ && !is_next) remove_states_from(name, names::kStep, path_, growth_, communicator);
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  Shown shown{step, snapshot.time, 0, 0};
  {
    Hdf5File file(path_, append_ ? Hdf5File::Mode::append : Hdf5File::Mode::create, communicator, &growth_);
    append_ = true;
    file.reserve(room_for(snapshot, communicator));
    write_provenance(file);
    file.create_group(step);
    file.set_attribute(step, names::kTime, snapshot.time);
    shown.grains = write_grains(file, step, snapshot.grains, snapshot.memory, communicator);
    write_box(file, step, snapshot, rank);
    if (snapshot.network != nullptr)
      shown.contacts = write_contacts(file, step, *snapshot.network, communicator);
    file.close();
  }
  last_ = name;
  const std::string file_name = std::filesystem::path(path_).filename().string();
  const bool added =
      is_next && grains_.add(grid_of_grains(file_name, shown), communicator) &&
      (snapshot.network == nullptr || contacts_.add(grid_of_contacts(file_name, shown), communicator));
  if (!added) show_all(communicator);
}

void GrainOutput::show_all(MPI_Comm communicator) {
  const std::string file_name = std::filesystem::path(path_).filename().string();
  std::string grains, contacts;
  bool any_networks = false;
  {
    const Hdf5File file(path_, Hdf5File::Mode::read, communicator);
    for (const std::string& each : file.names_in("/")) {
      if (!each.starts_with(names::kStep)) continue;
      Shown shown{"/" + each, file.number_attribute("/" + each, names::kTime), 0, 0};
      shown.grains = file.extents(shown.step + "/" + names::kGrains + "/" + names::kId).at(0);
      const std::string lines = shown.step + "/" + names::kContacts + "/lines";
      const bool has_network = file.exists(lines);
      if (has_network) shown.contacts = file.extents(lines).at(0);
      any_networks = any_networks || has_network;
      grains += grid_of_grains(file_name, shown);
      contacts += grid_of_contacts(file_name, shown);
    }
  }
  grains_.write(grains, communicator);
  if (any_networks) contacts_.write(contacts, communicator);
}

}  // namespace suffuse::coupling
