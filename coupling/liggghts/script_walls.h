#pragma once

#include <string>
#include <vector>

#include "suffuse/common/linear_algebra.h"
#include "suffuse/lbm/wall_shapes.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace suffuse::coupling {

/// A wall of the script: a primitive of `fix wall/gran`, or one of its meshes.
struct ScriptWall {
  std::string id;        ///< of the fix, or of the mesh: what opens it
  std::string name;      ///< ID of the fix; of a mesh, "ID mesh ID"
  std::string geometry;  ///< for a reader: "zplane 0.001"; tells two walls apart
  bool open = false;     ///< to water
  bool slides = false;   ///< it is a primitive with `shear`: not at rest, if it stays where it is
  lbm::WallShape shape;  ///< in cells from the fluid's low corner
};

/// The walls that LIGGGHTS has now; `open` are the IDs of fixes or meshes that let water pass. A UserError
/// for a wall that cannot be made solid for water because its mesh moves or it is of another style, unless it
/// is open. The same on every rank. Collective.
std::vector<ScriptWall> walls_of_script(LAMMPS_NS::LAMMPS* lmp, const std::vector<std::string>& open,
                                        const Vec3& origin, double spacing);

/// A UserError for one that is not solid for water although the water meets it.
[[noreturn]] void refuse_sliding(const ScriptWall& wall);

/// A UserError if no wall that LIGGGHTS has now, nor mesh of one, has one of these IDs.
void require_walls(LAMMPS_NS::LAMMPS* lmp, const std::vector<std::string>& ids);

/// Does a fix of the script put grains in?
bool inserts_grains(LAMMPS_NS::LAMMPS* lmp);

}  // namespace suffuse::coupling
