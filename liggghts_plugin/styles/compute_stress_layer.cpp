#include "compute_stress_layer.h"

#include "compute_stress_reduction.h"
#include "compute_strong_contacts.h"
#include "domain.h"
#include "lammps.h"
#include "suffuse/common/error.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace suffuse::micromechanics;

ComputeStressLayer::ComputeStressLayer(LAMMPS* lmp_in, int& iarg, int narg, char** arg)
    : ContactCompute(lmp_in, iarg, narg, arg) {
  suffuse::ArgumentReader reader(who(), narg, arg, iarg);
  count_walls_by_default();
  grid_.axis = read_axis(reader);
  grid_.layers = static_cast<int>(reader.positive_integer("number of layers"));
  while (!reader.done()) {
    const std::string key = reader.keyword();
    if (key == "bounds") {
      bounds_given_ = true;
      low_ = reader.number("bounds (low)");
      high_ = reader.number("bounds (high)");
      if (high_ <= low_)
        suffuse::throw_user_error({who(), "bounds", std::to_string(low_) + " " + std::to_string(high_),
                                   "be given low end first", ""});
    } else if (key == "trim") {
      trim_ = reader.positive("trim");
    } else if (key == "share") {
      const std::string share = reader.word("share");
      if (share != "volume" && share != "centre")
        suffuse::throw_user_error({who(), "share", share, "be volume or centre", ""});
      grid_.share = share == "volume" ? GrainShare::volume : GrainShare::centre;
    } else if (key == "from") {
      const std::string end = reader.word("from");
      if (end != "top" && end != "bottom")
        suffuse::throw_user_error({who(), "from", end, "be top or bottom", ""});
      grid_.numbered_from_top = end == "top";
    } else if (key == "by") {
      arm_ = read_arm(reader);
    } else if (!read_sample_word(key, reader)) {
      reader.unknown(key, std::string("bounds, trim, share, from, by, ") + suffuse::SampleChoice::kWords);
    }
  }
  sample_is_read();
  declare_vector(5);
  declare_array(grid_.layers, 12);
}

void ComputeStressLayer::init() {
  ContactCompute::init();
  sample_.require_block();
  const Box box{{domain->boxlo[0], domain->boxlo[1], domain->boxlo[2]},
                {domain->boxhi[0], domain->boxhi[1], domain->boxhi[2]}};
  place_grid(box, box.high - box.low);
}

void ComputeStressLayer::place_grid(const Box& sample, const suffuse::Vec3& box_length) {
  grid_.column = sample;
  for (int side = 0; side < 3; ++side) {
    grid_.period[side] = domain->periodicity[side] != 0 ? box_length[side] : 0;
    if (side == grid_.axis) continue;
    // A region may end within the bed; box and bed have the grains' own width.
    grid_.cut[static_cast<std::size_t>(side)] = trim_ > 0 || sample_.is_region();
    grid_.column.low[side] += trim_;
    grid_.column.high[side] -= trim_;
    if (grid_.column.high[side] <= grid_.column.low[side])
      suffuse::throw_user_error({who(), "trim", std::to_string(trim_),
                                 "leave a column between the side faces",
                                 "take less than half of the width"});
  }
  if (!bounds_given_) return;
  grid_.column.low[grid_.axis] = low_;
  grid_.column.high[grid_.axis] = high_;
}

std::vector<LayerSums> ComputeStressLayer::sums() {
  const Packing& group_packing =
      packing_of_group();  // layers cut grains: those outside the sample matter too
  std::array<bool, 3> axes{trim_ <= 0, trim_ <= 0, trim_ <= 0};
  axes[static_cast<std::size_t>(grid_.axis)] = !bounds_given_;
  sample_.tell_if_not_the_bed(group_packing, axes);
  place_grid(sample_.bounds(group_packing), group_packing.box_high - group_packing.box_low);
  std::vector<LayerSums> layers = layer_sums(group_packing, grid_, arm_);
  suffuse::sum_over_ranks(lmp, as_doubles(layers));
  return layers;
}

void ComputeStressLayer::compute_vector() {
  invoked_vector = update->ntimestep;
  const std::vector<LayerSums> layers = sums();
  const double layer_volume = grid_.layer_volume();
  LayerSums whole;
  std::vector<double> void_ratios;
  for (const LayerSums& layer : layers) {
    void_ratios.push_back(layer_state(layer, layer_volume).void_ratio);
    add_sums(whole, layer);
  }
  const LayerState state = layer_state(whole, layer_volume * grid_.layers);
  values_ = {void_ratio_variance(void_ratios, state.void_ratio), state.void_ratio, state.coordination,
             mean_stress(state.stress), axial_deviatoric_stress(state.stress, grid_.axis)};
  vector = values_.data();
}

void ComputeStressLayer::compute_array() {
  invoked_array = update->ntimestep;
  const std::vector<LayerSums> layers = sums();
  for (int k = 0; k < grid_.layers; ++k) {
    const LayerState state = layer_state(layers[static_cast<std::size_t>(k)], grid_.layer_volume());
    const suffuse::Mat3& s = state.stress;
    const Box box = grid_.layer_box(k);
    const double row[12] = {s(0, 0),
                            s(1, 1),
                            s(2, 2),
                            s(0, 1),
                            s(0, 2),
                            s(1, 2),
                            state.void_ratio,
                            state.coordination,
                            mean_stress(s),
                            state.grains,
                            state.stable_share,
                            (box.low[grid_.axis] + box.high[grid_.axis]) / 2};
    std::copy(row, row + 12, array[k]);
  }
}
