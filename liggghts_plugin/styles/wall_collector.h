#ifndef SUFFUSE_WALL_COLLECTOR_H
#define SUFFUSE_WALL_COLLECTOR_H

#include <memory>
#include <vector>

#include "compute_pair_gran_local.h"
#include "suffuse/common/linear_algebra.h"

namespace LAMMPS_NS {

class FixWallGran;

/// Finds what every `fix wall/gran` of the script, primitive or of meshes, exerts on the grains now.
///
/// LIGGGHTS has an interface for mesh walls only (`compute wall/gran/local`). A primitive wall is evaluated
/// once more as during set-up, when no spring moves, and what it adds to the grains' forces is taken off
/// again.
class WallCollector : public ComputePairGranLocal {
 public:
  static std::unique_ptr<WallCollector> create(LAMMPS* lmp);

  struct Found {
    int i = 0;                                     ///< LIGGGHTS's owned atom
    suffuse::Vec3 branch = suffuse::Vec3::Zero();  ///< point of contact to centre, m
    suffuse::Vec3 force = suffuse::Vec3::Zero();   ///< on the grain, N
  };

  /// All contacts with walls. Valid until the next sweep. `who` begins messages.
  const std::vector<Found>& sweep(const char* who);

  /// Has the script granular walls?
  static bool any(LAMMPS* lmp);

  void add_wall_1(int, int, int, double* contact_point, double*) override;
  void add_wall_2(int i, double fx, double fy, double fz, double, double, double, double*, double,
                  double*) override;
  void pair_finalize() override {}

 private:
  WallCollector(LAMMPS* lmp_in, int& first, char** words) : ComputePairGranLocal(lmp_in, first, 3, words) {}

  void sweep_meshes(FixWallGran& granular);
  void sweep_primitive(FixWallGran& granular);

  std::vector<Found> found_;
  suffuse::Vec3 contact_point_ = suffuse::Vec3::Zero();
};

}  // namespace LAMMPS_NS

#endif
