#include "grain_questions.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "fix.h"
#include "fix_gravity.h"
#include "force_fix.h"
#include "lammps.h"
#include "modify.h"
#include "styles/early_stop.h"
#include "styles/fix_contact_sampler.h"
#include "styles/fix_hydrodynamic_force.h"
#include "styles/pair_law.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/sphere.h"
#include "timer.h"
#include "update.h"

namespace suffuse::coupling {

using LAMMPS_NS::FixHydrodynamicForce;
using micromechanics::sphere_volume;

bool GrainQuestions::anything_moves() const {
  for (int i = 0; i < lmp_->modify->nfix; ++i)
    if (lmp_->modify->fix[i]->time_integrate != 0) return true;
  return false;
}

std::optional<Vec3> GrainQuestions::gravity_on_grains() const {
  Vec3 sum = Vec3::Zero();
  bool found = false;
  for (int i = 0; i < lmp_->modify->nfix; ++i)
    if (auto* gravity = dynamic_cast<LAMMPS_NS::FixGravity*>(lmp_->modify->fix[i])) {
      Vec3 own;
      gravity->get_gravity(own.data());
      sum += own;
      found = true;
    }
  return found ? std::optional(sum) : std::nullopt;
}

GrainQuestions::HeldInMotion GrainQuestions::held_in_motion() const {
  const int group = force_fix(lmp_).groupbit;
  int moved = 0;
  for (int i = 0; i < lmp_->modify->nfix; ++i)
    if (lmp_->modify->fix[i]->time_integrate != 0) moved |= lmp_->modify->fix[i]->groupbit;
  const auto* atom = lmp_->atom;
  double grains = 0, speed = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & group) == 0 || (atom->mask[i] & moved) != 0) continue;
    const double own = Eigen::Map<const Vec3>(atom->v[i]).norm() +
                       atom->radius[i] * Eigen::Map<const Vec3>(atom->omega[i]).norm();
    if (own > 0) grains += 1;
    speed = std::max(speed, own);
  }
  MPI_Allreduce(MPI_IN_PLACE, &grains, 1, MPI_DOUBLE, MPI_SUM, lmp_->world);
  MPI_Allreduce(MPI_IN_PLACE, &speed, 1, MPI_DOUBLE, MPI_MAX, lmp_->world);
  return {static_cast<std::int64_t>(grains), speed};
}

bool GrainQuestions::loads_restored() const {
  // Grains migrate, and a rank may have had none: restored on one rank is restored on all.
  int mine[2] = {lmp_->atom->nlocal > 0 ? 1 : 0, force_fix(lmp_).restored() ? 1 : 0};
  MPI_Allreduce(MPI_IN_PLACE, mine, 2, MPI_INT, MPI_MAX, lmp_->world);
  return mine[0] == 0 || mine[1] != 0;
}

const micromechanics::Packing& GrainQuestions::contacts() const {
  return LAMMPS_NS::FixContactSampler::of(lmp_).packing_with_friction(force_fix(lmp_).groupbit);
}

std::array<bool, 3> GrainQuestions::periodic() const {
  const int* faces = lmp_->domain->periodicity;
  return {faces[0] != 0, faces[1] != 0, faces[2] != 0};
}

void GrainQuestions::check_box(const lbm::FaceConditions& faces) const {
  const auto* domain = lmp_->domain;
  if (domain->triclinic != 0)
    throw_user_error({"lbm run", "box", "triclinic", "be orthogonal", "use a `region ... block`"});
  for (int f = 0; f < lbm::kFaces; ++f) {
    const int axis = f / 2;
    const std::string name = lbm::name_of(static_cast<lbm::Face>(f));
    const bool fluid = faces[static_cast<std::size_t>(f)].kind == lbm::FaceKind::periodic;
    if (fluid != (domain->periodicity[axis] != 0))
      throw_user_error({"lbm boundary", name, lbm::name_of(faces[static_cast<std::size_t>(f)].kind),
                        fmt::format("agree with LIGGGHTS's `boundary`, which is {}periodic along {}",
                                    fluid ? "not " : "", "xyz"[axis]),
                        fluid ? "write `boundary ... p` for this axis, or give the face another kind"
                              : "write `boundary ... f` for this axis, or make both of its faces periodic"});
    if (domain->boundary[axis][f % 2] > 1)
      throw_user_error({"lbm run", "boundary", "shrink-wrapped", "be fixed (f) or periodic (p)",
                        "write `boundary f f f`: the fluid's box does not move"});
  }
}

