#include "scene_checks.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "abstract_mesh.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "fix_mesh.h"
#include "lammps.h"
#include "modify.h"
#include "style_support.h"
#include "suffuse/common/count_text.h"
#include "suffuse/common/error.h"

namespace suffuse {

using LAMMPS_NS::LAMMPS;

namespace {

std::int64_t over_ranks(LAMMPS* lmp, std::int64_t mine, MPI_Op operation) {
  MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_INT64_T, operation, lmp->world);
  return mine;
}

/// The numbers of all ranks' grains whose remainder by the number of ranks is this rank's, sorted.
std::vector<int> numbers_of_this_rank(LAMMPS* lmp) {
  const int ranks = lmp->comm->nprocs;
  std::vector<std::vector<int>> to(static_cast<std::size_t>(ranks));
  for (int i = 0; i < lmp->atom->nlocal; ++i)
    to[static_cast<std::size_t>(lmp->atom->tag[i] % ranks)].push_back(lmp->atom->tag[i]);
  std::vector<int> counts, places{0}, sent;
  for (const std::vector<int>& numbers : to) {
    counts.push_back(static_cast<int>(numbers.size()));
    places.push_back(places.back() + counts.back());
    sent.insert(sent.end(), numbers.begin(), numbers.end());
  }
  std::vector<int> received_counts(to.size()), received_places{0};
  MPI_Alltoall(counts.data(), 1, MPI_INT, received_counts.data(), 1, MPI_INT, lmp->world);
  for (const int count : received_counts) received_places.push_back(received_places.back() + count);
  std::vector<int> received(static_cast<std::size_t>(received_places.back()));
  MPI_Alltoallv(sent.data(), counts.data(), places.data(), MPI_INT, received.data(), received_counts.data(),
                received_places.data(), MPI_INT, lmp->world);
  std::sort(received.begin(), received.end());
  return received;
}

/// By all `fix insert/...` of the script.
std::int64_t inserted_so_far(LAMMPS* lmp) {
  double inserted = 0;
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (std::string_view(lmp->modify->fix[i]->style).starts_with("insert/"))
      inserted += lmp->modify->fix[i]->compute_vector(0);
  return std::llround(inserted);
}

bool some_fix_removes_grains(LAMMPS* lmp) {
  for (int i = 0; i < lmp->modify->nfix; ++i)
    for (const char* word : {"massflow", "remove", "break", "evaporate", "loading/platen"})
      if (std::string_view(lmp->modify->fix[i]->style).find(word) != std::string_view::npos) return true;
  return false;
}

/// Along which axes nodes of the mesh lie outside of periodic faces, of all ranks: a bit an axis.
int axes_left(LAMMPS* lmp, LAMMPS_NS::AbstractMesh& mesh) {
  const auto* domain = lmp->domain;
  int axes = 0;
  for (int element = 0; element < mesh.sizeLocal(); ++element)
    for (int corner = 0; corner < mesh.numNodes(); ++corner) {
      double node[3];
      mesh.node_slow(element, corner, node);
      for (int a = 0; a < 3; ++a) {
        const double rounding = 1e-6 * (domain->boxhi[a] - domain->boxlo[a]);
        const bool outside = node[a] < domain->boxlo[a] - rounding || node[a] > domain->boxhi[a] + rounding;
        if (domain->periodicity[a] != 0 && outside) axes |= 1 << a;
      }
    }
  MPI_Allreduce(MPI_IN_PLACE, &axes, 1, MPI_INT, MPI_BOR, lmp->world);
  return axes;
}

}  // namespace

void require_unique_grains(LAMMPS* lmp, const char* who) {
  if (lmp->domain->box_exist == 0 || lmp->atom->tag_enable == 0) return;
  const std::vector<int> numbers = numbers_of_this_rank(lmp);
  std::int64_t twice = 0;
  for (auto at = numbers.begin(); (at = std::adjacent_find(at, numbers.end())) != numbers.end(); ++at)
    if (*at > 0) {
      twice = *at;
      break;
    }
  twice = over_ranks(lmp, twice, MPI_MAX);
  if (twice > 0)
    throw_user_error(
        {who, "grain", fmt::format("{} twice", twice), "have a number of its own",
         "mend the numbers in the file; LIGGGHTS's `replicate` gives the same ones on several ranks"});
}

void tell_meshes_beyond_periodic_faces(LAMMPS* lmp) {
  static std::set<std::string> told;
  for (int i = 0; i < lmp->modify->nfix; ++i) {
    auto* mesh = dynamic_cast<LAMMPS_NS::FixMesh*>(lmp->modify->fix[i]);
    if (mesh == nullptr || mesh->mesh() == nullptr || told.count(mesh->id) > 0) continue;
    const int axes = axes_left(lmp, *mesh->mesh());
    if (axes == 0) continue;
    told.insert(mesh->id);
    std::string names;
    for (int a = 0; a < 3; ++a)
      if ((axes & (1 << a)) != 0) names += (names.empty() ? "" : " and ") + std::string(1, "xyz"[a]);
    tell(lmp,
         fmt::format(
             "suffuse: note: mesh {} reaches out of the periodic faces across {}: LIGGGHTS adds copies of "
             "what is outside, and grains that touch a triangle and a copy feel both; end the mesh at "
             "the faces (docs/what_goes_wrong.md)\n",
             mesh->id, names));
  }
}

void tell_box_of_few_grains(LAMMPS* lmp) {
  static bool told = false;
  const auto* domain = lmp->domain;
  const auto* atom = lmp->atom;
  double largest = 0;
  for (int i = 0; atom->radius != nullptr && i < atom->nlocal; ++i)
    largest = std::max(largest, atom->radius[i]);
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, lmp->world);
  double shortest = 4 * largest;
  for (int a = 0; a < 3; ++a)
    if (domain->periodicity[a] != 0) shortest = std::min(shortest, domain->boxhi[a] - domain->boxlo[a]);
  if (told || shortest >= 4 * largest) return;
  told = true;
  tell(lmp, fmt::format(
                "suffuse: note: the periodic box is {:.3g} m across, its largest grain {:.3g} m: below two "
                "diameters a pair may touch by two images, which share one tangential spring; take more "
                "grains (docs/what_goes_wrong.md)\n",
                shortest, 2 * largest));
}

GrainCensus::GrainCensus(LAMMPS* lmp)
    : lmp_(lmp), grains_(over_ranks(lmp, lmp->atom->nlocal, MPI_SUM)), inserted_(inserted_so_far(lmp)) {}

std::int64_t GrainCensus::lost() const {
  const std::int64_t now = over_ranks(lmp_, lmp_->atom->nlocal, MPI_SUM);
  const std::int64_t lost = grains_ + inserted_so_far(lmp_) - inserted_ - now;
  return some_fix_removes_grains(lmp_) ? 0 : std::max<std::int64_t>(0, lost);
}

void GrainCensus::tell_lost() const {
  const std::int64_t lost = this->lost();
  const std::int64_t now = over_ranks(lmp_, lmp_->atom->nlocal, MPI_SUM);
  if (lost == 0) return;
  tell(lmp_,
       fmt::format(
           "suffuse: note: {} left the box in this run and {} lost; {} {} left (`thermo_modify lost error` "
           "ends a run that loses one; docs/what_goes_wrong.md)\n",
           count_text(lost, "grain"), lost == 1 ? "is" : "are", now, now == 1 ? "is" : "are"));
}

}  // namespace suffuse
