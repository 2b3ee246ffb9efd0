#include "suffuse/coupling/solid_mapping.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "mapping_kernels.h"

namespace suffuse::coupling {

namespace {

/// Beyond radius + this a cell's centre is too far for the sphere to cover any of the cell.
double reach_beyond_radius(FractionMethod method, double radius) {
  return method == FractionMethod::linear && radius >= 1 ? 0.5 : 0.8660255;
}

CellArrays plain(const lbm::PartialSolidArrays& arrays, const lbm::CellBox& box) {
  CellArrays plain{};
  plain.cells_x = box.extent(0);
  plain.row_pitch = arrays.row_pitch;
  plain.plane_pitch = arrays.plane_pitch;
  plain.fraction = arrays.fraction;
  plain.strength = arrays.strength;
  for (std::size_t a = 0; a < 3; ++a) {
    plain.lo[a] = box.lo[a];
    plain.momentum[a] = arrays.momentum[a];
    if (const auto* in_double = std::get_if<0>(&arrays.exchange)) plain.exchange_double[a] = (*in_double)[a];
    if (const auto* in_float = std::get_if<1>(&arrays.exchange)) plain.exchange_float[a] = (*in_float)[a];
  }
  return plain;
}

}  // namespace

SolidMapping::SolidMapping(const SolidSettings& settings, lbm::InstructionSet instruction_set,
                           const lbm::PartialSolidArrays& arrays, const lbm::CellBox& local_box)
    : settings_(settings), instruction_set_(instruction_set), arrays_(arrays), box_(local_box) {}

void SolidMapping::place(const LatticeSphere& sphere, MappedSphere& mapped) const {
  const double reach = sphere.radius + reach_beyond_radius(settings_.fraction, sphere.radius);
  int begin[3], end[3];
  bool outside = false;
  for (int a = 0; a < 3; ++a) {
    const auto at = static_cast<std::size_t>(a);
    if (!std::isfinite(sphere.position[a])) {  // a scene that has blown up is told elsewhere
      begin[a] = end[a] = 0;
      outside = true;
      continue;
    }
    const double first = std::ceil(sphere.position[a] - reach - 0.5) - box_.lo[at];
    const double last = std::floor(sphere.position[a] + reach - 0.5) - box_.lo[at];
    begin[a] = static_cast<int>(std::clamp(first, 0., static_cast<double>(box_.extent(a))));
    end[a] = static_cast<int>(std::clamp(last + 1, 0., static_cast<double>(box_.extent(a))));
    outside |= begin[a] >= end[a];
  }
  mapped.sphere = sphere;
  mapped.packs = outside ? 0 : (end[0] - begin[0] + 7) / 8;
  mapped.x_start = std::max(0, std::min(begin[0], box_.extent(0) - 8 * mapped.packs));
  mapped.y_begin = begin[1];
  mapped.y_end = outside ? begin[1] : end[1];
  mapped.z_begin = begin[2];
  mapped.z_end = outside ? begin[2] : end[2];
}

bool SolidMapping::same_list(const std::vector<LatticeSphere>& spheres) const {
  if (spheres.size() != mapped_.size()) return false;
  for (std::size_t n = 0; n < spheres.size(); ++n) {
    const LatticeSphere& then = mapped_[n].sphere;
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
  return std::abs(now.coefficient - then.coefficient) > 1e-3 * then.coefficient;
}

void SolidMapping::mark(const MappedSphere& mapped, std::vector<char>& planes) const {
  std::fill(planes.begin() + mapped.z_begin, planes.begin() + mapped.z_end, char{1});
}

/// Entries for the largest box that a sphere of this radius can have, so that its place stays while it moves.
void SolidMapping::give_entries() {
  std::size_t total = 0;
  for (MappedSphere& m : mapped_) {
    m.first_entry = total;
    const auto span = static_cast<std::size_t>(
        std::floor(2 * (m.sphere.radius + reach_beyond_radius(settings_.fraction, m.sphere.radius))) + 1);
    const auto extent = [&](int axis) { return std::min(span, static_cast<std::size_t>(box_.extent(axis))); };
    // A sphere that does not reach this rank now may do so without the list changing.
    total += 8 * ((extent(0) + 7) / 8) * extent(1) * extent(2);
  }
  entries_.resize(total);
}

void SolidMapping::sort_along_z() {
  std::vector<std::size_t> count(static_cast<std::size_t>(box_.extent(2)) + 2, 0);
  for (const MappedSphere& m : mapped_) ++count[static_cast<std::size_t>(m.z_begin) + 1];
  std::partial_sum(count.begin(), count.end(), count.begin());
  order_.resize(mapped_.size());
  for (std::size_t n = 0; n < mapped_.size(); ++n)
    order_[count[static_cast<std::size_t>(mapped_[n].z_begin)]++] = n;
}

void SolidMapping::clear_plane(int z) const {
  const auto clear = [&](float* values) {
    std::memset(values + arrays_.plane_pitch * z, 0,
                sizeof(float) * static_cast<std::size_t>(arrays_.row_pitch * box_.extent(1)));
  };
  clear(arrays_.fraction);
  if (arrays_.strength != arrays_.fraction) clear(arrays_.strength);
  for (float* momentum : arrays_.momentum) clear(momentum);
}

/// Each plane is cleared just before the first sphere that reaches it is written, while it is on its way into
/// the cache.
void SolidMapping::write_planes(const std::vector<char>& dirty) {
  const FractionRule rule{settings_.fraction, settings_.subcells, settings_.cells.own_coefficients};
  const CellArrays arrays = plain(arrays_, box_);
  int cleared = 0;
  const auto clear_up_to = [&](int end) {
    for (; cleared < end; ++cleared)
      if (dirty[static_cast<std::size_t>(cleared)] != 0) clear_plane(cleared);
  };
  for (const std::size_t n : order_) {
    const MappedSphere& m = mapped_[n];
    if (m.packs == 0) continue;
    clear_up_to(m.z_end);
    if (std::find(dirty.begin() + m.z_begin, dirty.begin() + m.z_end, char{1}) == dirty.begin() + m.z_end)
      continue;
    float* entries = entries_.data() + m.first_entry;
    switch (instruction_set_) {
#ifdef SUFFUSE_HAVE_X86_KERNELS
      case lbm::InstructionSet::avx512:
        avx512::map_sphere(m, rule, dirty.data(), arrays, entries);
        break;
      case lbm::InstructionSet::avx2:
        avx2::map_sphere(m, rule, dirty.data(), arrays, entries);
        break;
#endif
      default:
        portable::map_sphere(m, rule, dirty.data(), arrays, entries);
    }
  }
  clear_up_to(box_.extent(2));
}

std::size_t SolidMapping::update(const std::vector<LatticeSphere>& spheres) {
  std::vector<char> dirty(static_cast<std::size_t>(box_.extent(2)) + 1, 0);
  std::size_t count = 0;
  if (!same_list(spheres)) {
    for (const MappedSphere& m : mapped_) mark(m, dirty);
    mapped_.assign(spheres.size(), {});
    for (std::size_t n = 0; n < spheres.size(); ++n) {
      place(spheres[n], mapped_[n]);
      mark(mapped_[n], dirty);
    }
    give_entries();
    sort_along_z();
    count = spheres.size();
  } else {
    for (std::size_t n = 0; n < spheres.size(); ++n) {
      MappedSphere& m = mapped_[n];
      if (!moved(spheres[n], m.sphere)) continue;
      mark(m, dirty);
      place(spheres[n], m);
      mark(m, dirty);
      ++count;
    }
    if (count > 0) sort_along_z();
  }
  if (std::find(dirty.begin(), dirty.end(), char{1}) != dirty.end()) write_planes(dirty);
  return count;
}

LatticeLoad SolidMapping::load_of(std::size_t n, double relaxation_time) const {
  LatticeLoad load;
  const MappedSphere& m = mapped_[n];
  if (m.packs == 0) return load;
  const float* entries = entries_.data() + m.first_entry;
  const CellArrays arrays = plain(arrays_, box_);
  const lbm::HeldTerms terms = lbm::held_terms(settings_.cells, m.sphere.coefficient, relaxation_time);
  const HeldRule held{terms.whole, terms.slope};
  switch (instruction_set_) {
#ifdef SUFFUSE_HAVE_X86_KERNELS
    case lbm::InstructionSet::avx512:
      avx512::sum_load(m, held, arrays, entries, load);
      break;
    case lbm::InstructionSet::avx2:
      avx2::sum_load(m, held, arrays, entries, load);
      break;
#endif
    default:
      portable::sum_load(m, held, arrays, entries, load);
  }
  return load;
}

double SolidMapping::volume_of(std::size_t n) const {
  const MappedSphere& m = mapped_[n];
  const float* entries = entries_.data() + m.first_entry;
  double sum = 0;
  const int count = 8 * m.packs * (m.y_end - m.y_begin) * (m.z_end - m.z_begin);
  for (int i = 0; i < count; ++i) sum += static_cast<double>(entries[i]);
  return settings_.cells.own_coefficients ? sum / m.sphere.coefficient : sum;
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
  return mapped_.capacity() * sizeof(MappedSphere) + entries_.capacity() * sizeof(float) +
         order_.capacity() * sizeof(std::size_t);
}

}  // namespace suffuse::coupling
