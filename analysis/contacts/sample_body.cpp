#include "contacts/sample_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "suffuse/common/error.h"
#include "suffuse/micromechanics/sphere.h"

namespace suffuse::analysis {

using micromechanics::Box;
using micromechanics::Packing;

void SampleBody::set_volume(Packing& packing, const std::array<bool, 3>& periodic) {
  periodic_ = periodic;
  const Box box{packing.box_low, packing.box_high};
  if (settings_->volume) {
    packing.volume = *settings_->volume;
    return;
  }
  const Box bed = micromechanics::bed_box(micromechanics::grain_extent(packing), box, periodic);
  const bool is_bed = settings_->bed || settings_->region;
  packing.volume = micromechanics::volume_of(is_bed ? bed : box);
  if (is_bed || !note_.empty() || packing.grains.empty() || !micromechanics::is_another_sample(box, bed))
    return;
  const Vec3 own = box.high - box.low, filled = bed.high - bed.low;
  note_ = fmt::format(
      "porosity and stresses are of the box, {:.4g} x {:.4g} x {:.4g} m, but the grains reach over {:.4g} x "
      "{:.4g} x {:.4g} m: --bed takes these, --region or --volume a body of your own",
      own[0], own[1], own[2], filled[0], filled[1], filled[2]);
}

void SampleBody::restrict_to_region(Snapshot& snapshot) const {
  snapshot.whole.reset();
  if (!settings_->region) return;
  Packing& packing = snapshot.packing;
  Box region = *settings_->region;
  for (int axis = 0; axis < 3; ++axis) {
    if (!periodic_[static_cast<std::size_t>(axis)]) continue;
    region.low[axis] = std::max(region.low[axis], packing.box_low[axis]);
    region.high[axis] = std::min(region.high[axis], packing.box_high[axis]);
  }
  if ((region.high - region.low).minCoeff() <= 0)
    throw_user_error({settings_->who, "--region", "outside the periodic box", "be in it", ""});
  const Vec3 length = packing.box_high - packing.box_low;
  const auto is_inside = [&](const Vec3& centre) {
    for (int axis = 0; axis < 3; ++axis) {
      double at = centre[axis];
      if (periodic_[static_cast<std::size_t>(axis)])
        at -= length[axis] * std::floor((at - packing.box_low[axis]) / length[axis]);
      if (at < region.low[axis] || at >= region.high[axis]) return false;
    }
    return true;
  };
  WholePacking whole{std::move(packing), {}};
  packing = micromechanics::part_inside(whole.packing, is_inside);
  for (const micromechanics::Grain& grain : whole.packing.grains)
    whole.is_in_part.push_back(is_inside(grain.position));
  snapshot.whole = std::move(whole);
  if (packing.grains.empty())
    throw_user_error({settings_->who, "--region", "no grain's centre", "lie in it", "lengths are in metres"});
  packing.volume = micromechanics::volume_of(region);
  double solids = 0;
  for (const micromechanics::Grain& grain : packing.grains)
    solids += micromechanics::sphere_volume(grain.radius);
  if (solids > packing.volume)
    throw_user_error({settings_->who, "--region",
                      fmt::format("{} grains of {:.4g} m³ with their centres in {:.4g} m³",
                                  packing.grains.size(), solids, packing.volume),
                      "hold their volume", "give a body some grains wide"});
}

std::string both_notes(const std::string& first, const std::string& second) {
  return first + (first.empty() || second.empty() ? "" : "\n") + second;
}

}  // namespace suffuse::analysis
