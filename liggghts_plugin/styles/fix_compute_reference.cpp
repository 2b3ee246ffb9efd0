#include "fix_compute_reference.h"

#include "comm.h"
#include "compute.h"
#include "lammps.h"
#include "modify.h"
#include "restart_record.h"
#include "suffuse/common/error.h"

using namespace LAMMPS_NS;

namespace {

constexpr int kRecordVersion = 1;

std::string id_for(const Compute& compute) {
  return std::string("reference_of_") + compute.id;
}

}  // namespace

/// `fix reference_of_ID all compute/reference STYLE`
FixComputeReference::FixComputeReference(LAMMPS* lmp_in, int narg, char** arg)
    : Fix(lmp_in, narg, arg), compute_style_(narg > 3 ? arg[3] : "") {
  restart_global = 1;
}

std::optional<std::vector<double>> FixComputeReference::keep_for(LAMMPS* lmp, const Compute& compute,
                                                                 Values values) {
  std::string id = id_for(compute), group = "all", name = "compute/reference", of = compute.style;
  char* words[] = {id.data(), group.data(), name.data(), of.data()};
  lmp->modify->add_fix(4, words);
  auto* fix = static_cast<FixComputeReference*>(lmp->modify->find_fix_id(id.c_str()));
  fix->values_ = std::move(values);
  return fix->restored_;
}

void FixComputeReference::forget(LAMMPS* lmp, const Compute& compute) {
  const std::string id = id_for(compute);
  // While LIGGGHTS shuts down, computes outlive fixes.
  if (lmp->modify->find_fix(id.c_str()) >= 0) lmp->modify->delete_fix(id.c_str());
}

void FixComputeReference::pre_delete(bool unfixflag) {
  if (unfixflag)
    suffuse::throw_user_error(
        {"unfix", "fix", id, "stay: it keeps the reference of a compute", "`uncompute` takes both away"});
}

void FixComputeReference::write_restart(FILE* file) {
  const std::vector<double> values = values_();
  if (comm->me == 0) suffuse::write_list(file, {kRecordVersion, compute_style_, values});
}

void FixComputeReference::restart(char* buffer) {
  const std::string who = "compute " + compute_style_;
  const suffuse::RestartRecord record = suffuse::read_list(buffer, kRecordVersion, who);
  if (record.text != compute_style_)
    suffuse::throw_user_error({who, "reference in the restart file", "of compute " + record.text,
                               "be of the same style", "give the compute another ID"});
  if (!record.values.empty()) restored_ = record.values;
}
