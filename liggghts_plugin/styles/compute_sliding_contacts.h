#ifdef COMPUTE_CLASS

// clang-format off
ComputeStyle(sliding/contacts,ComputeSlidingContacts)
// clang-format on

#else

#ifndef SUFFUSE_COMPUTE_SLIDING_CONTACTS_H
#define SUFFUSE_COMPUTE_SLIDING_CONTACTS_H

#include "contact_compute.h"
#include "suffuse/micromechanics/slipping.h"

namespace LAMMPS_NS {

/// `compute ID group sliding/contacts [tolerance T | appendix]`: share of contacts at their Coulomb limit
/// (global vector). Formulas: micromechanics/slipping.h.
class ComputeSlidingContacts : public ContactCompute {
 public:
  ComputeSlidingContacts(LAMMPS* lmp, int& iarg, int narg, char** arg);
  void compute_vector() override;

 private:
  suffuse::micromechanics::SlidingRule rule_;
};

/// Reads `tolerance T` or `appendix` where `key` is one of them; false if it is neither.
bool read_sliding_rule(const std::string& key, suffuse::ArgumentReader& reader,
                       suffuse::micromechanics::SlidingRule& rule);
/// The rest of a line that has these words alone.
suffuse::micromechanics::SlidingRule read_sliding_words(suffuse::ArgumentReader& reader);

}  // namespace LAMMPS_NS

#endif
#endif
