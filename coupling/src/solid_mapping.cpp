#include "suffuse/coupling/solid_mapping.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "mapping_kernels.h"
#include "suffuse/simd/dispatch.h"

namespace suffuse::coupling {

namespace {

/// Beyond radius + this a cell's centre is too far for the sphere to cover any of the cell.
double reach_beyond_radius(FractionMethod method, double radius) {
  return method == FractionMethod::linear && radius >= kLeastLinearRadius ? 0.5 : 0.8660255;
}

/// Jones & Williams (docs key: joneswilliams2017): the fraction of a cell with a face towards the centre at
/// distance d is f(r) - (d - r), with f = V_a - r + 1/2 and V_a <= r the volume under the sphere over a unit
/// square. Radii from 0.71 on.
float linear_offset(double r) {
  const double square = r * r, s = std::sqrt(square - 0.5);
  const double volume = (1. / 12 - square) * std::atan(0.5 * s / (0.5 - square)) + s / 3 +
                        (square - 1. / 12) * std::atan(0.5 / s) -
                        4. / 3 * r * square * std::atan(0.25 / (r * s));
  return static_cast<float>(volume - r + 0.5);
}

CellArrays plain(const lbm::PartialSolidArrays& arrays, const lbm::CellBox& box,
                 const lbm::ExchangeArrays& exchange, const float* pore_coefficients) {
  CellArrays plain{};
  plain.pore_coefficient = pore_coefficients;
  plain.cells_x = box.extent(0);
  plain.row_pitch = arrays.row_pitch;
  plain.plane_pitch = arrays.plane_pitch;
  plain.fraction = arrays.fraction;
  plain.strength = arrays.strength;
  for (std::size_t a = 0; a < 3; ++a) {
    plain.lo[a] = box.lo[a];
    plain.momentum[a] = arrays.momentum[a];
    if (const auto* in_double = std::get_if<0>(&exchange)) plain.exchange_double[a] = (*in_double)[a];
    if (const auto* in_float = std::get_if<1>(&exchange)) plain.exchange_float[a] = (*in_float)[a];
  }
  return plain;
}

}  // namespace

SolidMapping::SolidMapping(const SolidSettings& settings, lbm::InstructionSet instruction_set,
                           const lbm::PartialSolidArrays& arrays, const lbm::CellBox& local_box,
                           int rows_per_block)
    : settings_(settings),
      instruction_set_(instruction_set),
      arrays_(arrays),
      box_(local_box),
      rows_per_block_(rows_per_block),
      blocks_per_plane_((local_box.extent(1) + rows_per_block - 1) / rows_per_block),
      dirty_(static_cast<std::size_t>(local_box.extent(2)), 0) {}

void SolidMapping::set_place(const LatticeSphere& sphere, MappedSphere& mapped) const {
  const float radius = static_cast<float>(sphere.radius);
  if (settings_.fraction == FractionMethod::linear && radius != mapped.radius && radius >= kLeastLinearRadius)
    mapped.linear_offset = linear_offset(sphere.radius);
  mapped.radius = radius;
  mapped.coefficient = static_cast<float>(sphere.coefficient);
  mapped.coefficient_share = static_cast<float>(sphere.coefficient_share);
  mapped.largest_coefficient = static_cast<float>(sphere.largest_coefficient);
  for (int a = 0; a < 3; ++a) {
    mapped.position[a] = sphere.position[a];
    mapped.velocity[a] = static_cast<float>(sphere.velocity[a]);
    mapped.angular_velocity[a] = static_cast<float>(sphere.angular_velocity[a]);
  }
  mapped.reach = sphere.radius + reach_beyond_radius(settings_.fraction, sphere.radius);
  int begin[3], end[3];
  bool outside = false;
  for (int a = 0; a < 3; ++a) {
    const auto at = static_cast<std::size_t>(a);
    if (!std::isfinite(sphere.position[a])) {  // a scene that has blown up is told elsewhere
      begin[a] = end[a] = 0;
      outside = true;
      continue;
    }
    const double first = std::ceil(sphere.position[a] - mapped.reach - 0.5) - box_.lo[at];
    const double last = std::floor(sphere.position[a] + mapped.reach - 0.5) - box_.lo[at];
    begin[a] = static_cast<int>(std::clamp(first, 0., static_cast<double>(box_.extent(a))));
    end[a] = static_cast<int>(std::clamp(last + 1, 0., static_cast<double>(box_.extent(a))));
    outside |= begin[a] >= end[a];
  }
  mapped.packs = outside ? 0 : (end[0] - begin[0] + 7) / 8;
  mapped.x_start = std::max(0, std::min(begin[0], box_.extent(0) - 8 * mapped.packs));
  mapped.y_begin = begin[1];
  mapped.y_end = outside ? begin[1] : end[1];
  mapped.z_begin = begin[2];
  mapped.z_end = outside ? begin[2] : end[2];
}

bool SolidMapping::same_list(const std::vector<LatticeSphere>& spheres) const {
  if (spheres.size() != placed_.size() || mapped_.size() != placed_.size())
    return false;  // forgotten: mapped alone
  for (std::size_t n = 0; n < spheres.size(); ++n) {
    const LatticeSphere& then = placed_[n];
    if (spheres[n].id != then.id || spheres[n].radius != then.radius) return false;
    // The same grain's other image, several cells away, is another sphere.
    if (std::abs(spheres[n].position[0] - then.position[0]) > 4 ||
        std::abs(spheres[n].position[1] - then.position[1]) > 4 ||
        std::abs(spheres[n].position[2] - then.position[2]) > 4)
      return false;
  }
  return true;
}

bool SolidMapping::moved(const LatticeSphere& now, const LatticeSphere& then) const {
  for (int a = 0; a < 3; ++a) {
    if (!(std::abs(now.position[a] - then.position[a]) <= settings_.remap_distance)) return true;
    if (!(std::abs(now.velocity[a] - then.velocity[a]) <= settings_.remap_velocity)) return true;
    if (!(std::abs(now.angular_velocity[a] - then.angular_velocity[a]) * now.radius <=
          settings_.remap_velocity))
      return true;
  }
  return std::abs(now.coefficient - then.coefficient) > 1e-3 * then.coefficient ||
         now.largest_coefficient != then.largest_coefficient;
}

void SolidMapping::mark(const MappedSphere& mapped) {
  std::fill(dirty_.begin() + mapped.z_begin, dirty_.begin() + mapped.z_end, char{1});
  stale_ |= mapped.z_begin < mapped.z_end;
}

std::size_t SolidMapping::number_of(const lbm::RowBlock& block) const {
  return static_cast<std::size_t>(block.z * blocks_per_plane_ + block.begin_y / rows_per_block_);
}

/// Spheres by their first row, so that neighbours in a block's list share what is in the nearest cache.
void SolidMapping::order_by_row() {
  std::vector<int> next(static_cast<std::size_t>(box_.extent(1)) + 2, 0);
  for (const MappedSphere& m : mapped_) ++next[static_cast<std::size_t>(m.y_begin) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  order_.resize(mapped_.size());
  for (std::size_t n = 0; n < mapped_.size(); ++n)
    order_[static_cast<std::size_t>(next[static_cast<std::size_t>(mapped_[n].y_begin)]++)] =
        static_cast<int>(n);
}

/// Sorts the spheres' slices by the block that they lie in.
void SolidMapping::list_slices() {
  order_by_row();
  const auto blocks = static_cast<std::size_t>(blocks_per_plane_ * box_.extent(2));
  first_slice_.assign(blocks + 1, 0);
  const auto for_blocks = [&](const MappedSphere& m, const auto& visit) {
    if (m.packs == 0) return;
    const int low = m.y_begin / rows_per_block_, high = (m.y_end - 1) / rows_per_block_;
    for (int z = m.z_begin; z < m.z_end; ++z)
      for (int b = low; b <= high; ++b) visit(static_cast<std::size_t>(z * blocks_per_plane_ + b));
  };
  std::size_t widest = 0;
  for (const MappedSphere& m : mapped_) {
    for_blocks(m, [&](std::size_t block) { ++first_slice_[block + 1]; });
    widest =
        std::max(widest, static_cast<std::size_t>(m.packs * std::min(m.y_end - m.y_begin, rows_per_block_)));
  }
  int most = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    most = std::max(most, first_slice_[b + 1]);
    first_slice_[b + 1] += first_slice_[b];
  }
  slices_.resize(static_cast<std::size_t>(first_slice_[blocks]));
  entries_.resize(std::max(entries_.size(), 8 * widest * static_cast<std::size_t>(most)));
  rows_.resize(std::max(rows_.size(), static_cast<std::size_t>(most)));
  noted_block_ = -1;
  std::vector<int> next(first_slice_.begin(), first_slice_.end() - 1);
  for (const int n : order_)
    for_blocks(mapped_[static_cast<std::size_t>(n)],
               [&](std::size_t block) { slices_[static_cast<std::size_t>(next[block]++)] = n; });
}

SliceList SolidMapping::slices_in(const lbm::RowBlock& block) const {
  const std::size_t number = number_of(block);
  const int first = first_slice_[number];
  return {block.z,        block.begin_y,          block.end_y,
          mapped_.data(), slices_.data() + first, first_slice_[number + 1] - first};
}

SliceNotes SolidMapping::notes() {
  return {rows_.data(), entries_.data()};
}

void SolidMapping::clear_rows(const lbm::RowBlock& block) const {
  const auto clear = [&](float* values) {
    std::memset(values + arrays_.plane_pitch * block.z + arrays_.row_pitch * block.begin_y, 0,
                sizeof(float) * static_cast<std::size_t>(arrays_.row_pitch * (block.end_y - block.begin_y)));
  };
  clear(arrays_.fraction);
  if (arrays_.strength != arrays_.fraction) clear(arrays_.strength);
  for (float* momentum : arrays_.momentum) clear(momentum);
}

template <class Visit>
void SolidMapping::for_each_block(const Visit& visit) const {
  for (int z = 0; z < box_.extent(2); ++z)
    for (int y = 0; y < box_.extent(1); y += rows_per_block_)
      visit(lbm::RowBlock{z, y, std::min(y + rows_per_block_, box_.extent(1))});
}

std::size_t SolidMapping::place(const std::vector<LatticeSphere>& spheres) {
  std::size_t count = 0;
  if (!same_list(spheres)) {
    placed_ = spheres;
    for (const MappedSphere& m : mapped_) mark(m);
    mapped_.assign(spheres.size(), {});
    for (std::size_t n = 0; n < spheres.size(); ++n) {
      set_place(spheres[n], mapped_[n]);
      mark(mapped_[n]);
    }
    list_slices();
    return spheres.size();
  }
  for (std::size_t n = 0; n < spheres.size(); ++n) {
    MappedSphere& m = mapped_[n];
    if (!moved(spheres[n], placed_[n])) continue;
    placed_[n] = spheres[n];
    mark(m);
    set_place(spheres[n], m);
    mark(m);
    ++count;
  }
  if (count > 0) list_slices();
  return count;
}

void SolidMapping::set_pore_coefficients(const float* coefficients) {
  pore_coefficients_ = coefficients;
  for (const MappedSphere& m : mapped_) mark(m);
  noted_block_ = -1;
}

void SolidMapping::write_rows(const lbm::RowBlock& block) {
  if (dirty_[static_cast<std::size_t>(block.z)] == 0) return;
  clear_rows(block);
  if (!first_slice_.empty()) {
    const FractionRule rule{settings_.fraction, settings_.subcells, settings_.cells.own_coefficients};
    const auto map_slices = SUFFUSE_CHOOSE(instruction_set_, decltype(&portable::map_slices), map_slices);
    map_slices(slices_in(block), rule, plain(arrays_, box_, {}, pore_coefficients_), notes());
    noted_block_ = static_cast<std::ptrdiff_t>(number_of(block));
  }
  cover_closed(block);
}

void SolidMapping::set_closed(const std::vector<std::uint8_t>& closed) {
  if (closed.empty() && closed_.empty()) return;
  closed_ = closed;
  std::fill(dirty_.begin(), dirty_.end(), char{1});
  stale_ = true;
}

void SolidMapping::cover_closed(const lbm::RowBlock& block) const {
  if (closed_.empty()) return;
  const float strength = settings_.cells.own_coefficients ? static_cast<float>(kSafeCoefficient) : 1;
  for (int y = block.begin_y; y < block.end_y; ++y)
    for (int x = 0; x < box_.extent(0); ++x) {
      if (closed_[static_cast<std::size_t>(x + box_.extent(0) *
                                                   (y + std::ptrdiff_t{box_.extent(1)} * block.z))] == 0)
        continue;
      const std::ptrdiff_t cell = x + arrays_.row_pitch * y + arrays_.plane_pitch * block.z;
      arrays_.strength[cell] = strength;
      arrays_.fraction[cell] = 1;  // perhaps the same array
      for (float* momentum : arrays_.momentum) momentum[cell] = 0;
    }
}

void SolidMapping::finish_writing() {
  std::fill(dirty_.begin(), dirty_.end(), char{0});
  stale_ = false;
}

void SolidMapping::write() {
  if (!stale_) return;
  for_each_block([&](const lbm::RowBlock& block) { write_rows(block); });
  finish_writing();
}

std::size_t SolidMapping::update(const std::vector<LatticeSphere>& spheres) {
  const std::size_t count = place(spheres);
  write();
  return count;
}

void SolidMapping::sum_rows(const lbm::RowBlock& block, const lbm::ExchangeArrays& exchange) {
  if (first_slice_.empty()) return;
  const SliceList list = slices_in(block);
  if (list.count == 0) return;
  const CellArrays arrays = plain(arrays_, box_, exchange, pore_coefficients_);
  const auto strengths_of = SUFFUSE_CHOOSE(instruction_set_, decltype(&portable::strengths_of), strengths_of);
  const auto sum_loads = SUFFUSE_CHOOSE(instruction_set_, decltype(&portable::sum_loads), sum_loads);
  const auto number = static_cast<std::ptrdiff_t>(number_of(block));
  if (noted_block_ != number) {
    const FractionRule rule{settings_.fraction, settings_.subcells, settings_.cells.own_coefficients};
    strengths_of(list, rule, arrays, notes());
    noted_block_ = number;
  }
  const HeldRule held{static_cast<float>(held_.base), static_cast<float>(held_.slope),
                      static_cast<float>(held_.least)};
  sum_loads(list, arrays, held, notes(), loads_.data());
}

void SolidMapping::begin_loads(double relaxation_time) {
  loads_.assign(mapped_.size(), {});
  held_ = lbm::held_terms(settings_.cells, relaxation_time);
}

void SolidMapping::sum(double relaxation_time) {
  begin_loads(relaxation_time);
  for_each_block([&](const lbm::RowBlock& block) { sum_rows(block, arrays_.exchange); });
}

Vec3 SolidMapping::solid_flux(const lbm::Index3& cell) const {
  const std::ptrdiff_t at = cell[0] - box_.lo[0] + arrays_.row_pitch * (cell[1] - box_.lo[1]) +
                            arrays_.plane_pitch * (cell[2] - box_.lo[2]);
  if (!(arrays_.strength[at] > 0)) return Vec3::Zero();
  const double share = std::min(1.f, arrays_.fraction[at]) / static_cast<double>(arrays_.strength[at]);
  return share * Vec3(arrays_.momentum[0][at], arrays_.momentum[1][at], arrays_.momentum[2][at]);
}

double SolidMapping::overlap() const {
  double sum = 0;
  lbm::for_each_cell({{0, 0, 0}, box_.extents()}, [&](int x, int y, int z) {
    const float fraction = arrays_.fraction[x + arrays_.row_pitch * y + arrays_.plane_pitch * z];
    sum += std::max(0., static_cast<double>(fraction) - 1);
  });
  return sum;
}

std::size_t SolidMapping::bytes() const {
  return mapped_.capacity() * sizeof(MappedSphere) + placed_.capacity() * sizeof(LatticeSphere) +
         loads_.capacity() * sizeof(LatticeLoad) + entries_.capacity() * sizeof(float) +
         rows_.capacity() * sizeof(SliceRows) + closed_.capacity() +
         (slices_.capacity() + first_slice_.capacity() + order_.capacity()) * sizeof(int);
}

}  // namespace suffuse::coupling
