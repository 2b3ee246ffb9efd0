// Compiled once for each instruction set (see CMakeLists.txt), so that the program carries them all and
// chooses at start. For the reason given in suffuse/simd/pack.h no function of a standard library template is
// called here that the linker could share with other files.
#include "mapping_kernels.h"

#include "sphere_fraction.h"
#include "suffuse/simd/four_doubles.h"

namespace suffuse::coupling::SUFFUSE_KERNEL_NAMESPACE {

namespace {

/// Adding and subtracting this rounds to multiples of 2^-22 (values up to 1) or 2^-14 (up to 256).
constexpr float kFractionRounding = 3.f, kStrengthRounding = 768.f;

[[gnu::always_inline]] inline double plane_from_centre(const MappedSphere& m, const SliceList& list,
                                                       const CellArrays& arrays) {
  return list.z + arrays.lo[2] + 0.5 - m.position[2];
}

/// Never beyond the rows that the sphere was placed in, for whose number the notes have room: an end that
/// falls on a cell's centre may round otherwise here.
[[gnu::always_inline]] inline SliceRows rows_of(const MappedSphere& m, const SliceList& list,
                                                const CellArrays& arrays) {
  const double dz = plane_from_centre(m, list, arrays), left = m.reach * m.reach - dz * dz;
  if (!(left > 0)) return {0, 0};
  const double half = __builtin_sqrt(left), middle = m.position[1] - 0.5 - arrays.lo[1];
  const double first = __builtin_ceil(middle - half), last = __builtin_floor(middle + half);
  const int begin = list.begin_y > m.y_begin ? list.begin_y : m.y_begin;
  const int end = list.end_y < m.y_end ? list.end_y : m.y_end;
  return {first > begin ? static_cast<int>(first) : begin, last + 1 < end ? static_cast<int>(last) + 1 : end};
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
                                               const SliceRows& rows, const FractionRule& rule,
                                               const CellArrays& arrays, float* entries) {
  const Sphere sphere{m.radius, m.linear_offset, rule.subcells};
  const float first_x = static_cast<float>(m.x_start + arrays.lo[0] + 0.5 - m.position[0]);
  const float dz = static_cast<float>(plane_from_centre(m, list, arrays)), coefficient = m.coefficient;
  const float wx = m.angular_velocity[0], wy = m.angular_velocity[1], wz = m.angular_velocity[2];
  const float ux = m.velocity[0] + wy * dz, uy = m.velocity[1] - wx * dz, uz = m.velocity[2];
  const double lo_y = arrays.lo[1] + 0.5 - m.position[1];
  for (int pack = 0; pack < m.packs; ++pack) {
    const int x = m.x_start + kLanes * pack;
    const Floats dx = first_x + static_cast<float>(kLanes * pack) + kLaneNumbers;
    const Floats turning_y = uy + wz * dx, turning_z = uz - wy * dx;
    const auto in_row = kLaneNumbers < static_cast<float>(arrays.cells_x - x);
    const std::ptrdiff_t first = x + arrays.plane_pitch * list.z;
    const auto write = [&](int y, float dy, const Floats& covered_part) {
      const Floats rounded = (covered_part + kFractionRounding) - kFractionRounding;
      const Floats fraction = in_row ? rounded : Floats{};
      const std::ptrdiff_t cell = first + arrays.row_pitch * y;
      Floats strength = fraction;
      if constexpr (kOwn) {
        const Floats pore = arrays.pore_coefficient ? load(arrays.pore_coefficient + cell) : Floats{};
        const Floats k = lesser(m.coefficient_share * (coefficient + pore), Floats{} + m.largest_coefficient);
        strength = (k * fraction + kStrengthRounding) - kStrengthRounding;
      }
      store(entries, strength);
      entries += kLanes;
      if constexpr (kTarget == Target::entries_only) return;
      store(arrays.fraction + cell, load(arrays.fraction + cell) + fraction);
      if constexpr (kOwn) store(arrays.strength + cell, load(arrays.strength + cell) + strength);
      float* const* momentum = arrays.momentum;
      store(momentum[0] + cell, load(momentum[0] + cell) + strength * (ux - wz * dy));
      store(momentum[1] + cell, load(momentum[1] + cell) + strength * turning_y);
      store(momentum[2] + cell, load(momentum[2] + cell) + strength * (turning_z + wx * dy));
    };
    int y = rows.begin;
    if constexpr (kMethod == FractionMethod::exact) {  // a long chain of operations: two rows at a time
      for (; y < rows.end; y += 2) {
        const float dy[2] = {static_cast<float>(y + lo_y), static_cast<float>(y + 1 + lo_y)};
        const TwoRows parts =
            covered<kMethod>(sphere, two_rows(dx, dx), two_rows(Floats{} + dy[0], Floats{} + dy[1]), dz);
        write(y, dy[0], row_of(parts, 0));
        if (y + 1 < rows.end) write(y + 1, dy[1], row_of(parts, 1));
      }
      continue;
    }
    for (; y < rows.end; ++y) {
      const float dy = static_cast<float>(y + lo_y);
      write(y, dy, covered<kMethod>(sphere, dx, Floats{} + dy, dz));
    }
  }
  return entries;
}

/// All at once and before they are needed: a loop over rows whose number follows from a square root is known
/// too late to the processor.
void note_rows(const SliceList& list, const CellArrays& arrays, SliceRows* rows) {
  for (int i = 0; i < list.count; ++i) {
    fetch_record(list.spheres, list, i);
    rows[i] = rows_of(list.spheres[list.numbers[i]], list, arrays);
  }
}

template <FractionMethod kMethod, bool kOwn, Target kTarget>
void map_all(const SliceList& list, const FractionRule& rule, const CellArrays& given,
             const SliceNotes& notes) {
  const CellArrays arrays = given;  // a copy of our own: stores cannot change it
  const SliceRows* rows = notes.rows;
  float* entries = notes.entries;
  note_rows(list, arrays, notes.rows);
  for (int i = 0; i < list.count; ++i) {
    fetch_record(list.spheres, list, i);
    const MappedSphere& m = list.spheres[list.numbers[i]];
    if (kMethod == FractionMethod::linear && m.radius < kLeastLinearRadius)
      entries = map_slice<FractionMethod::exact, kOwn, kTarget>(m, list, rows[i], rule, arrays, entries);
    else
      entries = map_slice<kMethod, kOwn, kTarget>(m, list, rows[i], rule, arrays, entries);
  }
}

template <Target kTarget>
void map_by(const SliceList& list, const FractionRule& rule, const CellArrays& arrays,
            const SliceNotes& notes) {
  const bool own = rule.own_coefficients;
  switch (rule.method) {
    case FractionMethod::exact:
      return own ? map_all<FractionMethod::exact, true, kTarget>(list, rule, arrays, notes)
                 : map_all<FractionMethod::exact, false, kTarget>(list, rule, arrays, notes);
    case FractionMethod::linear:
      return own ? map_all<FractionMethod::linear, true, kTarget>(list, rule, arrays, notes)
                 : map_all<FractionMethod::linear, false, kTarget>(list, rule, arrays, notes);
    case FractionMethod::subcells:
      return own ? map_all<FractionMethod::subcells, true, kTarget>(list, rule, arrays, notes)
                 : map_all<FractionMethod::subcells, false, kTarget>(list, rule, arrays, notes);
  }
}

/// See lbm::HeldTerms. A cell that a grain barely touches may have a strength of nothing, and no exchange
/// then.
[[gnu::always_inline]] inline Floats held_factor(const HeldRule& held, const Floats& fraction,
                                                 const Floats& strength) {
  const Floats covered = lesser(fraction, Floats{} + 1.f);
  const Floats away = held.slope * (1.f - covered) + held.least;
  return covered * (held.base + away / greater(strength, Floats{} + 1e-12f));
}

/// A row's exchange and its sums over a slice's few rows keep the fluid's storage type.
template <class T>
struct Row;
template <>
struct Row<double> {
  typedef Doubles Values;
  [[gnu::always_inline]] static Values load_from(const double* from) {
    return *reinterpret_cast<const UnalignedDoubles*>(from);
  }
  [[gnu::always_inline]] static Values of(const Floats& v) { return widened(v); }
  [[gnu::always_inline]] static Doubles sum(const Values& v) { return v; }
};
template <>
struct Row<float> {
  typedef Floats Values;
  [[gnu::always_inline]] static Values load_from(const float* from) { return load(from); }
  [[gnu::always_inline]] static Values of(const Floats& v) { return v; }
  [[gnu::always_inline]] static Doubles sum(const Values& v) { return widened(v); }
};

using simd::SUFFUSE_KERNEL_NAMESPACE::Four;
using simd::SUFFUSE_KERNEL_NAMESPACE::store_unaligned;
using simd::SUFFUSE_KERNEL_NAMESPACE::unaligned;

/// The sums of four vectors' lanes.
[[gnu::always_inline]] inline Four sums_of(const Doubles& a, const Doubles& b, const Doubles& c,
                                           const Doubles& d) {
  const Doubles ab = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14) +
                     __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  const Doubles cd = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14) +
                     __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
  const Doubles all = __builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13) +
                      __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15);
  return __builtin_shufflevector(all, all, 0, 1, 2, 3) + __builtin_shufflevector(all, all, 4, 5, 6, 7);
}

