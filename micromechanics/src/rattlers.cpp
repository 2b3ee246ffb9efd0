#include "suffuse/micromechanics/rattlers.h"

#include <cstdint>

namespace suffuse::micromechanics {
namespace {

std::size_t place(int i) {
  return static_cast<std::size_t>(i);
}

/// For each grain where its row of neighbours begins, and all rows one after the other.
struct Neighbours {
  std::vector<std::uint32_t> begin;
  std::vector<int> grain;
};

Neighbours neighbours_of(const Packing& packing) {
  Neighbours result;
  result.begin.assign(packing.grains.size() + 1, 0);
  const auto each_end = [&](const auto& visit) {
    for (const Contact& c : packing.contacts) {
      if (!owns_second(c)) continue;
      visit(c.first, c.second);
      visit(c.second, c.first);
    }
  };
  each_end([&](int from, int) { ++result.begin[place(from)]; });
  for (std::size_t i = 1; i < result.begin.size(); ++i) result.begin[i] += result.begin[i - 1];
  result.grain.resize(result.begin.back());
  // Where a row ends becomes where it begins.
  each_end([&](int from, int to) { result.grain[--result.begin[place(from)]] = to; });
  return result;
}

}  // namespace

std::vector<bool> load_bearing(const Packing& packing, int minimum) {
  std::vector<int> contacts = contacts_per_grain(packing);
  std::vector<bool> bearing(packing.grains.size(), true);
  std::vector<int> leaving;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (contacts[i] < minimum) leaving.push_back(static_cast<int>(i));
  for (const int i : leaving) bearing[place(i)] = false;
  const Neighbours neighbours = neighbours_of(packing);
  while (!leaving.empty()) {
    const std::size_t gone = place(leaving.back());
    leaving.pop_back();
    for (std::size_t k = neighbours.begin[gone]; k < neighbours.begin[gone + 1]; ++k) {
      const int other = neighbours.grain[k];
      if (--contacts[place(other)] >= minimum || !bearing[place(other)]) continue;
      bearing[place(other)] = false;
      leaving.push_back(other);
    }
  }
  return bearing;
}

Rattlers rattlers(const Packing& packing, const std::vector<bool>& bearing, SizeSplit split) {
  double fines = 0, loose = 0, loose_fines = 0, volume = 0, loose_volume = 0;
  for (std::size_t i = 0; i < packing.grains.size(); ++i) {
    const double radius = packing.grains[i].radius, grain_volume = sphere_volume(radius);
    const bool fine = split.is_fine(radius), rattles = !bearing[i];
    fines += fine;
    loose += rattles;
    loose_fines += fine && rattles;
    volume += grain_volume;
    if (rattles) loose_volume += grain_volume;
  }
  Rattlers result;
  if (packing.grains.empty()) return result;
  result.share = loose / static_cast<double>(packing.grains.size());
  result.fines_share = fines > 0 ? loose_fines / fines : 0;
  result.solid_share = volume > 0 ? loose_volume / volume : 0;
  return result;
}

}  // namespace suffuse::micromechanics
