#include "lbm_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "../liggghts/instance.h"
#include "suffuse/common/error.h"
#include "suffuse/common/safe_file.h"
#include "suffuse/coupling/automatic_coefficient.h"

namespace suffuse::coupling {

std::vector<std::string> files_of(const OutputRequest& output) {
  const std::filesystem::path path(output.file), stem = path.parent_path() / path.stem();
  std::vector<std::string> files{output.file, stem.string() + ".xdmf"};
  if (output.grains)
    files.insert(files.end(),
                 {stem.string() + "_grains" + path.extension().string(), stem.string() + "_grains.xdmf"});
  if (output.contacts) files.push_back(stem.string() + "_contacts.xdmf");
  return files;
}

std::vector<std::string> files_of(const CheckpointRequest& checkpoint) {
  std::vector<std::string> files;
  for (const char* end : {"", ".grains", ".1", ".2", ".new"}) files.push_back(checkpoint.file + end);
  return files;
}

void refuse_shared_files(const ArgumentReader& reader, const LbmRequest& settings,
                         const std::vector<std::string>& files) {
  std::map<std::string, std::string> taken;
  for (const MonitorRequest& monitor : settings.monitors)
    taken[one_name_of(monitor.file)] = "lbm monitor " + monitor.id;
  for (const OutputRequest& output : settings.outputs)
    for (const std::string& file : files_of(output)) taken[one_name_of(file)] = "lbm output " + output.id;
  if (settings.checkpoint)
    for (const std::string& file : files_of(*settings.checkpoint))
      taken[one_name_of(file)] = "lbm restart write";
  for (const std::string& file : files)
    if (const auto other = taken.find(one_name_of(file)); other != taken.end())
      throw_user_error({reader.who(), "file", file, fmt::format("not be that of `{}`", other->second),
                        "give each its own file"});
}

CoupledSettings settings_now(const LbmRequest& request, LAMMPS_NS::LAMMPS* lmp) {
  const lbm::Units units(request.units);
  CoupledSettings settings;
  settings.units = request.units;
  settings.averaged = request.averaged;
  settings.fluid.collision = request.collision;
  settings.fluid.precision = request.precision;
  settings.fluid.faces = faces_now(request, units, lmp);
  settings.solids = request.solids;
  settings.effects = request.effects;
  settings.substeps = request.substeps;
  settings.average_force = request.average_force;
  settings.virtual_mass = request.virtual_mass;
  settings.gravity = gravity_now(request, units, lmp);
  settings.pressure_gradient = pressure_gradient_now(request, units, lmp);
  return settings;
}

lbm::FaceConditions faces_now(const LbmRequest& settings, const lbm::Units& units, LAMMPS_NS::LAMMPS* lmp) {
  lbm::FaceConditions faces;
  for (std::size_t f = 0; f < lbm::kFaces; ++f) {
    const ScriptFace& given = settings.faces[f];
    lbm::FaceCondition& face = faces[f];
    face.kind = given.kind;
    if (!given.given && is_periodic(lmp, static_cast<int>(f / 2))) face.kind = lbm::FaceKind::periodic;
    if (face.kind == lbm::FaceKind::velocity)
      face.velocity = units.velocity_to_lattice(given.velocity.now(lmp));
    if (face.kind == lbm::FaceKind::pressure)
      face.density = units.pressure_to_density_lattice(given.pressure.now(lmp));
  }
  return faces;
}

namespace {
/// `lattice`: cells a step, in each step.
void require_below(double most, const Vec3& lattice, const std::string& what, const Vec3& si,
                   const lbm::Units& units) {
  if (!(lattice.norm() < most))
    throw_user_error(
        {"lbm force", what, fmt::format("{:g} {:g} {:g}", si[0], si[1], si[2]),
         fmt::format("change velocities by less than {:g} cells a step in each step", most),
         fmt::format("use a timestep far below {:.3g} s, or a smaller value", units.time_step())});
}
}  // namespace

/// It moves grains by their buoyancy alone, so that much is allowed.
Vec3 gravity_now(const LbmRequest& settings, const lbm::Units& units, LAMMPS_NS::LAMMPS* lmp) {
  const Vec3 si = settings.gravity.now(lmp);
  require_below(100, units.acceleration_to_lattice(si), "gravity", si, units);
  return si;
}

Vec3 pressure_gradient_now(const LbmRequest& settings, const lbm::Units& units, LAMMPS_NS::LAMMPS* lmp) {
  const Vec3 si = settings.pressure_gradient.now(lmp);
  require_below(0.1, units.force_density_to_lattice(si), "pressure_gradient", si, units);
  return si;
}

bool values_change(const LbmRequest& settings) {
  for (const ScriptFace& face : settings.faces)
    if (face.velocity.changes() || face.pressure.changes()) return true;
  return settings.gravity.changes() || settings.pressure_gradient.changes();
}

}  // namespace suffuse::coupling
