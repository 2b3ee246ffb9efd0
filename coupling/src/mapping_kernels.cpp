// Compiled once for each instruction set (see CMakeLists.txt), so that the program carries them all and
// chooses at start. For the reason given in lbm_solver's pack.h no function of a standard library template is
// called here that the linker could share with other files.
#include "mapping_kernels.h"

#include "sphere_fraction.h"

namespace suffuse::coupling::SUFFUSE_KERNEL_NAMESPACE {

namespace {

/// Adding and subtracting this rounds to multiples of 2^-22 (values up to 1) or 2^-18 (up to 16).
constexpr float kFractionRounding = 3.f, kStrengthRounding = 48.f;

void zero(float* values, int count) {
  for (int i = 0; i < count; ++i) values[i] = 0;
}

template <FractionMethod kMethod>
void map_with(const MappedSphere& m, const FractionRule& rule, const char* planes, const CellArrays& arrays,
              float* entries) {
  const LatticeSphere& s = m.sphere;
  const Sphere sphere(s.radius, rule.subcells);
  const float first_x = static_cast<float>(m.x_start + arrays.lo[0] + 0.5 - s.position[0]);
  const float wx = static_cast<float>(s.angular_velocity[0]), wy = static_cast<float>(s.angular_velocity[1]),
              wz = static_cast<float>(s.angular_velocity[2]);
  const float coefficient = static_cast<float>(s.coefficient);
  const float reach_squared = sphere.reach * sphere.reach;
  const int cells_x = arrays.cells_x, row_entries = kLanes * m.packs;
  for (int z = m.z_begin; z < m.z_end; ++z) {
    if (planes[z] == 0) {
      entries += row_entries * (m.y_end - m.y_begin);
      continue;
    }
    const float dz = static_cast<float>(z + arrays.lo[2] + 0.5 - s.position[2]);
    for (int y = m.y_begin; y < m.y_end; ++y, entries += row_entries) {
      const float dy = static_cast<float>(y + arrays.lo[1] + 0.5 - s.position[1]);
      if (dy * dy + dz * dz >= reach_squared) {
        zero(entries, row_entries);
        continue;
      }
      const float ux = static_cast<float>(s.velocity[0]) + wy * dz - wz * dy;
      const float uy = static_cast<float>(s.velocity[1]) - wx * dz;
      const float uz = static_cast<float>(s.velocity[2]) + wx * dy;
      std::ptrdiff_t cell = m.x_start + arrays.row_pitch * y + arrays.plane_pitch * z;
      for (int pack = 0; pack < m.packs; ++pack, cell += kLanes) {
        const Floats dx = first_x + static_cast<float>(kLanes * pack) + kLaneNumbers;
        Floats fraction = covered<kMethod>(sphere, dx, dy, dz);
        fraction = (fraction + kFractionRounding) - kFractionRounding;
        const int beyond = cells_x - (m.x_start + kLanes * pack);  // lanes that are cells of the row
        if (beyond < kLanes) fraction = kLaneNumbers < static_cast<float>(beyond) ? fraction : Floats{};
        Floats strength = fraction;
        store(arrays.fraction + cell, load(arrays.fraction + cell) + fraction);
        if (rule.own_coefficients) {
          strength = (coefficient * fraction + kStrengthRounding) - kStrengthRounding;
          store(arrays.strength + cell, load(arrays.strength + cell) + strength);
        }
        float* const* momentum = arrays.momentum;
        store(momentum[0] + cell, load(momentum[0] + cell) + strength * ux);
        store(momentum[1] + cell, load(momentum[1] + cell) + strength * (uy + wz * dx));
        store(momentum[2] + cell, load(momentum[2] + cell) + strength * (uz - wy * dx));
        store(entries + kLanes * pack, strength);
      }
    }
  }
}

/// The share of each cell's exchange that belongs to the sphere: 1 where it is alone.
Doubles shares(const Floats& own, const Floats& all) {
  const Floats alone = own != 0.f ? Floats{} + 1.f : Floats{};
  if (!any(alone * (all - own))) return __builtin_convertvector(alone, Doubles);
  const Doubles whole = __builtin_convertvector(all, Doubles), mine = __builtin_convertvector(own, Doubles);
  return mine / (whole > 0. ? whole : Doubles{} + 1.);
}

template <class T>
struct ExchangePack;
template <>
struct ExchangePack<double> {
  static Doubles load(const double* from) { return *reinterpret_cast<const UnalignedDoubles*>(from); }
};
template <>
struct ExchangePack<float> {
  static Doubles load(const float* from) {
    return __builtin_convertvector(SUFFUSE_KERNEL_NAMESPACE::load(from), Doubles);
  }
};

double sum_of(const Doubles& v) {
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

template <class T>
void sum_with(const MappedSphere& m, const HeldRule& held, const CellArrays& arrays, const T* const* exchange,
              const float* entries, LatticeLoad& load_sum) {
  const LatticeSphere& s = m.sphere;
  const double first_x = m.x_start + arrays.lo[0] + 0.5 - s.position[0];
  const Doubles lanes = __builtin_convertvector(kLaneNumbers, Doubles);
  Doubles force[3]{}, torque[3]{}, lead[3]{}, spin_lead[3]{};
  for (int z = m.z_begin; z < m.z_end; ++z) {
    const double dz = z + arrays.lo[2] + 0.5 - s.position[2];
    for (int y = m.y_begin; y < m.y_end; ++y) {
      const double dy = y + arrays.lo[1] + 0.5 - s.position[1];
      std::ptrdiff_t cell = m.x_start + arrays.row_pitch * y + arrays.plane_pitch * z;
      for (int pack = 0; pack < m.packs; ++pack, cell += kLanes, entries += kLanes) {
        const Floats own = load(entries);
        if (!any(own)) continue;
        const Doubles share = shares(own, load(arrays.strength + cell));
        const Doubles hx = share * ExchangePack<T>::load(exchange[0] + cell),
                      hy = share * ExchangePack<T>::load(exchange[1] + cell),
                      hz = share * ExchangePack<T>::load(exchange[2] + cell);
        const Doubles dx = (first_x + kLanes * pack) + lanes;
        force[0] += hx;
        force[1] += hy;
        force[2] += hz;
        const Doubles tx = dy * hz - dz * hy, ty = dz * hx - dx * hz, tz = dx * hy - dy * hx;
        torque[0] += tx;
        torque[1] += ty;
        torque[2] += tz;
        const Floats open = 1.f - lesser(load(arrays.fraction + cell), Floats{} + 1.f);
        const Doubles ahead = held.whole - held.slope * __builtin_convertvector(open, Doubles);
        lead[0] += ahead * hx;
        lead[1] += ahead * hy;
        lead[2] += ahead * hz;
        spin_lead[0] += ahead * tx;
        spin_lead[1] += ahead * ty;
        spin_lead[2] += ahead * tz;
      }
    }
  }
  for (int a = 0; a < 3; ++a) {
    load_sum.force[a] = sum_of(force[a]);
    load_sum.torque[a] = sum_of(torque[a]);
    load_sum.lead[a] = sum_of(lead[a]);
    load_sum.spin_lead[a] = sum_of(spin_lead[a]);
  }
}

}  // namespace

void map_sphere(const MappedSphere& mapped, const FractionRule& rule, const char* planes,
                const CellArrays& arrays, float* entries) {
  switch (rule.method) {
    case FractionMethod::exact:
      return map_with<FractionMethod::exact>(mapped, rule, planes, arrays, entries);
    case FractionMethod::linear:  // its formula holds from a radius of 0.71 on
      if (mapped.sphere.radius < 1)
        return map_with<FractionMethod::exact>(mapped, rule, planes, arrays, entries);
      return map_with<FractionMethod::linear>(mapped, rule, planes, arrays, entries);
    case FractionMethod::subcells:
      return map_with<FractionMethod::subcells>(mapped, rule, planes, arrays, entries);
  }
}

void sum_load(const MappedSphere& mapped, const HeldRule& held, const CellArrays& arrays,
              const float* entries, LatticeLoad& load_sum) {
  if (arrays.exchange_double[0] != nullptr)
    sum_with<double>(mapped, held, arrays, arrays.exchange_double, entries, load_sum);
  else
    sum_with<float>(mapped, held, arrays, arrays.exchange_float, entries, load_sum);
}

}  // namespace suffuse::coupling::SUFFUSE_KERNEL_NAMESPACE
