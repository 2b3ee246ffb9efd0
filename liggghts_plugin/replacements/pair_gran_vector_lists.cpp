// What PairGranVector makes of new neighbour lists, and what it gives back to them.
#include <algorithm>
#include <cmath>

#include "atom.h"
#include "domain.h"
#include "neigh_list.h"
#include "pair_gran_vector.h"

namespace LAMMPS_NS {

using suffuse::grains::TangentialLaw;

namespace {
constexpr double kNever = -1;  // w of a spring whose pair has not touched
/// Pairs among which those that touch come first: near each other, so that the grains stay in the cache, and
/// enough that their springs fill whole lines of it.
constexpr std::size_t kPairsOfABlock = 512;
/// A grain of `fix freeze` has no mass of its own in a contact (LIGGGHTS takes the partner's for both); where
/// both are frozen their forces are not used, but stay numbers.
constexpr double kFrozenInverseMass = 1e-30;
}  // namespace

void PairGranVector::take_lists() {
  std::size_t total = 0;
  for (int ii = 0; ii < list->inum; ++ii) total += static_cast<std::size_t>(list->numneigh[list->ilist[ii]]);
  first_.resize(total);
  second_.resize(total);
  std::size_t k = 0;
  for (int ii = 0; ii < list->inum; ++ii) {
    const int i = list->ilist[ii];
    for (int jj = 0; jj < list->numneigh[i]; ++jj, ++k) {
      first_[k] = i;
      second_[k] = list->firstneigh[i][jj] & NEIGHMASK;
    }
  }
  find_owners();
  find_twins();
  choose_active();
  take_springs();
  lists_are_newer_ = springs_are_newer_ = false;
}

void PairGranVector::find_owners() {
  const int owned = atom->nlocal, all = owned + atom->nghost;
  // Under `fix deform ... remap v` an image has another velocity than its original.
  const bool can_map = atom->map_style != 0 && domain->deform_vremap == 0;
  owner_.resize(static_cast<std::size_t>(all));
  for (int i = 0; i < all; ++i) {
    int& owner = owner_[static_cast<std::size_t>(i)];
    owner = i;
    if (i < owned) continue;
    const int original = can_map ? atom->map(atom->tag[i]) : -1;
    if (original >= 0 && original < owned) owner = original;
  }
  immovable_.resize(static_cast<std::size_t>(all));
  for (int i = 0; i < all; ++i)
    immovable_[static_cast<std::size_t>(i)] =
        (atom->mask[i] & freeze_group_bit_) != 0 ? kFrozenInverseMass : 1;
}

/// A pair across a periodic face of a rank's own stands twice in the lists, as (i, image of o) and (o, image
/// of i): found by its grains and the number of box lengths between the two.
void PairGranVector::find_twins() {
  struct Image {
    std::int64_t grains;
    int shift;
    std::uint32_t pair;
  };
  std::vector<Image> images;
  twin_.assign(first_.size(), kNoTwin);
  const int owned = atom->nlocal;
  for (std::size_t k = 0; k < first_.size(); ++k) {
    const int i = first_[k], j = second_[k], o = owner_[static_cast<std::size_t>(j)];
    if (j < owned || o == j || o == i) continue;
    int shift = 0;
    for (int d = 0; d < 3; ++d) {
      const auto boxes = static_cast<int>(std::lround((atom->x[j][d] - atom->x[o][d]) / domain->prd[d]));
      shift = shift * 16 + 8 + (i < o ? boxes : -boxes);
    }
    images.push_back({static_cast<std::int64_t>(std::min(i, o)) << 32 | std::max(i, o), shift,
                      static_cast<std::uint32_t>(k)});
  }
  std::sort(images.begin(), images.end(), [](const Image& a, const Image& b) {
    return a.grains != b.grains ? a.grains < b.grains
           : a.shift != b.shift ? a.shift < b.shift
                                : a.pair < b.pair;
  });
  for (std::size_t k = 0; k + 1 < images.size(); ++k) {
    const Image &a = images[k], &b = images[k + 1];
    if (a.grains != b.grains || a.shift != b.shift || first_[a.pair] == first_[b.pair]) continue;
    twin_[a.pair] = b.pair;
    twin_[b.pair] = a.pair;
    ++k;
  }
}

bool PairGranVector::is_second(std::size_t pair) const {
  return twin_[pair] != kNoTwin && twin_[pair] < pair;
}

/// Each pair once; within blocks those that touch now come first, in whose springs the passes then find one
/// behind the other.
void PairGranVector::order_active() {
  active_pair_.clear();
  for (std::size_t k = 0; k < first_.size(); ++k)
    if (!is_second(k)) active_pair_.push_back(static_cast<std::uint32_t>(k));
  const auto touches = [this](std::uint32_t pair) {
    const int i = first_[pair], j = second_[pair];
    double square = 0;
    for (int d = 0; d < 3; ++d) square += (atom->x[i][d] - atom->x[j][d]) * (atom->x[i][d] - atom->x[j][d]);
    const double reach = atom->radius[i] + atom->radius[j];
    return square < reach * reach;
  };
  for (std::size_t start = 0; start < active_pair_.size(); start += kPairsOfABlock) {
    const auto begin = active_pair_.begin() + static_cast<std::ptrdiff_t>(start);
    const std::size_t end = std::min(active_pair_.size(), start + kPairsOfABlock);
    std::stable_partition(begin, active_pair_.begin() + static_cast<std::ptrdiff_t>(end), touches);
  }
}

void PairGranVector::choose_active() {
  const int owned = atom->nlocal, nobody = owned;
  loads_.assign(static_cast<std::size_t>(owned) + 1, {});
  images_.clear();
  foreign_.clear();
  active_first_.clear();
  active_second_.clear();
  active_motion_.clear();
  active_receiver_.clear();
  active_of_.resize(first_.size());
  order_active();
  std::vector<bool> seen(static_cast<std::size_t>(atom->nghost), false);
  for (const std::uint32_t k : active_pair_) {
    const bool has_twin = twin_[k] != kNoTwin;
    const int j = second_[k], owner = owner_[static_cast<std::size_t>(j)];
    if (j >= owned && !seen[static_cast<std::size_t>(j - owned)]) {
      seen[static_cast<std::size_t>(j - owned)] = true;
      images_.push_back(static_cast<std::size_t>(j));
      if (owner == j) foreign_.push_back(static_cast<std::size_t>(j));
    }
    active_of_[k] = static_cast<std::uint32_t>(active_first_.size());
    if (has_twin) active_of_[twin_[k]] = active_of_[k];
    active_first_.push_back(first_[k]);
    active_second_.push_back(j);
    active_motion_.push_back(owner);
    // Without a twin the other side of the pair is in another rank's list.
    active_receiver_.push_back(j < owned ? j : has_twin ? owner : nobody);
  }
}

void PairGranVector::take_springs() {
  springs_.clear();
  if (law_.tangential != TangentialLaw::history) return;
  springs_.resize(active_pair_.size(), {0, 0, 0, kNever});
  std::size_t k = 0;
  for (int ii = 0; ii < list->inum; ++ii) {
    const int i = list->ilist[ii];
    const int* flags = listgranhistory->firstneigh[i];
    const double* values = listgranhistory->firstdouble[i];
    for (int jj = 0; jj < list->numneigh[i]; ++jj, ++k)
      if (flags[jj] != 0 && !is_second(k))
        springs_[active_of_[k]] = {values[3 * jj], values[3 * jj + 1], values[3 * jj + 2], pass_number_};
  }
}

void PairGranVector::springs_to_lists() {
  if (!springs_are_newer_) return;
  springs_are_newer_ = false;
  std::size_t k = 0;
  for (int ii = 0; ii < list->inum; ++ii) {
    const int i = list->ilist[ii];
    int* flags = listgranhistory->firstneigh[i];
    double* values = listgranhistory->firstdouble[i];
    for (int jj = 0; jj < list->numneigh[i]; ++jj, ++k) {
      const auto& spring = springs_[active_of_[k]];
      const bool held = spring.w >= (drop_lost_springs_ ? pass_number_ : 0);
      const double sign = !held ? 0 : is_second(k) ? -1 : 1;
      flags[jj] = held ? 1 : 0;
      values[3 * jj] = sign * spring.x;
      values[3 * jj + 1] = sign * spring.y;
      values[3 * jj + 2] = sign * spring.z;
    }
  }
}

}  // namespace LAMMPS_NS
