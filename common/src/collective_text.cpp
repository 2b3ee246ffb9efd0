#include "suffuse/common/collective_text.h"

#include <string>

#include "suffuse/common/error.h"
#include "suffuse/common/safe_file.h"

namespace suffuse {

void write_text(const std::string& path, const std::string& who, std::string_view text,
                MPI_Comm communicator) {
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  std::string problem;
  if (rank == 0) try {
      SafeFile file(path, who);
      file.write(text);
      file.commit();
    } catch (const UserError& error) {
      problem = error.what();
    }
  auto length = static_cast<int>(problem.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, communicator);
  if (length == 0) return;
  problem.resize(static_cast<std::size_t>(length));
  MPI_Bcast(problem.data(), length, MPI_CHAR, 0, communicator);
  throw UserError(problem);
}

}  // namespace suffuse
