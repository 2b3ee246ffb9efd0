#include "run_guards.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "suffuse/common/count_text.h"
#include "suffuse/common/error.h"
#include "suffuse/lbm/health.h"

namespace suffuse::coupling {

namespace {

constexpr const char* kWho = "lbm run";
constexpr const char* kMach = "Mach number";
constexpr const char* kDensity = "density";
constexpr const char* kMotion = "motion of a grain";

/// The largest value of any rank, and what that rank says of it.
struct Worst {
  double value = -1;
  Vec3 at = Vec3::Zero();
  double id = 0;
};

Worst worst_of_ranks(Worst mine, MPI_Comm communicator) {
  struct {
    double value;
    int rank;
  } entry{mine.value, 0};
  MPI_Comm_rank(communicator, &entry.rank);
  MPI_Allreduce(MPI_IN_PLACE, &entry, 1, MPI_DOUBLE_INT, MPI_MAXLOC, communicator);
  std::array<double, 4> about{mine.at[0], mine.at[1], mine.at[2], mine.id};
  MPI_Bcast(about.data(), 4, MPI_DOUBLE, entry.rank, communicator);
  return {entry.value, {about[0], about[1], about[2]}, about[3]};
}

std::string text_of(const Vec3& at) {
  return fmt::format("x y z = {:.4g} {:.4g} {:.4g} m", at[0], at[1], at[2]);
}

bool is_closed_for_water(const lbm::FaceConditions& faces) {
  return std::none_of(faces.begin(), faces.end(), [](const lbm::FaceCondition& face) {
    return face.kind == lbm::FaceKind::pressure || face.kind == lbm::FaceKind::velocity;
  });
}

/// 1 for each axis along which faces and walls leave the water its momentum, else 0: periodic faces do, and
/// mirrors along themselves.
Vec3 kept_axes(const CoupledSimulation& simulation) {
  Vec3 kept = Vec3::Ones();
  const lbm::FaceConditions& faces = simulation.fluid().settings().faces;
  for (int f = 0; f < lbm::kFaces; ++f) {
    const lbm::FaceKind kind = faces[static_cast<std::size_t>(f)].kind;
    if (kind == lbm::FaceKind::free_slip)
      kept[axis_of(static_cast<lbm::Face>(f))] = 0;
    else if (kind != lbm::FaceKind::periodic)
      kept.setZero();
  }
  return kept;
}

}  // namespace

void read_budgets(GuardReading& reading, const CoupledSimulation& simulation) {
  const lbm::Decomposition& d = simulation.fluid().decomposition();
  const double cells = static_cast<double>(lbm::CellBox{{0, 0, 0}, d.cells()}.volume());
  reading.mass_at_rest = cells;
  if (is_closed_for_water(simulation.fluid().settings().faces))
    reading.stored_mass = reading.fluid.stored_mass;
  const double walls = simulation.acting_walls().empty() && !simulation.fluid().has_closed_cells() ? 0 : 1;
  const MomentumLedger& ledger = simulation.ledger();
  std::array<double, 5> sums{ledger.grains[0], ledger.grains[1], ledger.grains[2], ledger.grains_magnitude,
                             walls};
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 5, MPI_DOUBLE, MPI_SUM, d.communicator());
  const Vec3 kept = sums[4] > 0 ? Vec3(Vec3::Zero()) : kept_axes(simulation);
  if (kept.isZero(0) || simulation.method() != nullptr) return;
  const Vec3 given = cells * ledger.force - Vec3(sums[0], sums[1], sums[2]);
  reading.momentum = {kept.cwiseProduct(reading.fluid.stored_momentum.sum - given),
                      cells * ledger.force_magnitude + sums[3], reading.fluid.stored_momentum.magnitude,
                      ledger.steps_unknown};
}

std::vector<RunGuards::Finding> RunGuards::findings(const GuardReading& reading) {
  const lbm::Units& units = simulation_.units();
  const double step = units.time_step();
  std::vector<Finding> all;
  const double mach = lbm::mach_of(reading.fluid);
  all.push_back({kMach, mach, reading.mach_limit, fmt::format("{:.3g}", mach), "", ""});  // health.h ends it
  const double departure = std::max(reading.fluid.largest_density - 1, 1 - reading.fluid.smallest_density);
  all.push_back({kDensity, departure, limits_.density, fmt::format("{:.3g} % from rest", 100 * departure),
                 fmt::format("depart from rest by less than {:g} %", 100 * limits_.density),
                 fmt::format("a pressure that high needs a smaller timestep than {:.3g} s (a lower "
                             "relaxation_time), or lower pressures at the faces",
                             step)});
  const double motion = reading.fastest_grain * step / units.spacing();
  all.push_back({kMotion, motion, limits_.motion, fmt::format("{:.3g} cells a fluid step", motion),
                 fmt::format("stay below {:g} cells a fluid step", limits_.motion),
                 fmt::format("the water cannot follow: use a timestep of the fluid below {:.3g} s",
                             step * std::min(1., kWarnShare * limits_.motion / std::max(motion, 1e-300)))});
  all.push_back({"overlap of the grains", reading.overlap, limits_.overlap,
                 fmt::format("{:.3g} % of their volume", 100 * reading.overlap),
                 fmt::format("be below {:g} %", 100 * limits_.overlap),
                 "take stiffer contacts, or a smaller DEM step (`dem_timestep`)"});
  if (reading.stored_mass) {
    if (!first_mass_) first_mass_ = reading.stored_mass;
    const double change = std::abs(*reading.stored_mass - *first_mass_) / reading.mass_at_rest;
    all.push_back({"mass of the water", change, limits_.mass,
                   fmt::format("changed by a share of {:.3g}", change),
                   fmt::format("stay within a share of {:g}: no face lets any in", limits_.mass),
                   "run with `precision double`; if it is, please report the scene"});
  }
  if (reading.momentum) all.push_back(momentum_finding(*reading.momentum));
  return all;
}

