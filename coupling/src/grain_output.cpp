#include "suffuse/coupling/grain_output.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "suffuse/common/hdf5_file.h"

namespace suffuse::coupling {

namespace {

/// Where this rank's rows lie among those of all ranks.
struct Rows {
  std::size_t first = 0, mine = 0, all = 0;
};

Rows rows_of(int owned, MPI_Comm communicator) {
  long mine = owned, before = 0, all = 0;
  MPI_Exscan(&mine, &before, 1, MPI_LONG, MPI_SUM, communicator);
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  if (rank == 0) before = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_LONG, MPI_SUM, communicator);
  return {static_cast<std::size_t>(before), static_cast<std::size_t>(mine), static_cast<std::size_t>(all)};
}

class SnapshotWriter {
 public:
  SnapshotWriter(Hdf5File& file, const std::string& group, const Rows& rows)
      : file_(file), group_(group), rows_(rows) {}

  template <class T>
  void scalars(const std::string& name, const std::vector<T>& values) {
    file_.create_array<T>(group_ + "/" + name, {rows_.all});
    file_.write(group_ + "/" + name, {{rows_.all}, {rows_.first}, {rows_.mine}}, values);
  }

  /// Three values a grain, `stride` apart.
  void vectors(const std::string& name, const double* values, int stride) {
    std::vector<double> packed;
    packed.reserve(3 * rows_.mine);
    for (std::size_t n = 0; n < rows_.mine; ++n) {
      const double* from = values + n * static_cast<std::size_t>(stride);
      packed.insert(packed.end(), from, from + 3);
    }
    file_.create_array<double>(group_ + "/" + name, {rows_.all, 3});
    file_.write(group_ + "/" + name, {{rows_.all, 3}, {rows_.first, 0}, {rows_.mine, 3}}, packed);
  }

 private:
  Hdf5File& file_;
  std::string group_;
  Rows rows_;
};

std::string xdmf_attribute(const std::string& file, const std::string& group, const std::string& name,
                           std::size_t rows, bool vector, bool integer) {
  return fmt::format(
      "        <Attribute Name=\"{0}\" AttributeType=\"{1}\" Center=\"Node\"><DataItem Dimensions=\"{2}{3}\" "
      "NumberType=\"{4}\" Precision=\"8\" Format=\"HDF\">{5}:{6}/{0}</DataItem></Attribute>\n",
      name, vector ? "Vector" : "Scalar", rows, vector ? " 3" : "", integer ? "Int" : "Float", file, group);
}

std::string xdmf_snapshot(const std::string& file, const std::string& group, double time, std::size_t rows) {
  std::string text = fmt::format(
      "      <Grid Name=\"grains\" GridType=\"Uniform\">\n        <Time Value=\"{:.17g}\"/>\n"
      "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1\"/>\n"
      "        <Geometry GeometryType=\"XYZ\"><DataItem Dimensions=\"{} 3\" NumberType=\"Float\" "
      "Precision=\"8\" Format=\"HDF\">{}:{}/position</DataItem></Geometry>\n",
      time, rows, rows, file, group);
  text += xdmf_attribute(file, group, "id", rows, false, true);
  for (const char* scalar : {"radius", "diameter"})
    text += xdmf_attribute(file, group, scalar, rows, false, false);
  for (const char* vector : {"velocity", "angular_velocity", "force", "torque"})
    text += xdmf_attribute(file, group, vector, rows, true, false);
  return text + "      </Grid>\n";
}

}  // namespace

void GrainOutput::write(long step, double time, const GrainArrays& grains, const GrainMemory& memory,
                        MPI_Comm communicator) {
  const Rows rows = rows_of(grains.owned, communicator);
  const std::string name = fmt::format("step_{:012d}", step), group = "/" + name + "/grains";
  const std::string file_name = std::filesystem::path(path_).filename().string();
  std::string snapshots;
  {
    Hdf5File file(path_, append_ ? Hdf5File::Mode::append : Hdf5File::Mode::create, communicator);
    append_ = true;
    for (const std::string& old : file.names_in("/"))
      if (old.starts_with("step_") && old >= name) file.remove("/" + old);
    file.create_group("/" + name);
    file.set_attribute("/" + name, "time_s", time);
    file.create_group(group);
    SnapshotWriter writer(file, group, rows);
    writer.scalars("id", std::vector<std::int64_t>(grains.id, grains.id + grains.owned));
    std::vector<double> radius(grains.radius, grains.radius + grains.owned);
    writer.scalars("radius", radius);
    for (double& r : radius) r *= 2;
    writer.scalars("diameter", radius);
    writer.vectors("position", grains.position, 3);
    writer.vectors("velocity", grains.velocity, 3);
    writer.vectors("angular_velocity", grains.angular_velocity, 3);
    writer.vectors("force", memory.load, 6);
    writer.vectors("torque", rows.mine > 0 ? memory.load + 3 : nullptr, 6);
    for (const std::string& each : file.names_in("/")) {
      if (!each.starts_with("step_")) continue;
      const std::string part = "/" + each + "/grains";
      if (const std::size_t count = file.extents(part + "/id").at(0); count > 0)
        snapshots += xdmf_snapshot(file_name, part, file.number_attribute("/" + each, "time_s"), count);
    }
  }
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  if (rank == 0) {
    const std::filesystem::path target = std::filesystem::path(path_).replace_extension(".xdmf"),
                                unfinished = target.string() + ".part";
    std::ofstream(unfinished) << "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"2.0\">\n  <Domain>\n    <Grid "
                                 "Name=\"grains\" GridType=\"Collection\" CollectionType=\"Temporal\">\n"
                              << snapshots << "    </Grid>\n  </Domain>\n</Xdmf>\n";
    std::filesystem::rename(unfinished, target);
  }
  MPI_Barrier(communicator);
}

}  // namespace suffuse::coupling
