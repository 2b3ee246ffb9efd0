// Compiled once for each instruction set (see CMakeLists.txt), so that the program carries them all and
// chooses at start. For the reason given in lbm_solver's pack.h no function of a standard library template is
// called here that the linker could share with other files.
#include "mapping_kernels.h"

#include "sphere_fraction.h"

namespace suffuse::coupling::SUFFUSE_KERNEL_NAMESPACE {

namespace {

/// Adding and subtracting this rounds to multiples of 2^-22 (values up to 1) or 2^-16 (up to 64).
constexpr float kFractionRounding = 3.f, kStrengthRounding = 192.f;

/// The rows of a block that a sphere reaches.
struct Slice {
  int begin, end;
  double dz;  ///< of the plane from the sphere's centre
};

[[gnu::always_inline]] inline Slice slice_of(const MappedSphere& m, const SliceList& list,
                                             const CellArrays& arrays) {
  Slice slice{0, 0, list.z + arrays.lo[2] + 0.5 - m.position[2]};
  const double left = m.reach * m.reach - slice.dz * slice.dz;
  if (!(left > 0)) return slice;
  const double half = __builtin_sqrt(left), middle = m.position[1] - 0.5 - arrays.lo[1];
  const double first = __builtin_ceil(middle - half), last = __builtin_floor(middle + half);
  slice.begin = first > list.begin_y ? static_cast<int>(first) : list.begin_y;
  slice.end = last + 1 < list.end_y ? static_cast<int>(last) + 1 : list.end_y;
  return slice;
}

/// The lists' spheres lie apart in memory: what slice i + 4 needs is fetched while slice i is worked on.
template <class Record>
[[gnu::always_inline]] inline void fetch_record(const Record* records, const SliceList& list, int i) {
  constexpr int ahead = 4, line = 64;
  if (i + ahead >= list.count) return;
  const char* record = reinterpret_cast<const char*>(records + list.numbers[i + ahead]);
  for (unsigned at = 0; at < sizeof(Record); at += line) __builtin_prefetch(record + at, 1);
  __builtin_prefetch(record + sizeof(Record) - 1, 1);
}

enum class Target { cells, entries_only };

/// Returns the end of the slice's entries.
template <FractionMethod kMethod, bool kOwn, Target kTarget>
[[gnu::always_inline]] inline float* map_slice(const MappedSphere& m, const SliceList& list,
                                               const FractionRule& rule, const CellArrays& arrays,
                                               float* entries) {
  const Slice slice = slice_of(m, list, arrays);
  const Sphere sphere{m.radius, m.linear_offset, rule.subcells};
  const float first_x = static_cast<float>(m.x_start + arrays.lo[0] + 0.5 - m.position[0]);
  const float dz = static_cast<float>(slice.dz), coefficient = m.coefficient;
  const float wx = m.angular_velocity[0], wy = m.angular_velocity[1], wz = m.angular_velocity[2];
  const float ux = m.velocity[0] + wy * dz, uy = m.velocity[1] - wx * dz, uz = m.velocity[2];
  const double lo_y = arrays.lo[1] + 0.5 - m.position[1];
  for (int pack = 0; pack < m.packs; ++pack) {
    const int x = m.x_start + kLanes * pack;
    const Floats dx = first_x + static_cast<float>(kLanes * pack) + kLaneNumbers;
    const Floats turning_y = uy + wz * dx, turning_z = uz - wy * dx;
    const auto in_row = kLaneNumbers < static_cast<float>(arrays.cells_x - x);
    const std::ptrdiff_t first = x + arrays.plane_pitch * list.z;
    for (int y = slice.begin; y < slice.end; ++y, entries += kLanes) {
      const float dy = static_cast<float>(y + lo_y);
      Floats fraction = covered<kMethod>(sphere, dx, dy, dz);
      fraction = (fraction + kFractionRounding) - kFractionRounding;
      fraction = in_row ? fraction : Floats{};
      const std::ptrdiff_t cell = first + arrays.row_pitch * y;
      Floats strength = fraction;
      if constexpr (kOwn) {
        const Floats pore = arrays.pore_coefficient ? load(arrays.pore_coefficient + cell) : Floats{};
        const Floats k = lesser(coefficient + pore, Floats{} + kLargestCellCoefficient);
        strength = (k * fraction + kStrengthRounding) - kStrengthRounding;
      }
      store(entries, strength);
      if constexpr (kTarget == Target::entries_only) continue;
      store(arrays.fraction + cell, load(arrays.fraction + cell) + fraction);
      if constexpr (kOwn) store(arrays.strength + cell, load(arrays.strength + cell) + strength);
      float* const* momentum = arrays.momentum;
      store(momentum[0] + cell, load(momentum[0] + cell) + strength * (ux - wz * dy));
      store(momentum[1] + cell, load(momentum[1] + cell) + strength * turning_y);
      store(momentum[2] + cell, load(momentum[2] + cell) + strength * (turning_z + wx * dy));
    }
  }
  return entries;
}

template <FractionMethod kMethod, bool kOwn, Target kTarget>
void map_all(const SliceList& list, const FractionRule& rule, const CellArrays& given, float* entries) {
  const CellArrays arrays = given;  // a copy of our own: stores cannot change it
  for (int i = 0; i < list.count; ++i) {
    fetch_record(list.spheres, list, i);
    const MappedSphere& m = list.spheres[list.numbers[i]];
    if (kMethod == FractionMethod::linear && m.radius < kLeastLinearRadius)
      entries = map_slice<FractionMethod::exact, kOwn, kTarget>(m, list, rule, arrays, entries);
    else
      entries = map_slice<kMethod, kOwn, kTarget>(m, list, rule, arrays, entries);
  }
}

template <Target kTarget>
void map_by(const SliceList& list, const FractionRule& rule, const CellArrays& arrays, float* entries) {
  const bool own = rule.own_coefficients;
  switch (rule.method) {
    case FractionMethod::exact:
      return own ? map_all<FractionMethod::exact, true, kTarget>(list, rule, arrays, entries)
                 : map_all<FractionMethod::exact, false, kTarget>(list, rule, arrays, entries);
    case FractionMethod::linear:
      return own ? map_all<FractionMethod::linear, true, kTarget>(list, rule, arrays, entries)
                 : map_all<FractionMethod::linear, false, kTarget>(list, rule, arrays, entries);
    case FractionMethod::subcells:
      return own ? map_all<FractionMethod::subcells, true, kTarget>(list, rule, arrays, entries)
                 : map_all<FractionMethod::subcells, false, kTarget>(list, rule, arrays, entries);
  }
}

/// The share of each cell's exchange that belongs to the sphere: exactly 1 where it is alone.
[[gnu::always_inline]] inline Doubles shares(const Floats& own, const Floats& all) {
  const Floats divisor = all > 0.f ? all : Floats{} + 1.f;
  return widened(own) / widened(divisor);
}

/// See lbm::HeldTerms. A cell that a grain barely touches may have a strength of nothing, and no exchange
/// then.
[[gnu::always_inline]] inline Floats held_factor(const HeldRule& held, const Floats& fraction,
                                                 const Floats& strength) {
  const Floats covered = lesser(fraction, Floats{} + 1.f);
  const Floats away = held.slope * (1.f - covered) + held.least;
  return covered * (held.base + away / greater(strength, Floats{} + 1e-12f));
}

template <class T>
[[gnu::always_inline]] inline Doubles load_exchange(const T* from) {
  if constexpr (sizeof(T) == sizeof(float))
    return widened(load(from));
  else
    return *reinterpret_cast<const UnalignedDoubles*>(from);
}

[[gnu::always_inline]] inline double sum_of(const Doubles& v) {
  typedef double Four __attribute__((vector_size(32)));
  typedef double Two __attribute__((vector_size(16)));
  const Four four = __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
  const Two two = __builtin_shufflevector(four, four, 0, 1) + __builtin_shufflevector(four, four, 2, 3);
  return two[0] + two[1];
}

/// Sum of vectors h that act at cells of a slice, and of their moments about the sphere's centre.
struct Moments {
  Doubles hx{}, hy{}, hz{}, y_hx{}, y_hz{}, x_hy{}, x_hz{};

