#include "suffuse/common/end_together.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <thread>

namespace suffuse {

void end_together(MPI_Comm communicator, int code, const std::string& why, double seconds) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(communicator, &request);
  end_unless_all_come(request, code, why, seconds);
}

void end_unless_all_come(MPI_Request& request, int code, const std::string& why, double seconds) {
  using namespace std::chrono_literals;
  const double end = MPI_Wtime() + seconds;
  int done = 0;
  for (MPI_Test(&request, &done, MPI_STATUS_IGNORE); done == 0 && MPI_Wtime() < end;
       MPI_Test(&request, &done, MPI_STATUS_IGNORE))
    std::this_thread::sleep_for(5ms);
  if (done != 0) return;
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (!why.empty()) fmt::print(stderr, "{}\n", why);
  fmt::print(stderr, "suffuse: rank {} has ended with code {} and others have not: all are ended\n", rank,
             code);
  std::fflush(nullptr);
  MPI_Abort(MPI_COMM_WORLD, code);
}

}  // namespace suffuse
