#include "fluid_box.h"

#include <fmt/format.h>

#include <algorithm>

#include "domain.h"
#include "lammps.h"
#include "region.h"
#include "region_block.h"
#include "suffuse/common/error.h"

namespace suffuse::coupling {

FluidBox fluid_box(LAMMPS_NS::LAMMPS* lmp, const GrainQuestions& questions, const std::string& region) {
  if (region.empty()) return {questions.box_low(), questions.box_size()};
  std::string name = region;
  const int index = lmp->domain->find_region(name.data());
  if (index < 0 || std::string(lmp->domain->regions[index]->style) != "block")
    throw_user_error({"lbm lattice", "region", region, "be a block region that exists",
                      fmt::format("write `region {} block ...` before", region)});
  const auto* block = lmp->domain->regions[index];
  FluidBox box{{block->extent_xlo, block->extent_ylo, block->extent_zlo},
               {block->extent_xhi, block->extent_yhi, block->extent_zhi}};
  const Vec3 low = questions.box_low(), high = low + questions.box_size();
  for (int a = 0; a < 3; ++a) {
    box.low[a] = std::max(box.low[a], low[a]);
    box.size[a] = std::min(box.size[a], high[a]) - box.low[a];
    if (lmp->domain->periodicity[a] != 0 && box.size[a] < 0.999999 * questions.box_size()[a])
      throw_user_error({"lbm lattice", "region", region, "span the whole box along a periodic axis", ""});
  }
  return box;
}

}  // namespace suffuse::coupling
