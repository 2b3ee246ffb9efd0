#include "grains/size_class_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace suffuse::grains {

int SizeClassPairs::Class::cell_of(double position, std::size_t axis) const {
  const double cell = (position - low[axis]) * inverse_width;
  if (!(cell > 0)) return 0;
  const int last = cells[axis] - 1;
  return cell >= last ? last : static_cast<int>(cell);
}

void SizeClassPairs::add(int a, int b) {
  if (pairs_ == pair_first_.size()) {
    const std::size_t larger = std::max<std::size_t>(1024, 2 * pairs_);
    pair_first_.resize(larger);
    pair_second_.resize(larger);
  }
  pair_first_[pairs_] = std::min(a, b);
  pair_second_[pairs_] = std::max(a, b);
  ++pairs_;
}

void SizeClassPairs::find(const Spheres& spheres, double distance_factor, double skin) {
  pairs_ = 0;
  sort_into_classes(spheres, distance_factor, skin);
  for (const Class& own : classes_)
    if (!own.spots.empty()) pairs_within(own, distance_factor, skin);
  for (std::size_t large = 1; large < kClasses; ++large)
    for (const Spot& spot : classes_[large].spots)
      for (std::size_t small = 0; small < large; ++small)
        partners_in(classes_[small], spot, true, distance_factor, skin);
  for (int copy = spheres.owned; copy < spheres.all; ++copy) {
    const double* x = spheres.positions + 3 * static_cast<std::ptrdiff_t>(copy);
    const Spot spot{x[0], x[1], x[2], spheres.radii[copy], copy, 0};
    for (const Class& other : classes_) partners_in(other, spot, false, distance_factor, skin);
  }
  gather_by_owner(spheres.owned);
}

void SizeClassPairs::sort_into_classes(const Spheres& spheres, double distance_factor, double skin) {
  const auto owned = static_cast<std::size_t>(spheres.owned);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double smallest = kInfinity;
  for (std::size_t i = 0; i < owned; ++i) smallest = std::min(smallest, spheres.radii[i]);

  std::array<double, 3> low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  std::array<std::size_t, kClasses> counts{};
  class_of_.resize(owned);
  for (Class& c : classes_) c.largest = 0;
  for (std::size_t i = 0; i < owned; ++i) {
    int exponent = 0;  // radius = f * 2^exponent * smallest with 1/2 <= f < 1
    std::frexp(spheres.radii[i] / smallest, &exponent);
    const int number = std::clamp(exponent - 1, 0, kClasses - 1);
    class_of_[i] = static_cast<signed char>(number);
    Class& own = classes_[static_cast<std::size_t>(number)];
    own.largest = std::max(own.largest, spheres.radii[i]);
    ++counts[static_cast<std::size_t>(number)];
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], spheres.positions[3 * i + d]);
      high[d] = std::max(high[d], spheres.positions[3 * i + d]);
    }
  }
  for (std::size_t n = 0; n < kClasses; ++n) {
    Class& c = classes_[n];
    c.spots.resize(counts[n]);
    if (counts[n] == 0) continue;
    // Not many more cells than spheres, however few there are in a large box.
    const double volume = (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
    c.width = std::max(2 * c.largest * distance_factor + skin,
                       std::cbrt(volume / (8 * static_cast<double>(counts[n]) + 64)));
    for (std::size_t d = 0; d < 3; ++d) c.width = std::max(c.width, (high[d] - low[d]) / 1024);
    c.inverse_width = 1 / c.width;
    c.low = low;
    for (std::size_t d = 0; d < 3; ++d)
      c.cells[d] = static_cast<int>((high[d] - low[d]) * c.inverse_width) + 1;
    c.start.assign(static_cast<std::size_t>(c.cells[0]) * static_cast<std::size_t>(c.cells[1]) *
                           static_cast<std::size_t>(c.cells[2]) +
                       1,
                   0);
  }

  cell_of_.resize(owned);
  for (std::size_t i = 0; i < owned; ++i) {
    Class& c = classes_[static_cast<std::size_t>(class_of_[i])];
    const double* x = spheres.positions + 3 * i;
    cell_of_[i] = (c.cell_of(x[2], 2) * c.cells[1] + c.cell_of(x[1], 1)) * c.cells[0] + c.cell_of(x[0], 0);
    ++c.start[static_cast<std::size_t>(cell_of_[i])];
  }
  for (Class& c : classes_) {
    if (c.spots.empty()) continue;
    int sum =
        0;  // start[cell] becomes the end of the cell, and its beginning as spheres are put in from the back
    for (int& s : c.start) s = sum += s;
  }
  for (std::size_t i = owned; i-- > 0;) {
    Class& c = classes_[static_cast<std::size_t>(class_of_[i])];
    const double* x = spheres.positions + 3 * i;
    const int place = --c.start[static_cast<std::size_t>(cell_of_[i])];
    c.spots[static_cast<std::size_t>(place)] = {x[0],       x[1], x[2], spheres.radii[i], static_cast<int>(i),
                                                cell_of_[i]};
  }
}

