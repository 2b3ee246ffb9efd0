#ifdef COMPUTE_CLASS

// clang-format off
ComputeStyle(strong/contacts,ComputeStrongContacts)
// clang-format on

#else

#ifndef SUFFUSE_COMPUTE_STRONG_CONTACTS_H
#define SUFFUSE_COMPUTE_STRONG_CONTACTS_H

#include "contact_compute.h"

namespace LAMMPS_NS {

/// `compute ID group strong/contacts [threshold mean|frozen|FORCE] [axis x|y|z]`: share of contacts whose
/// normal force is at least the threshold, and the stress they carry (global vector). Formulas:
/// micromechanics/strong_contacts.h. A frozen threshold is kept in restart files.
class ComputeStrongContacts : public ContactCompute {
 public:
  ComputeStrongContacts(LAMMPS* lmp, int& iarg, int narg, char** arg);
  ~ComputeStrongContacts() override;
  void compute_vector() override;

 private:
  void keep_threshold();

  enum class Threshold { mean, frozen, given };

  Threshold kind_ = Threshold::mean;
  double threshold_ = 0;
  int axis_ = 2;
};

/// Reads x, y or z as 0, 1, 2.
int read_axis(suffuse::ArgumentReader& reader);

}  // namespace LAMMPS_NS

#endif
#endif
