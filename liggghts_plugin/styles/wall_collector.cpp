#include "wall_collector.h"

#include <algorithm>
#include <cstring>

#include "atom.h"
#include "fix_property_atom.h"
#include "fix_wall_gran.h"
#include "lammps.h"
#include "local_collector.h"
#include "modify.h"
#include "primitive_wall.h"
#include "suffuse/common/error.h"
#include "update.h"

using namespace LAMMPS_NS;
using suffuse::Vec3;

namespace {

std::vector<FixWallGran*> granular_walls(LAMMPS* lmp) {
  std::vector<FixWallGran*> walls;
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (std::strncmp(lmp->modify->fix[i]->style, "wall/gran", 9) == 0)
      walls.push_back(static_cast<FixWallGran*>(lmp->modify->fix[i]));
  return walls;
}

std::vector<double> values_of(double** rows, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.insert(values.end(), rows[i], rows[i] + 3);
  return values;
}

void put_back(const std::vector<double>& values, double** rows) {
  for (std::size_t i = 0; 3 * i < values.size(); ++i) std::copy(&values[3 * i], &values[3 * i] + 3, rows[i]);
}

}  // namespace

std::unique_ptr<WallCollector> WallCollector::create(LAMMPS* lmp) {
  return suffuse::make_local_collector(lmp, [&](int& first, char** words) {
    return std::unique_ptr<WallCollector>(new WallCollector(lmp, first, words));
  });
}

bool WallCollector::any(LAMMPS* lmp) {
  return !granular_walls(lmp).empty();
}

const std::vector<WallCollector::Found>& WallCollector::sweep(const char* who) {
  found_.clear();
  for (FixWallGran* granular : granular_walls(lmp)) {
    if (granular->heattransfer_flag())
      suffuse::throw_user_error({who, "fix wall/gran", granular->id,
                                 "not conduct heat where its forces count in a stress",
                                 "say `walls no`: asking the wall again would conduct twice"});
    // A wall's own values of forces (store_force) are those of the step again after this.
    double** stored = granular->store_force() ? granular->fix_wallforce()->array_atom : nullptr;
    const std::vector<double> values = stored ? values_of(stored, atom->nlocal) : std::vector<double>{};
    if (granular->is_mesh_wall())
      sweep_meshes(*granular);
    else
      sweep_primitive(*granular);
    if (stored) put_back(values, stored);
  }
  return found_;
}

void WallCollector::sweep_meshes(FixWallGran& granular) {
  ComputePairGranLocal* previous = granular.compute_wall_gran_local();
  if (previous != nullptr) granular.unregister_compute_wall_local(previous);
  int history_values = 0;
  granular.register_compute_wall_local(this, history_values);
  granular.post_force_pgl();
  granular.unregister_compute_wall_local(this);
  if (previous != nullptr) granular.register_compute_wall_local(previous, history_values);
}

void WallCollector::add_wall_1(int, int, int, double* contact_point, double*) {
  contact_point_ = Vec3(contact_point[0], contact_point[1], contact_point[2]);
}

void WallCollector::add_wall_2(int i, double fx, double fy, double fz, double, double, double, double*,
                               double, double*) {
  const Vec3 exerted(fx, fy, fz);
  if (exerted.squaredNorm() == 0) return;
  found_.push_back({i, Vec3(atom->x[i][0], atom->x[i][1], atom->x[i][2]) - contact_point_, exerted});
}

void WallCollector::sweep_primitive(FixWallGran& granular) {
  const int count = atom->nlocal;
  const std::vector<double> forces = values_of(atom->f, count), torques = values_of(atom->torque, count);
  for (int i = 0; i < count; ++i) std::fill_n(atom->f[i], 3, 0.0);
  Fix& fix = granular;  // its hooks are public here only
  const int set_up = update->setupflag;
  if (set_up) {  // the wall may not have been set up itself
    fix.pre_neighbor();
    fix.pre_force(0);
  }
  update->setupflag = 1;
  fix.post_force(0);
  update->setupflag = set_up;
  for (int i = 0; i < count; ++i) {
    const Vec3 exerted(atom->f[i][0], atom->f[i][1], atom->f[i][2]);
    if (exerted.squaredNorm() == 0) continue;
    double to_wall[3] = {0, 0, 0};
    granular.primitiveWall()->resolveContact(atom->x[i], atom->radius[i], to_wall);
    found_.push_back({i, -Vec3(to_wall[0], to_wall[1], to_wall[2]), exerted});
  }
  put_back(forces, atom->f);
  put_back(torques, atom->torque);
}
