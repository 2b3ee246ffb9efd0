// one_rank_ends: rank 0 ends with code 4 while the others wait for it in a sum; all of them are ended, and
// its reason is said.
#include <mpi.h>

#include "suffuse/common/end_together.h"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  MPI_Comm ends = MPI_COMM_NULL;
  MPI_Comm_dup(MPI_COMM_WORLD, &ends);
  int rank = 0, sum = 1;
  MPI_Comm_rank(ends, &rank);
  if (rank == 0)
    suffuse::end_together(ends, 4, "suffuse: error: what rank 0 has seen", 0.5);
  else
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  MPI_Finalize();
  return 0;
}
