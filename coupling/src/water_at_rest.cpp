// Steps of a coupled simulation whose water is at rest.
#include <mpi.h>

#include <algorithm>

#include "suffuse/coupling/coupled_simulation.h"
#include "suffuse/lbm/lattice.h"

namespace suffuse::coupling {

/// Is every population of this rank what it is at rest? -0 is 0.
bool CoupledSimulation::is_at_rest() const {
  bool rests = true;
  lbm::for_each_cell(fluid_.decomposition().local_box(), [&](int x, int y, int z) {
    for (int i = 0; i < lbm::kDirections && rests; ++i) rests = fluid_.population(i, {x, y, z}) == 0;
  });
  return rests;
}

/// Does anything move water that is at rest: a force, a face, a sphere that moves in the cells of this rank?
bool CoupledSimulation::is_driven() const {
  if (!fluid_.force().isZero(0)) return true;
  for (const lbm::FaceCondition& face : fluid_.settings().faces)
    if ((face.kind == lbm::FaceKind::velocity && !face.velocity.isZero(0)) ||
        (face.kind == lbm::FaceKind::pressure && face.density != 1))
      return true;
  const lbm::CellBox& box = fluid_.decomposition().local_box();
  return std::any_of(spheres_.begin(), spheres_.end(), [&](const LatticeSphere& sphere) {
    bool moves = false, reaches = true;
    for (std::size_t a = 0; a < 3; ++a) {
      moves = moves || sphere.velocity[a] != 0 || sphere.angular_velocity[a] != 0;
      reaches = reaches && sphere.position[a] + sphere.radius > box.lo[a] &&
                sphere.position[a] - sphere.radius < box.hi[a];
    }
    return moves && reaches;
  });
}

/// The same answer on all ranks.
bool CoupledSimulation::water_rests() {
  if (!settings_.skip_rest || has_flowed_) return false;
  const bool known = rested_at_ == fluid_.steps();  // else it has been given a state since
  int moves = is_driven() || (!known && !is_at_rest()) ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &moves, 1, MPI_INT, MPI_MAX, fluid_.decomposition().communicator());
  has_flowed_ = moves != 0;
  return moves == 0;
}

/// A step of water at rest: cells are mapped as in others, and nothing is exchanged.
void CoupledSimulation::rest(bool loads_wanted) {
  const double start = MPI_Wtime();
  if (mapping_.is_stale()) mapping_.write();
  times_.mapping += MPI_Wtime() - start;
  fluid_.set_progress(fluid_.steps() + 1, !fluid_.at_odd_step());
  rested_at_ = fluid_.steps();
  ++rested_steps_;
  if (loads_wanted) mapping_.sum(units_.relaxation_time());
}

}  // namespace suffuse::coupling
