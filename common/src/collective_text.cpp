#include "suffuse/common/collective_text.h"

#include <filesystem>
#include <string>

#include "suffuse/common/error.h"
#include "suffuse/common/safe_file.h"

namespace suffuse {

namespace {

/// What went wrong in `work`; empty if nothing did.
std::string problem_in(const std::string& who, const std::function<void()>& work) {
  try {
    work();
  } catch (const UserError& error) {
    return error.what();
  } catch (const std::filesystem::filesystem_error& error) {
    return who + ": file = " + error.path1().string() + ", must be there and yours to change; " +
           error.code().message();
  }
  return "";
}

}  // namespace

void on_first_rank(const std::string& who, MPI_Comm communicator, const std::function<void()>& work) {
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  std::string problem;
  if (rank == 0) problem = problem_in(who, work);
  share_text(problem, communicator);
  if (!problem.empty()) throw UserError(problem);
}

void share_text(std::string& text, MPI_Comm communicator) {
  auto length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, communicator);
  text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(text.data(), length, MPI_CHAR, 0, communicator);
}

void write_text(const std::string& path, const std::string& who, std::string_view text,
                MPI_Comm communicator) {
  on_first_rank(who, communicator, [&] {
    SafeFile file(path, who);
    file.write(text);
    file.commit();
  });
}

}  // namespace suffuse
