#ifndef SUFFUSE_CONTACT_COLLECTOR_H
#define SUFFUSE_CONTACT_COLLECTOR_H

#include <limits>
#include <memory>
#include <vector>

#include "compute_pair_gran_local.h"
#include "suffuse/common/linear_algebra.h"

namespace LAMMPS_NS {

class PairGran;

/// Receives contacts from the pair style through the interface of `compute pair/gran/local`.
///
/// A pair style serves one such compute at a time, and a script may have its own: a sweep puts ours in its
/// place and puts the script's back.
class ContactCollector : public ComputePairGranLocal {
 public:
  static std::unique_ptr<ContactCollector> create(LAMMPS* lmp);

  struct Found {
    int i = 0, j = 0;                              ///< LIGGGHTS's atoms, j may be a ghost
    suffuse::Vec3 branch = suffuse::Vec3::Zero();  ///< centre of j to centre of i, m
    suffuse::Vec3 force = suffuse::Vec3::Zero();   ///< on i, N
    double* history = nullptr;                     ///< LIGGGHTS's own values of the contact
    /// N, as in micromechanics::Contact; NaN without `friction`.
    double friction_limit = std::numeric_limits<double>::quiet_NaN();
    double spring_force = std::numeric_limits<double>::quiet_NaN();
  };

  /// Every contact, with the forces that the pair style computed in this step. Valid until the next sweep.
  ///
  /// The pair style leaves the spring of a sliding contact at its Coulomb limit, so that a second evaluation
  /// finds it above or below the limit by rounding, and below adds a damping force that the first did not
  /// have: by chance, and otherwise on other ranks. The springs are therefore stretched by kStretch for the
  /// sweep, which keeps sliding contacts sliding, and put back bit for bit.
  ///
  /// With `friction` also the tangential spring's force and the limit that the law itself sets it.
  const std::vector<Found>& sweep(PairGran& pair, bool friction);

  void add_pair(int i, int j, double fx, double fy, double fz, double, double, double, double* history,
                const double* const) override;
  void pair_finalize() override {}

 private:
  ContactCollector(LAMMPS* lmp_in, int& first, char** words)
      : ComputePairGranLocal(lmp_in, first, 3, words) {}

  void evaluate(PairGran& pair);
  void save_springs(int values);
  void restore_springs();
  void stretch_springs(int values);
  void measure_friction(PairGran& pair, int spring);
  std::vector<suffuse::Vec3> tangential_forces(PairGran& pair);
  void set_springs(int spring, double length);
  std::vector<suffuse::Vec3> tangential_forces_while_spinning(PairGran& pair, double speed);

  std::vector<Found> found_, result_;
  std::vector<double> saved_;
  int saved_values_ = 0;
};

}  // namespace LAMMPS_NS

#endif