Vec3 GrainQuestions::box_low() const {
  return Eigen::Map<const Vec3>(lmp_->domain->boxlo);
}

Vec3 GrainQuestions::box_high() const {
  return Eigen::Map<const Vec3>(lmp_->domain->boxhi);
}

Vec3 GrainQuestions::box_size() const {
  return Eigen::Map<const Vec3>(lmp_->domain->prd);
}

lbm::Decomposition GrainQuestions::decomposition(const Vec3& low, double spacing,
                                                 const lbm::Index3& cells) const {
  const auto* comm = lmp_->comm;
  const double* splits[3] = {comm->xsplit, comm->ysplit, comm->zsplit};
  std::array<std::vector<int>, 3> cuts;
  for (int a = 0; a < 3; ++a) {
    auto& planes = cuts[static_cast<std::size_t>(a)];
    const auto n = cells[static_cast<std::size_t>(a)];
    for (int i = 0; i <= comm->procgrid[a]; ++i) {
      const double plane = lmp_->domain->boxlo[a] + splits[a][i] * lmp_->domain->prd[a];
      planes.push_back(std::clamp(static_cast<int>(std::lround((plane - low[a]) / spacing)), 0, n));
    }
    planes.front() = 0;
    planes.back() = n;
  }
  return lbm::Decomposition::from_cuts(lmp_->world, cuts, [comm](const lbm::Index3& place) {
    return comm->grid2proc[place[0]][place[1]][place[2]];
  });
}

GrainQuestions::Summary GrainQuestions::summary() const {
  FixHydrodynamicForce& fix = force_fix(lmp_);
  const auto* atom = lmp_->atom;
  struct {
    double grains, radius_squared, volume, energy, load[3];
  } sums{};
  struct {
    double minus_radius, radius, minus_density, density, speed_squared, high[3], minus_low[3];
  } extremes;
  std::fill_n(&extremes.minus_radius, sizeof extremes / sizeof(double), -1e300);
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & fix.groupbit) == 0) continue;
    const double r = atom->radius[i], volume = sphere_volume(r), density = atom->rmass[i] / volume;
    sums.grains += 1;
    sums.radius_squared += r * r;
    sums.volume += volume;
    const double speed_squared = Eigen::Map<const Vec3>(atom->v[i]).squaredNorm();
    sums.energy += 0.5 * atom->rmass[i] *
                   (speed_squared + micromechanics::sphere_inertia(1, r) *
                                        Eigen::Map<const Vec3>(atom->omega[i]).squaredNorm());
    extremes.speed_squared = std::max(extremes.speed_squared, speed_squared);
    extremes.minus_radius = std::max(extremes.minus_radius, -r);
    extremes.radius = std::max(extremes.radius, r);
    extremes.minus_density = std::max(extremes.minus_density, -density);
    extremes.density = std::max(extremes.density, density);
    for (int a = 0; a < 3; ++a) {
      sums.load[a] += fix.load()[FixHydrodynamicForce::kLoadValues * i + a];
      extremes.high[a] = std::max(extremes.high[a], atom->x[i][a] + r);
      extremes.minus_low[a] = std::max(extremes.minus_low[a], r - atom->x[i][a]);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &sums, sizeof sums / sizeof(double), MPI_DOUBLE, MPI_SUM, lmp_->world);
  MPI_Allreduce(MPI_IN_PLACE, &extremes, sizeof extremes / sizeof(double), MPI_DOUBLE, MPI_MAX, lmp_->world);
  Summary summary;
  summary.grains = static_cast<std::int64_t>(sums.grains);
  if (summary.grains == 0) return summary;
  summary.solid_volume = sums.volume;
  summary.sauter_diameter = 6 * sums.volume / (4 * M_PI * sums.radius_squared);
  summary.smallest_radius = -extremes.minus_radius;
  summary.largest_radius = extremes.radius;
  summary.smallest_density = -extremes.minus_density;
  summary.largest_density = extremes.density;
  summary.kinetic_energy = sums.energy;
  summary.speed = std::sqrt(extremes.speed_squared);
  summary.load = Vec3(sums.load[0], sums.load[1], sums.load[2]);
  for (int a = 0; a < 3; ++a) {
    summary.low[a] = -extremes.minus_low[a];
    summary.extent[a] = std::min(extremes.high[a] + extremes.minus_low[a], lmp_->domain->prd[a]);
  }
  summary.packing = sums.volume / summary.extent.prod();
  if (summary.grains == 1)  // fills the box around it, whatever it does
    summary.packing = sums.volume / (lmp_->domain->prd[0] * lmp_->domain->prd[1] * lmp_->domain->prd[2]);
  return summary;
}

