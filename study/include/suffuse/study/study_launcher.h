#pragma once

#include <string>
#include <vector>

namespace suffuse::study {

/// What starts the ranks of a study's runs: "srun --exact -n {ranks}", say.
class StudyLauncher {
 public:
  /// For studies that name none: nothing for one rank, otherwise the project's own `mpirun`, or that of PATH.
  StudyLauncher() = default;

  /// `text` is words with spaces between them, {ranks} for the number of ranks; a program with a slash that
  /// has no full path begins at `folder`. Throws UserError, of `who` and `what`, where {ranks} is missing or
  /// the program is not there.
  StudyLauncher(const std::string& text, const std::string& folder, const std::string& who,
                const std::string& what);

  /// The words before the program and its arguments.
  std::vector<std::string> words(int ranks) const;

  /// Slurm's srun: the ranks are no children of it, so that the system does not count their time.
  bool is_srun() const;

 private:
  std::vector<std::string> words_;
};

}  // namespace suffuse::study
