#include "compute_fabric.h"

#include "lammps.h"
#include "suffuse/micromechanics/fabric.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace suffuse::micromechanics;

ComputeFabric::ComputeFabric(LAMMPS* lmp_in, int& iarg, int narg, char** arg)
    : ContactCompute(lmp_in, iarg, narg, arg) {
  suffuse::ArgumentReader reader(who(), narg, arg, iarg);
  if (!reader.done()) reader.unknown(reader.word("keyword"), "(none)");
  declare_vector(14);
  declare_array(kOrientationBins, 7);
}

void ComputeFabric::compute_vector() {
  invoked_vector = update->ntimestep;
  const FabricSums sums = over_ranks(fabric_sums(packing()));
  const suffuse::Mat3 fabric = fabric_tensor(sums);
  values_ = {deviatoric_fabric(fabric),
             fabric(0, 0),
             fabric(1, 1),
             fabric(2, 2),
             fabric(0, 1),
             fabric(0, 2),
             fabric(1, 2),
             sums.contacts};
  for (const OrientationHistogram& histogram : sums.planes) {
    const RoseFit fit = fit_rose(histogram);
    values_.push_back(fit.anisotropy);
    values_.push_back(fit.direction);
  }
  vector = values_.data();
}

void ComputeFabric::compute_array() {
  invoked_array = update->ntimestep;
  const FabricSums sums = over_ranks(fabric_sums(packing()));
  for (int bin = 0; bin < kOrientationBins; ++bin) array[bin][0] = bin_centre(bin);
  for (std::size_t plane = 0; plane < sums.planes.size(); ++plane) {
    const auto density = orientation_density(sums.planes[plane]);
    for (std::size_t bin = 0; bin < density.size(); ++bin) {
      array[bin][1 + plane] = sums.planes[plane].counts[bin];
      array[bin][4 + plane] = density[bin];
    }
  }
}