/// Sum of vectors that act at cells of a slice, and of their moments about the sphere's centre.
struct Moments {
  Doubles force[3]{}, torque[3]{};
};

/// The same for one pack of columns, row by row. The rows' moments come from sums of sums: with h_j in row j
/// of n at dy_j, the sum of dy_j h_j is dy_n (h_0 + ... + h_{n-1}) less the sum over all rows of what had
/// been added up by then. So each row costs additions only, and the columns' moments wait until the end.
template <class T>
struct ColumnSums {
  using Values = typename Row<T>::Values;
  Values x{}, y{}, z{}, past_x{}, past_z{};

  [[gnu::always_inline]] void add(const Values& weight, const Values (&h)[3]) {
    x += weight * h[0];
    y += weight * h[1];
    z += weight * h[2];
    past_x += x;
    past_z += z;
  }
  /// dy: of the row after the last.
  [[gnu::always_inline]] void add_to(Moments& moments, const Doubles& dx, double dy, double dz) const {
    const Doubles fx = Row<T>::sum(x), fy = Row<T>::sum(y), fz = Row<T>::sum(z);
    moments.force[0] += fx;
    moments.force[1] += fy;
    moments.force[2] += fz;
    moments.torque[0] += (dy * fz - Row<T>::sum(past_z)) - dz * fy;
    moments.torque[1] += dz * fx - dx * fz;
    moments.torque[2] += dx * fy - (dy * fx - Row<T>::sum(past_x));
  }
};

