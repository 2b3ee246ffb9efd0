#pragma once

#include <array>
#include <span>
#include <vector>

#include "suffuse/micromechanics/contact_network.h"
#include "suffuse/micromechanics/coordination.h"
#include "suffuse/micromechanics/slipping.h"
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
  double fines_volume = 0;  ///< solid volume of the fines, m³
  TensorSum fines_stress;   ///< Σ σ^p V_p × share over the fines, N·m
};

/// One entry a layer. Without a split no grain is a fine one.
std::vector<LayerSums> layer_sums(const Packing& packing, const LayerGrid& grid, GrainArm arm,
                                  SizeSplit split = {});

/// What one rank's contacts add to the layers that the middles between their grains lie in. The grid's side
/// faces do not cut.
std::vector<SlidingSums> layer_sliding_sums(const Packing& packing, const LayerGrid& grid,
                                            const SlidingRule& rule);

/// State of a layer (thesis eqs 6.3–6.5). Void ratio and coordination are 0 in a layer without solids.
struct LayerState {
  Mat3 stress = Mat3::Zero();  ///< Cauchy, compression positive, contacts only, Pa
  double void_ratio = 0;       ///< overlaps are counted twice as solid
  double coordination = 0;     ///< mean number of contacts of the layer's grains
  double grains = 0;
  double stable_share = 0;  ///< M_s
};

LayerState layer_state(const LayerSums& sums, double layer_volume);

/// What fines are and do in a layer. All 0 without solids.
struct LayerFines {
  double porosity = 0;
  double fines_share = 0;       ///< of the solids' volume
  double coordination = 0;      ///< Z of all grains of the layer
  double shire = 0;             ///< α of the layer (stress_reduction.h)
  double sufian = 0;            ///< share of the layer's mean stress that its fines carry
  double sliding_share = 0;     ///< S_c
  double constraint_ratio = 0;  ///< R = Z(3 − 2S_c)/12 (eq 6.7)
};

LayerFines layer_fines(const LayerSums& sums, const SlidingSums& contacts, double layer_volume);

/// S² = Σ(e_k − e_avg)²/(n_L − 1) (thesis eq 6.1; `jiang2003`), e_avg the void ratio of the whole sample. 0
/// for fewer than two layers.
double void_ratio_variance(std::span<const double> void_ratios, double sample_void_ratio);

}  // namespace suffuse::micromechanics
