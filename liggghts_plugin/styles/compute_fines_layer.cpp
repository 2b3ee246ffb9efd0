#include "compute_fines_layer.h"

#include <algorithm>
#include <array>

#include "compute_sliding_contacts.h"
#include "compute_stress_reduction.h"
#include "compute_strong_contacts.h"
#include "domain.h"
#include "lammps.h"
#include "suffuse/common/error.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace suffuse::micromechanics;

namespace {

constexpr int kLayerColumns = 8;

std::array<double, kLayerColumns> columns_of(const LayerFines& layer, double middle) {
  return {layer.porosity, layer.fines_share,   layer.coordination,     layer.shire,
          layer.sufian,   layer.sliding_share, layer.constraint_ratio, middle};
}

}  // namespace

ComputeFinesLayer::ComputeFinesLayer(LAMMPS* lmp_in, int& iarg, int narg, char** arg)
    : ContactCompute(lmp_in, iarg, narg, arg) {
  suffuse::ArgumentReader reader(who(), narg, arg, iarg);
  grid_.axis = read_axis(reader);
  grid_.layers = static_cast<int>(reader.positive_integer("number of layers"));
  bool bounded = false;
  while (!reader.done()) {
    const std::string key = reader.keyword();
    if (key == "split") {
      split_ = read_split(reader);
    } else if (key == "bounds") {
      bounded = true;
      grid_.column.low[grid_.axis] = reader.number("bounds (low)");
      grid_.column.high[grid_.axis] = reader.number("bounds (high)");
    } else if (key == "from") {
      const std::string end = reader.word("from");
      if (end != "top" && end != "bottom") reader.unknown(end, "top, bottom");
      grid_.numbered_from_top = end == "top";
    } else if (key == "by") {
      arm_ = read_arm(reader);
    } else if (!read_sliding_rule(key, reader, rule_)) {
      reader.unknown(key, "split, bounds, from, by, tolerance, appendix");
    }
  }
  if (split_.diameter <= 0)
    suffuse::throw_user_error({who(), "split", "nothing", "be given",
                               "add `split DIAMETER`: grains of a smaller diameter are the fines"});
  if (!bounded || grid_.column.high[grid_.axis] <= grid_.column.low[grid_.axis])
    suffuse::throw_user_error({who(), "bounds", bounded ? "not low end first" : "nothing",
                               "be given, low end first",
                               "add `bounds LO HI`, the heights (m) of the sample"});
  need_friction();
  declare_vector(kLayerColumns - 1);
  declare_array(grid_.layers, kLayerColumns);
}

void ComputeFinesLayer::init() {
  ContactCompute::init();
  for (int side = 0; side < 3; ++side) {
    grid_.period[side] = domain->periodicity[side] != 0 ? domain->boxhi[side] - domain->boxlo[side] : 0;
    if (side == grid_.axis) continue;
    grid_.cut[static_cast<std::size_t>(side)] = false;
    grid_.column.low[side] = domain->boxlo[side];
    grid_.column.high[side] = domain->boxhi[side];
  }
}

ComputeFinesLayer::Sums ComputeFinesLayer::sums() {
  const Packing& sample = packing();
  Sums sums{layer_sums(sample, grid_, arm_, split_), layer_sliding_sums(sample, grid_, rule_)};
  suffuse::sum_over_ranks(lmp, as_doubles(sums.grains));
  suffuse::sum_over_ranks(lmp, as_doubles(sums.contacts));
  return sums;
}

void ComputeFinesLayer::compute_vector() {
  invoked_vector = update->ntimestep;
  const Sums layers = sums();
  LayerSums grains;
  SlidingSums contacts;
  for (const LayerSums& layer : layers.grains) add_sums(grains, layer);
  for (const SlidingSums& layer : layers.contacts) add_sums(contacts, layer);
  const auto row = columns_of(layer_fines(grains, contacts, grid_.layer_volume() * grid_.layers), 0);
  values_.assign(row.begin(), row.end() - 1);
  vector = values_.data();
}

void ComputeFinesLayer::compute_array() {
  invoked_array = update->ntimestep;
  const Sums layers = sums();
  for (int k = 0; k < grid_.layers; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const Box box = grid_.layer_box(k);
    const auto row = columns_of(layer_fines(layers.grains[at], layers.contacts[at], grid_.layer_volume()),
                                (box.low[grid_.axis] + box.high[grid_.axis]) / 2);
    std::copy(row.begin(), row.end(), array[k]);
  }
}
