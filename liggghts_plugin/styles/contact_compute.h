#ifndef SUFFUSE_CONTACT_COMPUTE_H
#define SUFFUSE_CONTACT_COMPUTE_H

#include <string>
#include <vector>

#include "compute.h"
#include "style_support.h"
#include "suffuse/micromechanics/coordination.h"
#include "suffuse/micromechanics/sums.h"

namespace LAMMPS_NS {

/// What our computes of the contact network share: they register with the contact sampler, so that contacts
/// are found once for all of them and only on steps on which one of them is evaluated, and they own their
/// output.
///
/// Contacts count where both grains are in the compute's group. The volume is that of the box.
class ContactCompute : public Compute {
 public:
  ~ContactCompute() override;
  void init() override;

 protected:
  ContactCompute(LAMMPS* lmp, int& iarg, int narg, char** arg);

  /// Grains and contacts of the group on this rank at the current step.
  const suffuse::micromechanics::Packing& packing();

  /// "compute <style>", for messages.
  std::string who() const { return std::string("compute ") + style; }

  /// Sums of all ranks.
  template <class Sums>
  Sums over_ranks(Sums sums) {
    suffuse::sum_over_ranks(lmp, suffuse::micromechanics::as_doubles(sums));
    return sums;
  }

  /// Declares a global vector of this length and, as the scalar, its first value.
  void declare_vector(int length);
  /// Declares a global array.
  void declare_array(int rows, int columns);

  std::vector<double> values_;  ///< the global vector

 private:
  std::vector<double> cells_;
  std::vector<double*> rows_;
};

/// Words that several computes take: `split DIAMETER`.
suffuse::micromechanics::SizeSplit read_split(suffuse::ArgumentReader& reader);

}  // namespace LAMMPS_NS

#endif