  [[gnu::always_inline]] void add(const Doubles& x, const Doubles& y, const Doubles& z, const Doubles& dx,
                                  double dy) {
    hx += x;
    hy += y;
    hz += z;
    y_hx += dy * x;
    y_hz += dy * z;
    x_hy += dx * y;
    x_hz += dx * z;
  }
  [[gnu::always_inline]] void add_to(double* force, double* torque, double dz) const {
    const double sum[3] = {sum_of(hx), sum_of(hy), sum_of(hz)};
    for (int a = 0; a < 3; ++a) force[a] += sum[a];
    torque[0] += sum_of(y_hz) - dz * sum[1];
    torque[1] += dz * sum[0] - sum_of(x_hz);
    torque[2] += sum_of(x_hy - y_hx);
  }
};

/// Returns the end of the slice's entries.
template <class T>
[[gnu::always_inline]] inline const float* sum_slice(const MappedSphere& m, const SliceList& list,
                                                     const CellArrays& arrays, const HeldRule& held,
                                                     const T* const* exchange, const float* entries,
                                                     LatticeLoad& load_sum) {
  const Slice slice = slice_of(m, list, arrays);
  const double first_x = m.x_start + arrays.lo[0] + 0.5 - m.position[0];
  const double lo_y = arrays.lo[1] + 0.5 - m.position[1];
  Moments all, lead;
  for (int pack = 0; pack < m.packs; ++pack) {
    const Doubles dx = (first_x + kLanes * pack) + widened(kLaneNumbers);
    const std::ptrdiff_t first = m.x_start + kLanes * pack + arrays.plane_pitch * list.z;
    for (int y = slice.begin; y < slice.end; ++y, entries += kLanes) {
      const std::ptrdiff_t cell = first + arrays.row_pitch * y;
      const double dy = y + lo_y;
      const Floats strength = load(arrays.strength + cell);
      const Doubles share = shares(load(entries), strength);
      const Doubles hx = share * load_exchange(exchange[0] + cell),
                    hy = share * load_exchange(exchange[1] + cell),
                    hz = share * load_exchange(exchange[2] + cell);
      all.add(hx, hy, hz, dx, dy);
      const Doubles factor = widened(held_factor(held, load(arrays.fraction + cell), strength));
      lead.add(factor * hx, factor * hy, factor * hz, dx, dy);
    }
  }
  all.add_to(load_sum.force, load_sum.torque, slice.dz);
  lead.add_to(load_sum.lead, load_sum.spin_lead, slice.dz);
  return entries;
}

template <class T>
void sum_all(const SliceList& list, const CellArrays& given, const HeldRule& rule, const T* const* exchange,
             const float* entries, LatticeLoad* loads) {
  const CellArrays arrays = given;
  const HeldRule held = rule;
  const T* const from[3] = {exchange[0], exchange[1], exchange[2]};
  for (int i = 0; i < list.count; ++i) {
    fetch_record(list.spheres, list, i);
    fetch_record(loads, list, i);
    const int n = list.numbers[i];
    entries = sum_slice<T>(list.spheres[n], list, arrays, held, from, entries, loads[n]);
  }
}

}  // namespace

void map_slices(const SliceList& list, const FractionRule& rule, const CellArrays& arrays, float* entries) {
  map_by<Target::cells>(list, rule, arrays, entries);
}

void strengths_of(const SliceList& list, const FractionRule& rule, const CellArrays& arrays, float* entries) {
  map_by<Target::entries_only>(list, rule, arrays, entries);
}

void sum_loads(const SliceList& list, const CellArrays& arrays, const HeldRule& held, const float* entries,
               LatticeLoad* loads) {
  if (arrays.exchange_double[0] != nullptr)
    sum_all<double>(list, arrays, held, arrays.exchange_double, entries, loads);
  else
    sum_all<float>(list, arrays, held, arrays.exchange_float, entries, loads);
}

}  // namespace suffuse::coupling::SUFFUSE_KERNEL_NAMESPACE
