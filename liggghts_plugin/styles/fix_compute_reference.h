#ifdef FIX_CLASS

// clang-format off
FixStyle(compute/reference, FixComputeReference)
// clang-format on

#else

#ifndef SUFFUSE_FIX_COMPUTE_REFERENCE_H
#define SUFFUSE_FIX_COMPUTE_REFERENCE_H

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fix.h"

namespace LAMMPS_NS {

class Compute;

/// Keeps what a compute has taken as its reference in restart files, where LIGGGHTS lets fixes write only.
///
/// Added by the compute that needs it; scripts never name it.
class FixComputeReference : public Fix {
 public:
  FixComputeReference(LAMMPS* lmp, int narg, char** arg);

  /// The values that go to restart files, of rank 0 alone, none before there is a reference. Collective.
  using Values = std::function<std::vector<double>()>;

  /// For a compute's constructor. What a restart file that was read holds for a compute of this ID, the same
  /// on all ranks; nothing where it holds none. A UserError where it is one of another style, or no whole
  /// record.
  static std::optional<std::vector<double> > keep_for(LAMMPS* lmp, const Compute& compute, Values values);
  /// For its destructor.
  static void forget(LAMMPS* lmp, const Compute& compute);

  int setmask() override { return 0; }
  void pre_delete(bool unfixflag) override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;

 private:
  Values values_;
  std::string compute_style_;
  std::optional<std::vector<double> > restored_;
};

}  // namespace LAMMPS_NS

#endif
#endif