/// Since the first look, or the first after steps whose loads nobody formed.
RunGuards::Finding RunGuards::momentum_finding(const MomentumBudget& now) {
  if (!first_momentum_ || first_momentum_->steps_unknown != now.steps_unknown) first_momentum_ = now;
  const MomentumBudget& first = *first_momentum_;
  const double scale = now.handed_over - first.handed_over + first.stored + now.stored;
  const double missing = scale > 0 ? (now.surplus - first.surplus).norm() / scale : 0;
  return {"momentum of water and grains",
          missing,
          limits_.momentum,
          fmt::format("changed by a share of {:.3g} of what was handed over", missing),
          fmt::format("stay within a share of {:g}: no face takes any up", limits_.momentum),
          "run with `precision double`; if it is, please report the scene"};
}

/// Of what has just been found too large: a second look, which a run that goes well never takes.
std::string RunGuards::place_of(const std::string& name) const {
  const MPI_Comm communicator = simulation_.fluid().decomposition().communicator();
  Worst worst;
  if (name == kMach || name == kDensity) {
    simulation_.fluid().for_each_point([&](const lbm::Index3& cell, const lbm::FluidPoint& point, double) {
      if (simulation_.fluid().is_solid(cell)) return;
      const double value = name == kMach ? point.velocity.norm() : std::abs(point.density - 1);
      if (!(value > worst.value)) return;
      worst.value = value;
      worst.at = simulation_.origin() +
                 simulation_.units().spacing() * Vec3(cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5);
    });
    return " at " + text_of(worst_of_ranks(worst, communicator).at);
  }
  if (name != kMotion) return "";
  const auto& spheres = simulation_.spheres();
  for (const LatticeSphere& sphere : spheres) {
    const double value = Vec3(sphere.velocity[0], sphere.velocity[1], sphere.velocity[2]).norm();
    const Vec3 at =
        simulation_.origin() +
        simulation_.units().spacing() * Vec3(sphere.position[0], sphere.position[1], sphere.position[2]);
    if (!(value > worst.value) || !simulation_.holds(at)) continue;
    worst = {value, at, static_cast<double>(sphere.id)};
  }
  worst = worst_of_ranks(worst, communicator);
  return fmt::format(", id {:.0f} at {}", worst.id, text_of(worst.at));
}

std::vector<std::string> RunGuards::check(const GuardReading& reading) {
  const double time = simulation_.time_si();
  lbm::require_stable(reading.fluid, simulation_.units(), time, reading.mach_limit, kWho);
  if (!std::isfinite(reading.fastest_grain)) throw_lost_grain(kWho, time);
  std::vector<std::string> lines;
  for (const Finding& finding : findings(reading)) {
    if (finding.value > finding.limit)
      throw_lost_run({kWho, fmt::format("{} at {:.5g} s{}", finding.name, time, place_of(finding.name)),
                      finding.number, finding.rule, finding.remedy});
    if (finding.value <= kWarnShare * finding.limit || !warned_.insert(finding.name).second) continue;
    lines.push_back(fmt::format(
        "{}: warning: {} at {:.5g} s = {}{}; the run ends above {:g} (docs/reference/lbm.md#guard)", kWho,
        finding.name, time, finding.number, place_of(finding.name), finding.limit));
  }
  if (reading.lost_grains == 0) return lines;
  const std::string lost = count_text(reading.lost_grains, "grain");
  if (limits_.stop_if_lost)
    throw_lost_run({kWho, fmt::format("lost grains at {:.5g} s", time), lost,
                    "be none: `lbm guard lost stop`",
                    "close the box with walls, or let a fix of the script take grains away on purpose"});
  if (warned_.insert("lost grains").second)
    lines.push_back(fmt::format("{}: warning: {} had left the box at {:.5g} s (docs/reference/lbm.md#guard)",
                                kWho, lost, time));
  return lines;
}

}  // namespace suffuse::coupling
