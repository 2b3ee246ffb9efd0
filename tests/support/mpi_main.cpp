// main of the Catch2 programs that run under mpirun: a failure on any rank fails the test, output comes from
// rank 0 unless another rank fails.
#include <mpi.h>

#include <cstdio>

#include "catch_session.h"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0 && std::freopen("/dev/null", "w", stdout) == nullptr) MPI_Abort(MPI_COMM_WORLD, 2);
  int failed = run_tests(argc, argv);
  int worst = 0;
  MPI_Allreduce(&failed, &worst, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  if (failed != 0 && rank != 0) std::fprintf(stderr, "rank %d: %d failed test cases\n", rank, failed);
  MPI_Finalize();
  return worst == 0 ? 0 : 1;
}
