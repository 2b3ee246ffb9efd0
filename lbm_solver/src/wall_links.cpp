#include "wall_links.h"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace suffuse::lbm {

namespace {

/// Interpolated differences are whole multiples of this, so that their sum is the same in any order: a
/// millionth of a millionth of a population's scale and less.
constexpr double kUnit = 0x1p-44;

/// Weights in 36ths are whole numbers.
std::int64_t weight_36(int direction) {
  return std::lround(36 * kWeight[direction]);
}

/// Links lie apart in memory: what the next ones need is fetched meanwhile.
constexpr std::size_t kAhead = 12;

double share_of(double distance) {
  return distance < 0.5 ? 1 - 2 * distance : 1 - 1 / (2 * distance);
}

}  // namespace

template <class T>
typename WallLinks<T>::Group& WallLinks<T>::group_of(int direction, bool second_streams_in) {
  for (Group& group : groups_)
    if (group.direction == direction && group.second_streams_in == second_streams_in) return group;
  groups_.push_back({direction, second_streams_in, {}});
  return groups_.back();
}

template <class T>
WallLinks<T>::WallLinks(const Decomposition& decomposition, const Populations<T>& populations,
                        const Walls& walls)
    : communicator_(decomposition.communicator()) {
  const Index3& lo = decomposition.local_box().lo;
  const auto index = [&](const WallLink& link) {
    return populations.index(link.cell[0] - lo[0], link.cell[1] - lo[1], link.cell[2] - lo[2]);
  };
  std::set<std::pair<std::ptrdiff_t, int>> cut;
  for (const WallLink& link : walls.links) cut.insert({index(link), link.direction});
  int interpolates = 0;
  for (const WallLink& link : walls.links) {
    const std::ptrdiff_t cell = index(link);
    const bool free_behind = !cut.contains({cell, opposite(link.direction)});
    Group& group = group_of(link.direction, link.distance < 0.5 && free_behind);
    group.links.push_back({cell, share_of(link.distance), link.space});
    if (group.links.back().share != 0) interpolates = 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, &interpolates, 1, MPI_INT, MPI_MAX, communicator_);
  interpolates_ = interpolates != 0;
  returned_.resize(walls.links.size());
  count_weights(walls);
}

template <class T>
void WallLinks<T>::count_weights(const Walls& walls) {
  const auto spaces = static_cast<std::size_t>(walls.spaces);
  weights_.assign(spaces, 0);
  added_.assign(spaces, 0);
  for (const WallLink& link : walls.links)
    if (link.space >= 0) weights_[static_cast<std::size_t>(link.space)] += weight_36(link.direction);
  MPI_Allreduce(MPI_IN_PLACE, weights_.data(), walls.spaces, MPI_INT64_T, MPI_SUM, communicator_);
}

/// Notes what each link of a group returns, from number n on; the number after the last.
template <class T>
template <bool kAfterOddStep>
std::size_t WallLinks<T>::read(const Populations<T>& populations, const Group& group, std::size_t n) {
  const int i = group.direction, j = opposite(i);
  const std::ptrdiff_t ahead = populations.offset_of(i);
  // After an even step a cell's outgoing populations lie in its own slots of the opposite direction; after an
  // odd one in the neighbours' slots of their own direction, where the next step of the neighbours finds
  // them.
  const T* leaving = kAfterOddStep ? populations.slot(i) + ahead : populations.slot(j);
  const T* leaving_back = kAfterOddStep ? populations.slot(j) - ahead : populations.slot(i);
  const T* streaming_in = kAfterOddStep ? populations.slot(i) : populations.slot(j) - ahead;
  const T* second = group.second_streams_in ? streaming_in : leaving_back;
  for (std::size_t k = 0; k < group.links.size(); ++k, ++n) {
    if (k + kAhead < group.links.size()) {
      const std::ptrdiff_t next = group.links[k + kAhead].cell;
      __builtin_prefetch(leaving + next);
      __builtin_prefetch(second + next);
    }
    const Link& link = group.links[k];
    const double out = static_cast<double>(leaving[link.cell]);
    returned_[n] = out;
    if (link.share == 0) continue;
    const double units = std::rint(link.share * (static_cast<double>(second[link.cell]) - out) / kUnit);
    returned_[n] = out + units * kUnit;
    // A flow that has blown up is told elsewhere; it must not leave the range of whole numbers here.
    constexpr double most = 0x1p60;
    if (link.space >= 0 && std::abs(units) < most)
      added_[static_cast<std::size_t>(link.space)] += static_cast<std::int64_t>(units);
  }
  return n;
}

/// What every link of a space gives back, for a weight of one.
template <class T>
std::vector<double> WallLinks<T>::corrections() const {
  std::vector<std::int64_t> all = added_;
  MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_INT64_T, MPI_SUM, communicator_);
  std::vector<double> corrections(all.size(), 0);
  for (std::size_t s = 0; s < all.size(); ++s)
    if (weights_[s] > 0)
      corrections[s] = kUnit * static_cast<double>(all[s]) * 36 / static_cast<double>(weights_[s]);
  return corrections;
}

template <class T>
template <bool kAfterOddStep>
void WallLinks<T>::apply(Populations<T>& populations) {
  // Two cells may write where the other reads: all are read first.
  std::fill(added_.begin(), added_.end(), 0);
  std::size_t n = 0;
  for (const Group& group : groups_) n = read<kAfterOddStep>(populations, group, n);
  const std::vector<double> correction =
      interpolates_ ? corrections() : std::vector<double>(added_.size(), 0);
  n = 0;
  for (const Group& group : groups_) {
    const int i = group.direction, j = opposite(i);
    T* entering = kAfterOddStep ? populations.slot(j) : populations.slot(i) + populations.offset_of(i);
    const double weight = kWeight[i];
    for (std::size_t k = 0; k < group.links.size(); ++k, ++n) {
      if (k + kAhead < group.links.size()) __builtin_prefetch(entering + group.links[k + kAhead].cell, 1);
      const Link& link = group.links[k];
      const double back = link.space >= 0 ? weight * correction[static_cast<std::size_t>(link.space)] : 0;
      entering[link.cell] = static_cast<T>(returned_[n] - back);
    }
  }
}

template <class T>
std::size_t WallLinks<T>::bytes() const {
  return returned_.capacity() * (sizeof(double) * 2 + sizeof(std::ptrdiff_t) + sizeof(int));
}

template class WallLinks<double>;
template class WallLinks<float>;

}  // namespace suffuse::lbm
