#include "contacts/force_table.h"

namespace suffuse::analysis {

void write_force_pdf(CsvWriter& writer, std::int64_t step, const micromechanics::ForceBins& bins,
                     const micromechanics::ForceDistribution& forces) {
  for (std::size_t bin = 0; bin < forces.normal.size(); ++bin)
    writer.write({{"step", static_cast<double>(step)},
                  {"force_over_mean_low", static_cast<double>(bin) * bins.width},
                  {"force_over_mean_high", static_cast<double>(bin + 1) * bins.width},
                  {"density_normal", forces.normal[bin]},
                  {"density_tangential", forces.tangential[bin]},
                  {"mean_normal_force_n", forces.mean_normal},
                  {"mean_tangential_force_n", forces.mean_tangential}});
}

}  // namespace suffuse::analysis
