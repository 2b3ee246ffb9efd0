#pragma once

namespace LAMMPS_NS {
class LAMMPS;
class FixHydrodynamicForce;
}  // namespace LAMMPS_NS

namespace suffuse::coupling {

/// The fix that carries what the coupling knows of grains; null without.
LAMMPS_NS::FixHydrodynamicForce* find_force_fix(LAMMPS_NS::LAMMPS* lmp);

/// The same where there must be one: a UserError if the script has taken it away.
LAMMPS_NS::FixHydrodynamicForce& force_fix(LAMMPS_NS::LAMMPS* lmp);

}  // namespace suffuse::coupling
