#ifdef COMPUTE_CLASS

// clang-format off
ComputeStyle(broken/contacts,ComputeBrokenContacts)
// clang-format on

#else

#ifndef SUFFUSE_COMPUTE_BROKEN_CONTACTS_H
#define SUFFUSE_COMPUTE_BROKEN_CONTACTS_H

#include <vector>

#include "contact_compute.h"
#include "suffuse/micromechanics/broken_contacts.h"

namespace LAMMPS_NS {

/// `compute ID group broken/contacts [reference first | step N | file NAME]`: contacts lost and formed since
/// a reference state (global vector). Formulas: micromechanics/broken_contacts.h.
///
/// The reference set is shared out over ranks by a hash of the pair, since grains move between ranks. It is
/// kept in restart files, unless a file of its own has it.
class ComputeBrokenContacts : public ContactCompute {
 public:
  ComputeBrokenContacts(LAMMPS* lmp, int& iarg, int narg, char** arg);
  ~ComputeBrokenContacts() override;
  void compute_vector() override;

 private:
  using Pairs = std::vector<suffuse::micromechanics::GrainPair>;

  void keep_reference();
  std::vector<double> reference_values() const;
  void take_reference(const Pairs& current);
  bool read_reference_file();
  void write_reference_file() const;

  bigint reference_step_ = -1;  // reference is taken at the first evaluation at or after this step
  std::string file_;
  bool has_reference_ = false;
  Pairs reference_;  // this rank's share
};

}  // namespace LAMMPS_NS

#endif
#endif