double GrainQuestions::stiffness_number(double mean_stress) const {
  lmp_->init();  // properties are looked up as a run does
  const auto law = PairLaw::of(lmp_, "lbm accuracy");
  return critical_grain(lmp_, law, mean_stress).stiffness_number;
}

std::vector<Vec3> GrainQuestions::centres() const {
  const int group = force_fix(lmp_).groupbit;
  std::vector<Vec3> centres;
  for (int i = 0; i < lmp_->atom->nlocal; ++i)
    if ((lmp_->atom->mask[i] & group) != 0) centres.emplace_back(Eigen::Map<const Vec3>(lmp_->atom->x[i]));
  return centres;
}

std::vector<GrainQuestions::OwnedGrain> GrainQuestions::owned() const {
  const int group = force_fix(lmp_).groupbit;
  std::vector<OwnedGrain> grains;
  const auto* atom = lmp_->atom;
  for (int i = 0; i < atom->nlocal; ++i)
    if ((atom->mask[i] & group) != 0)
      grains.push_back({Eigen::Map<const Vec3>(atom->x[i]), Eigen::Map<const Vec3>(atom->v[i]).norm(),
                        atom->radius[i], atom->rmass[i]});
  return grains;
}

std::vector<double> GrainQuestions::grains_by_size(const std::vector<double>& bounds) const {
  const int group = force_fix(lmp_).groupbit;
  std::vector<double> counts(bounds.size() + 1, 0);
  for (int i = 0; i < lmp_->atom->nlocal; ++i) {
    if ((lmp_->atom->mask[i] & group) == 0) continue;
    const auto above = std::upper_bound(bounds.begin(), bounds.end(), 2 * lmp_->atom->radius[i]);
    counts[static_cast<std::size_t>(above - bounds.begin())] += 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, counts.data(), static_cast<int>(counts.size()), MPI_DOUBLE, MPI_SUM,
                lmp_->world);
  return counts;
}

std::vector<double> GrainQuestions::mass_by_size(const std::vector<double>& bounds, int axis,
                                                 double below) const {
  const int group = force_fix(lmp_).groupbit;
  std::vector<double> masses(bounds.size() + 1, 0);
  const auto* atom = lmp_->atom;
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & group) == 0 || !(atom->x[i][axis] < below)) continue;
    const double radius = atom->radius[i];
    const auto above = std::upper_bound(bounds.begin(), bounds.end(), 2 * radius);
    masses[static_cast<std::size_t>(above - bounds.begin())] += atom->density[i] * sphere_volume(radius);
  }
  MPI_Allreduce(MPI_IN_PLACE, masses.data(), static_cast<int>(masses.size()), MPI_DOUBLE, MPI_SUM,
                lmp_->world);
  return masses;
}

Vec3 GrainQuestions::mean_load(int groupbit) const {
  FixHydrodynamicForce& fix = force_fix(lmp_);
  double sums[4] = {0, 0, 0, 0};
  for (int i = 0; i < lmp_->atom->nlocal; ++i) {
    const int groups = lmp_->atom->mask[i];
    if ((groups & groupbit) == 0 || (groups & fix.groupbit) == 0) continue;
    for (int a = 0; a < 3; ++a) sums[a] += fix.load()[FixHydrodynamicForce::kLoadValues * i + a];
    sums[3] += 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, lmp_->world);
  return Vec3(sums[0], sums[1], sums[2]) / std::max(1., sums[3]);
}

PastRun GrainQuestions::past_run() const {
  // Verlet leaves the loop's wall time in the timer, and `run` the number of steps.
  const double steps = lmp_->update->nsteps;
  double seconds = lmp_->timer->array[TIME_LOOP];
  MPI_Bcast(&seconds, 1, MPI_DOUBLE, 0, lmp_->world);
  double share = LastRun::share;
  MPI_Allreduce(MPI_IN_PLACE, &share, 1, MPI_DOUBLE, MPI_MIN, lmp_->world);
  const double grains = static_cast<double>(lmp_->atom->natoms);
  constexpr double least_seconds = 0.02;  // well above what starting a run takes
  if (!(seconds > least_seconds) || steps * grains <= 0) return {};
  return {steps * grains, share * seconds};
}

}  // namespace suffuse::coupling
