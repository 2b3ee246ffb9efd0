#pragma once

#include <array>
#include <span>
#include <vector>

#include "suffuse/micromechanics/contact_network.h"
#include "suffuse/micromechanics/sphere_cut.h"
#include "suffuse/micromechanics/stress.h"
#include "suffuse/micromechanics/sums.h"

namespace suffuse::micromechanics {

/// How a grain that straddles two layers, or the edge of the column, is shared out.
enum class GrainShare {
  volume,  ///< each layer takes the part of the grain's volume (and stress, and contacts) that lies in it
  centre   ///< the layer that holds the centre takes the whole grain
};

/// Equal layers across an axis-aligned column of the sample (thesis §6.3, Fig. 6.1c).
struct LayerGrid {
  int axis = 2;                   ///< 0, 1, 2: across the layers
  int layers = 1;                 ///< > 0
  bool numbered_from_top = true;  ///< layer 0 at the high end, as in the thesis; else at the low end
  Box column;                     ///< finite; bounds the layers on all sides, m
  std::array<bool, 3> cut{true, true,
                          true};  ///< false on a side axis: the column has the sample's own width there,
                                  ///< and grains that reach over it (walls, periodic faces) count whole
  Vec3 period = Vec3::Zero();     ///< length of the box along periodic axes, 0 along the others, m
  GrainShare share = GrainShare::volume;

  double layer_volume() const;     ///< m³
  Box layer_box(int layer) const;  ///< infinite along side axes that are not cut
};

/// What one rank adds to a layer.
struct LayerSums {
  TensorSum stress;         ///< Σ σ^p V_p × share, N·m
  double solid_volume = 0;  ///< m³
  double grains = 0;        ///< Σ share
  double contacts = 0;      ///< Σ share × contacts of the grain
  double stable = 0;        ///< Σ share over grains with four or more contacts
};

/// One entry a layer; contiguous, so that the whole vector can be reduced as doubles.
std::vector<LayerSums> layer_sums(const Packing& packing, const LayerGrid& grid, GrainArm arm);

/// All layers as one row of doubles.
std::span<double> as_doubles(std::vector<LayerSums>& layers);

/// State of a layer (thesis eqs 6.3–6.5). Void ratio and coordination are 0 in a layer without solids.
struct LayerState {
  Mat3 stress = Mat3::Zero();  ///< Cauchy, compression positive, contacts only, Pa
  double void_ratio = 0;       ///< overlaps are counted twice as solid
  double coordination = 0;     ///< mean number of contacts of the layer's grains
  double grains = 0;
  double stable_share = 0;  ///< M_s
};

LayerState layer_state(const LayerSums& sums, double layer_volume);

/// S² = Σ(e_k − e_avg)²/(n_L − 1) (thesis eq 6.1; `jiang2003`), e_avg the void ratio of the whole sample. 0
/// for fewer than two layers.
double void_ratio_variance(std::span<const double> void_ratios, double sample_void_ratio);

}  // namespace suffuse::micromechanics
