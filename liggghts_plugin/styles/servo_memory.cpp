#include "servo_memory.h"

#include <cmath>
#include <cstdint>
#include <type_traits>

namespace suffuse {

namespace {

/// The order of the values: visits numbers and vectors, of a memory that is read or of one that is written.
template <class Memory, class Visit>
void each_value(Memory& memory, const Visit& visit) {
  auto& s = memory.state;
  for (auto* v : {&s.rate, &s.bias, &s.last_stress, &s.reference_lengths, &memory.stress, &memory.shear})
    for (int a = 0; a < 3; ++a) visit((*v)[a]);
  visit(s.axial_ramp);
  visit(s.axial_direction);
  visit(s.reversals);
  visit(s.peak_deviator);
  visit(s.strain_at_peak);
  visit(s.phase);
  auto& w = memory.window;
  for (auto* value : {&w.start, &w.stress_low, &w.stress_high, &w.coordination_low, &w.coordination_high})
    visit(*value);
  auto& n = memory.network;
  for (auto* value : {&n.coordination, &n.bulk_stiffness, &n.unbalanced, &n.overlap, &n.grains})
    visit(*value);
  visit(s.largest_stress);
  visit(memory.is_static);
  auto& g = memory.grains;
  for (auto* value : {&g.count, &g.density, &g.solid_volume, &g.diameter}) visit(*value);
}

}  // namespace

bool differ_by_rounding(const ServoGrains& a, const ServoGrains& b) {
  constexpr double rounding = 1e-9;
  const auto close = [](double x, double y) { return std::abs(x - y) <= rounding * std::abs(y); };
  return a.count == b.count && close(a.density, b.density) && close(a.solid_volume, b.solid_volume) &&
         close(a.diameter, b.diameter);
}

std::vector<double> packed(const ServoMemory& memory) {
  std::vector<double> values;
  each_value(memory, [&](const auto& value) { values.push_back(static_cast<double>(value)); });
  return values;
}

ServoMemory unpacked(const std::vector<double>& values) {
  ServoMemory memory;
  auto next = values.begin();
  const auto take = [&](auto& value) {
    using Value = std::remove_reference_t<decltype(value)>;
    if constexpr (std::is_enum_v<Value>)
      value = static_cast<Value>(static_cast<int>(*next++));
    else
      value = static_cast<Value>(*next++);
  };
  each_value(memory, take);
  return memory;
}

}  // namespace suffuse
