#include "sample_choice.h"

#include <fmt/format.h>
#include <mpi.h>

#include <cmath>
#include <cstring>

#include "domain.h"
#include "lammps.h"
#include "region.h"
#include "suffuse/common/error.h"
#include "wall_collector.h"

namespace suffuse {
namespace {

using micromechanics::Box;
using micromechanics::GrainExtent;
using micromechanics::Packing;

constexpr double kUnbounded = 1e19;  // LIGGGHTS writes INF as 1e20
/// Points of the sequence that measures the volume of a region that is no block: error about 1e-5.
constexpr int kPoints = 1 << 20;

std::array<bool, 3> periodic_axes(const LAMMPS_NS::LAMMPS* lmp) {
  const int* periodicity = lmp->domain->periodicity;
  return {periodicity[0] != 0, periodicity[1] != 0, periodicity[2] != 0};
}

/// Point n of the additive sequence of low discrepancy in the unit cube (Roberts' R3: powers of the root of
/// x⁴ = x + 1).
Vec3 point_of_sequence(int n) {
  constexpr double kRoot = 1.2207440846057596;
  Vec3 point;
  double step = 1;
  for (int axis = 0; axis < 3; ++axis) {
    step /= kRoot;
    point[axis] = std::fmod(0.5 + n * step, 1.0);
  }
  return point;
}

}  // namespace

bool SampleChoice::read(const std::string& key, ArgumentReader& reader) {
  if (key == "region") {
    region_id_ = reader.word("region");
  } else if (key == "bed") {
    bed_ = true;
  } else if (key == "walls") {
    const std::string given = reader.word("walls");
    if (given != "yes" && given != "no") throw_user_error({who_, "walls", given, "be yes or no", ""});
    walls = given == "yes";
  } else {
    return false;
  }
  if (bed_ && !region_id_.empty())
    throw_user_error({who_, "sample", "region and bed", "be one of them", "leave out the other"});
  return true;
}

void SampleChoice::init() {
  if (region_id_.empty()) return;
  const int index = lmp_->domain->find_region(region_id_.data());
  if (index < 0)
    throw_user_error({who_, "region", region_id_, "exist", "write `region ID ... units box` before"});
  region_ = lmp_->domain->regions[index];
  if (region_->interior == 0 || region_->bboxflag == 0 || region_->dynamic_check() != 0)
    throw_user_error({who_, "region", region_id_, "be a body at rest with an inside (side in)",
                      "give a block, cylinder, sphere, cone or an intersection of them"});
  region_box({Vec3::Zero(), Vec3::Ones()});
}

Box SampleChoice::simulation_box(const Packing& packing) const {
  return {packing.box_low, packing.box_high};
}

Box SampleChoice::bed_of(const Packing& packing) const {
  GrainExtent extent = micromechanics::grain_extent(packing);
  std::array<double, 7> most{-extent.low[0], -extent.low[1], -extent.low[2],         extent.high[0],
                             extent.high[1], extent.high[2], extent.largest_diameter};
  MPI_Allreduce(MPI_IN_PLACE, most.data(), static_cast<int>(most.size()), MPI_DOUBLE, MPI_MAX, lmp_->world);
  extent.low = -Vec3(most[0], most[1], most[2]);
  extent.high = Vec3(most[3], most[4], most[5]);
  extent.largest_diameter = most[6];
  return micromechanics::bed_box(extent, simulation_box(packing), periodic_axes(lmp_));
}

Box SampleChoice::region_box(const Box& simulation_box) const {
  Box box{{region_->extent_xlo, region_->extent_ylo, region_->extent_zlo},
          {region_->extent_xhi, region_->extent_yhi, region_->extent_zhi}};
  const std::array<bool, 3> periodic = periodic_axes(lmp_);
  for (int axis = 0; axis < 3; ++axis) {
    if (periodic[static_cast<std::size_t>(axis)]) {
      box.low[axis] = std::max(box.low[axis], simulation_box.low[axis]);
      box.high[axis] = std::min(box.high[axis], simulation_box.high[axis]);
    } else if (box.low[axis] < -kUnbounded || box.high[axis] > kUnbounded) {
      throw_user_error({who_, "region", region_id_,
                        fmt::format("be bounded along {}, which is not periodic", "xyz"[axis]),
                        "give its ends as numbers"});
    }
  }
  return box;
}

double SampleChoice::region_volume(const Box& own) {
  if (std::strcmp(region_->style, "block") == 0) return micromechanics::volume_of(own);
  if (measured_bounds_ && measured_bounds_->low == own.low && measured_bounds_->high == own.high)
    return measured_volume_;
  int inside = 0;
  for (int n = 0; n < kPoints; ++n) {
    const Vec3 point = own.low + point_of_sequence(n).cwiseProduct(own.high - own.low);
    inside += region_->match(point[0], point[1], point[2]);
  }
  measured_bounds_ = own;
  measured_volume_ = micromechanics::volume_of(own) * inside / kPoints;
  return measured_volume_;
}

void SampleChoice::require_block() const {
  if (!is_region() || std::strcmp(region_->style, "block") == 0) return;
  throw_user_error({who_, "region", region_id_, "be a block, since layers are cut from it",
                    "give the block's bounds, or `trim` for the sides"});
}

Box SampleChoice::bounds(const Packing& packing) const {
  if (bed_) return bed_of(packing);
  return is_region() ? region_box(simulation_box(packing)) : simulation_box(packing);
}

Packing SampleChoice::part_of(const Packing& packing) {
  if (is_whole_box()) return packing;
  const Box own = bounds(packing);
  if (bed_) {
    Packing part = packing;
    part.box_low = own.low;
    part.box_high = own.high;
    part.volume = micromechanics::volume_of(own);
    return part;
  }
  const auto inside = [&](const Vec3& centre) {
    Vec3 wrapped = centre;
    lmp_->domain->remap(wrapped.data());
    return region_->match(wrapped[0], wrapped[1], wrapped[2]) != 0;
  };
  Packing part = micromechanics::part_inside(packing, inside);
  part.box_low = own.low;
  part.box_high = own.high;
  part.volume = region_volume(own);
  if (!(part.volume > 0))
    throw_user_error({who_, "region", region_id_, "have a volume in the simulation box", ""});
  return part;
}

void SampleChoice::tell_if_not_the_bed(const Packing& packing, const std::array<bool, 3>& axes) {
  if (told_bed_ || !is_whole_box()) return;
  const Box bed = bed_of(packing), taken = simulation_box(packing);
  if (!micromechanics::is_another_sample(taken, bed, axes)) return;
  told_bed_ = true;
  const Vec3 own = taken.high - taken.low, filled = bed.high - bed.low;
  tell(lmp_,
       fmt::format("{}: takes the simulation box, {:.4g} x {:.4g} x {:.4g} m, for the sample, but its "
                   "grains reach over {:.4g} x {:.4g} x {:.4g} m; `bed` takes these, `region ID` a body "
                   "of your own\n",
                   who_, own[0], own[1], own[2], filled[0], filled[1], filled[2]));
}

void SampleChoice::tell_if_walls_are_left_out() {
  if (told_walls_ || walls || !LAMMPS_NS::WallCollector::any(lmp_)) return;
  told_walls_ = true;
  tell(lmp_,
       fmt::format("{}: contacts with walls are left out; `walls yes` counts them in the stress\n", who_));
}

}  // namespace suffuse