/// Returns the end of the slice's entries.
template <class T>
[[gnu::always_inline]] inline const float* sum_slice(const MappedSphere& m, const SliceList& list,
                                                     const SliceRows& rows, const CellArrays& arrays,
                                                     const HeldRule& held, const T* const* exchange,
                                                     const float* entries, LatticeLoad& load_sum) {
  if (rows.begin >= rows.end) return entries;
  const double first_x = m.x_start + arrays.lo[0] + 0.5 - m.position[0];
  const double end_y = rows.end + (arrays.lo[1] + 0.5 - m.position[1]);
  const double dz = plane_from_centre(m, list, arrays);
  Moments all, internal;
  for (int pack = 0; pack < m.packs; ++pack) {
    const Doubles dx = (first_x + kLanes * pack) + widened(kLaneNumbers);
    const std::ptrdiff_t first = m.x_start + kLanes * pack + arrays.plane_pitch * list.z;
    ColumnSums<T> taken, inside;
    for (int y = rows.begin; y < rows.end; ++y, entries += kLanes) {
      const std::ptrdiff_t cell = first + arrays.row_pitch * y;
      const Floats own = load(entries);
      const Floats factor = held_factor(held, load(arrays.fraction + cell), load(arrays.strength + cell));
      const typename Row<T>::Values h[3] = {Row<T>::load_from(exchange[0] + cell),
                                            Row<T>::load_from(exchange[1] + cell),
                                            Row<T>::load_from(exchange[2] + cell)};
      taken.add(Row<T>::of(own), h);
      inside.add(Row<T>::of(factor * own), h);
    }
    taken.add_to(all, dx, end_y, dz);
    inside.add_to(internal, dx, end_y, dz);
  }
  const Four sums[3] = {
      sums_of(all.force[0], all.force[1], all.force[2], all.torque[0]),
      sums_of(all.torque[1], all.torque[2], internal.force[0], internal.force[1]),
      sums_of(internal.force[2], internal.torque[0], internal.torque[1], internal.torque[2])};
  static_assert(sizeof(LatticeLoad) == sizeof sums,
                "force, torque, internal_fluid_momentum, internal_fluid_spin, nothing else");
  double* to = reinterpret_cast<double*>(&load_sum);
  for (int i = 0; i < 3; ++i) store_unaligned(to + 4 * i, unaligned(to + 4 * i) + sums[i]);
  return entries;
}

template <class T>
void sum_all(const SliceList& list, const CellArrays& given, const HeldRule& rule, const T* const* exchange,
             const SliceNotes& notes, LatticeLoad* loads) {
  const CellArrays arrays = given;
  const HeldRule held = rule;
  const T* const from[3] = {exchange[0], exchange[1], exchange[2]};
  const SliceRows* rows = notes.rows;
  const float* entries = notes.entries;
  for (int i = 0; i < list.count; ++i) {
    fetch_record(list.spheres, list, i);
    fetch_record(loads, list, i);
    const int n = list.numbers[i];
    entries = sum_slice<T>(list.spheres[n], list, rows[i], arrays, held, from, entries, loads[n]);
  }
}

}  // namespace

void map_slices(const SliceList& list, const FractionRule& rule, const CellArrays& arrays,
                const SliceNotes& notes) {
  map_by<Target::cells>(list, rule, arrays, notes);
}

void strengths_of(const SliceList& list, const FractionRule& rule, const CellArrays& arrays,
                  const SliceNotes& notes) {
  map_by<Target::entries_only>(list, rule, arrays, notes);
}

void sum_loads(const SliceList& list, const CellArrays& arrays, const HeldRule& held, const SliceNotes& notes,
               LatticeLoad* loads) {
  if (arrays.exchange_double[0] != nullptr)
    sum_all<double>(list, arrays, held, arrays.exchange_double, notes, loads);
  else
    sum_all<float>(list, arrays, held, arrays.exchange_float, notes, loads);
}

}  // namespace suffuse::coupling::SUFFUSE_KERNEL_NAMESPACE
