#include "suffuse/micromechanics/layers.h"

#include <cmath>
#include <limits>

#include "suffuse/micromechanics/constraint_ratio.h"
#include "suffuse/micromechanics/stress_reduction.h"

namespace suffuse::micromechanics {
namespace {

/// Grain centre moved by whole periods; up to one image on either side of each cut periodic axis can reach
/// the column.
std::vector<Vec3> images_near_column(const Grain& grain, const LayerGrid& grid) {
  std::vector<Vec3> images{grain.position};
  for (int axis = 0; axis < 3; ++axis) {
    const bool bounded = axis == grid.axis || grid.cut[static_cast<std::size_t>(axis)];
    if (!bounded || grid.period[axis] <= 0) continue;
    const std::size_t count = images.size();
    for (std::size_t i = 0; i < count; ++i)
      for (const double shift : {-grid.period[axis], grid.period[axis]}) {
        Vec3 moved = images[i];
        moved[axis] += shift;
        if (moved[axis] + grain.radius > grid.column.low[axis] &&
            moved[axis] - grain.radius < grid.column.high[axis])
          images.push_back(moved);
      }
  }
  return images;
}

double grain_share(const Vec3& centre, double radius, const Box& box, GrainShare share) {
  if (share == GrainShare::volume) return sphere_volume_in_box(centre, radius, box) / sphere_volume(radius);
  // Half-open, so that a centre on the border of two layers belongs to one of them.
  const bool inside = (centre.array() >= box.low.array()).all() && (centre.array() < box.high.array()).all();
  return inside ? 1 : 0;
}

}  // namespace

double LayerGrid::layer_volume() const {
  return (column.high - column.low).prod() / layers;
}

Box LayerGrid::layer_box(int layer) const {
  Box box = column;
  for (int side = 0; side < 3; ++side) {
    if (side == axis || cut[static_cast<std::size_t>(side)]) continue;
    box.low[side] = -std::numeric_limits<double>::infinity();
    box.high[side] = std::numeric_limits<double>::infinity();
  }
  const int from_low = numbered_from_top ? layers - 1 - layer : layer;
  const double thickness = (column.high[axis] - column.low[axis]) / layers;
  box.low[axis] = column.low[axis] + from_low * thickness;
  // The last border is the column's own, to the last digit, so that no sliver is lost.
  box.high[axis] = from_low == layers - 1 ? column.high[axis] : column.low[axis] + (from_low + 1) * thickness;
  return box;
}

std::vector<LayerSums> layer_sums(const Packing& packing, const LayerGrid& grid, GrainArm arm,
                                  SizeSplit split) {
  std::vector<LayerSums> layers(static_cast<std::size_t>(grid.layers));
  std::vector<Box> boxes;
  for (int layer = 0; layer < grid.layers; ++layer) boxes.push_back(grid.layer_box(layer));
  const std::vector<Mat3> stress = grain_stress_times_volume(packing, arm);
  const std::vector<int> contacts = contacts_per_grain(packing);
  for (std::size_t i = 0; i < packing.grains.size(); ++i) {
    const Grain& grain = packing.grains[i];
    for (const Vec3& centre : images_near_column(grain, grid)) {
      for (std::size_t layer = 0; layer < layers.size(); ++layer) {
        if (centre[grid.axis] + grain.radius < boxes[layer].low[grid.axis] ||
            centre[grid.axis] - grain.radius > boxes[layer].high[grid.axis])
          continue;
        const double share = grain_share(centre, grain.radius, boxes[layer], grid.share);
        if (share == 0) continue;
        layers[layer].stress.add(share * stress[i]);
        layers[layer].solid_volume += share * sphere_volume(grain.radius);
        layers[layer].grains += share;
        layers[layer].contacts += share * contacts[i];
        if (contacts[i] >= 4) layers[layer].stable += share;
        if (!split.is_fine(grain.radius)) continue;
        layers[layer].fines_volume += share * sphere_volume(grain.radius);
        layers[layer].fines_stress.add(share * stress[i]);
      }
    }
  }
  return layers;
}

std::vector<SlidingSums> layer_sliding_sums(const Packing& packing, const LayerGrid& grid,
                                            const SlidingRule& rule) {
  std::vector<SlidingSums> sums(static_cast<std::size_t>(grid.layers));
  const double low = grid.column.low[grid.axis], high = grid.column.high[grid.axis];
  for (const Contact& contact : packing.contacts) {
    const double share = contact_share(packing, contact);
    if (share == 0) continue;
    double middle = first_grain(packing, contact).position[grid.axis] - contact.branch[grid.axis] / 2;
    // Across a periodic face it depends on which grain is the first whether it lies in the box.
    if (grid.period[grid.axis] > 0 && (middle < low || middle >= high))
      middle += middle < low ? grid.period[grid.axis] : -grid.period[grid.axis];
    const double from_low = (middle - low) / (high - low) * grid.layers;
    if (!(from_low >= 0 && from_low < grid.layers)) continue;
    const int layer = static_cast<int>(from_low);
    sums[static_cast<std::size_t>(grid.numbered_from_top ? grid.layers - 1 - layer : layer)].add(contact,
                                                                                                 rule, share);
  }
  return sums;
}

LayerFines layer_fines(const LayerSums& sums, const SlidingSums& contacts, double layer_volume) {
  LayerFines result;
  if (sums.solid_volume <= 0) return result;
  const StressReduction reduction =
      stress_reduction({sums.fines_volume, sums.solid_volume, sums.fines_stress, sums.stress}, layer_volume);
  Coordination mean;
  mean.mean = layer_state(sums, layer_volume).coordination;
  result.porosity = 1 - sums.solid_volume / layer_volume;
  result.fines_share = reduction.fines_solid_share;
  result.coordination = mean.mean;
  result.shire = reduction.shire;
  result.sufian = reduction.sufian;
  result.sliding_share = sliding(contacts).share;
  result.constraint_ratio = constraint_ratio(mean, result.sliding_share).mean;
  return result;
}

LayerState layer_state(const LayerSums& sums, double layer_volume) {
  LayerState state;
  state.stress = sums.stress.matrix() / layer_volume;
  state.grains = sums.grains;
  if (sums.solid_volume <= 0) return state;
  state.void_ratio = layer_volume / sums.solid_volume - 1;
  state.coordination = sums.contacts / sums.grains;
  state.stable_share = sums.stable / sums.grains;
  return state;
}

double void_ratio_variance(std::span<const double> void_ratios, double sample_void_ratio) {
  if (void_ratios.size() < 2) return 0;
  double sum = 0;
  for (const double void_ratio : void_ratios)
    sum += (void_ratio - sample_void_ratio) * (void_ratio - sample_void_ratio);
  return sum / static_cast<double>(void_ratios.size() - 1);
}

}  // namespace suffuse::micromechanics