void SizeClassPairs::pairs_within(const Class& of, double distance_factor, double skin) {
  const int count = static_cast<int>(of.spots.size());
  const Spot* spots = of.spots.data();
  for (int a = 0; a < count; ++a) {
    const Spot& p = spots[a];
    const double reach = (p.radius + of.largest) * distance_factor + skin;
    const int x0 = of.cell_of(p.x - reach, 0), x1 = of.cell_of(p.x + reach, 0);
    const int y0 = of.cell_of(p.y - reach, 1), y1 = of.cell_of(p.y + reach, 1);
    const int z1 = of.cell_of(p.z + reach, 2);
    const int row = p.cell / of.cells[0], own_y = row % of.cells[1], own_z = row / of.cells[1];
    const auto look_at = [&](int from, int to) {
      for (int s = from; s < to; ++s) {
        const Spot& o = spots[s];
        const double dx = p.x - o.x, dy = p.y - o.y, dz = p.z - o.z;
        const double cut = (p.radius + o.radius) * distance_factor + skin;
        if (dx * dx + dy * dy + dz * dz <= cut * cut) add(p.sphere, o.sphere);
      }
    };
    look_at(a + 1, of.start[static_cast<std::size_t>(row * of.cells[0] + x1 + 1)]);
    for (int z = own_z; z <= z1; ++z)
      for (int y = z == own_z ? own_y + 1 : y0; y <= y1; ++y) {
        const int first = (z * of.cells[1] + y) * of.cells[0];
        look_at(of.start[static_cast<std::size_t>(first + x0)],
                of.start[static_cast<std::size_t>(first + x1 + 1)]);
      }
  }
}

void SizeClassPairs::partners_in(const Class& of, const Spot& asking, bool asking_is_owned,
                                 double distance_factor, double skin) {
  if (of.spots.empty()) return;
  const double reach = (asking.radius + of.largest) * distance_factor + skin;
  const double at[3] = {asking.x, asking.y, asking.z};
  for (std::size_t d = 0; d < 3 && !asking_is_owned; ++d)
    if (at[d] + reach < of.low[d] || at[d] - reach > of.low[d] + of.cells[d] * of.width) return;
  const int y0 = of.cell_of(at[1] - reach, 1), y1 = of.cell_of(at[1] + reach, 1);
  const int z0 = of.cell_of(at[2] - reach, 2), z1 = of.cell_of(at[2] + reach, 2);
  const Spot* spots = of.spots.data();
  for (int z = z0; z <= z1; ++z) {
    const double low_z = of.low[2] + z * of.width;
    const double dz = std::max({0., low_z - at[2], at[2] - low_z - of.width});
    for (int y = y0; y <= y1; ++y) {
      const double low_y = of.low[1] + y * of.width;
      const double dy = std::max({0., low_y - at[1], at[1] - low_y - of.width});
      // A sphere on a cell's border may stand on the other side by rounding.
      const double rest = reach * reach * (1 + 1e-12) - dz * dz - dy * dy;
      if (rest < 0) continue;
      const double half = std::sqrt(rest) + 1e-9 * of.width;
      const int row = (z * of.cells[1] + y) * of.cells[0];
      const int from = of.start[static_cast<std::size_t>(row + of.cell_of(at[0] - half, 0))];
      const int to = of.start[static_cast<std::size_t>(row + of.cell_of(at[0] + half, 0) + 1)];
      for (int s = from; s < to; ++s) {
        const Spot& o = spots[s];
        const double dx = at[0] - o.x, ey = at[1] - o.y, ez = at[2] - o.z;
        const double cut = (asking.radius + o.radius) * distance_factor + skin;
        if (dx * dx + ey * ey + ez * ez <= cut * cut) add(asking.sphere, o.sphere);
      }
    }
  }
}

void SizeClassPairs::gather_by_owner(int owned) {
  const auto spheres = static_cast<std::size_t>(owned);
  first_.assign(spheres + 1, 0);
  for (std::size_t k = 0; k < pairs_; ++k) ++first_[static_cast<std::size_t>(pair_first_[k]) + 1];
  for (std::size_t i = 0; i < spheres; ++i) first_[i + 1] += first_[i];
  partners_.resize(pairs_);
  next_.assign(first_.begin(), first_.end());
  for (std::size_t k = 0; k < pairs_; ++k)
    partners_[next_[static_cast<std::size_t>(pair_first_[k])]++] = pair_second_[k];
  for (std::size_t i = 0; i < spheres; ++i)
    std::sort(partners_.begin() + static_cast<std::ptrdiff_t>(first_[i]),
              partners_.begin() + static_cast<std::ptrdiff_t>(first_[i + 1]));
}

}  // namespace suffuse::grains
