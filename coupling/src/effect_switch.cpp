#include "suffuse/coupling/effect_switch.h"

#include <fmt/format.h>

#include <cmath>

#include "suffuse/common/error.h"

namespace suffuse::coupling {

std::string EffectState::text() const {
  if (number.name.empty()) return reason;
  return fmt::format("{} = {:.3g} ({}), {} above {:g}, {} below {:g}", number.name, number.value,
                     number.source, number.on_when_above ? "on" : "off", number.bounds.limit,
                     number.on_when_above ? "off" : "on", number.bounds.release);
}

std::vector<double> EffectState::record() const {
  std::vector<double> values{on ? 1. : 0., static_cast<double>(changes), changes > 0 ? changed_at : 0};
  for (const bool one : above) values.push_back(one ? 1 : 0);
  return values;
}

void EffectState::restore(const std::vector<double>& record, const std::string& who) {
  constexpr std::size_t least = 3;
  if (record.size() < least)
    throw_user_error({who, "effect " + name, fmt::format("{} numbers", record.size()),
                      fmt::format("be {} at least", least), "take a state that is whole"});
  on = record[0] != 0;
  changes = static_cast<int>(record[1]);
  changed_at = changes > 0 ? record[2] : EffectNumber::kNone;
  number = {};
  reason = "as in the saved state";
  above.clear();
  for (std::size_t n = least; n < record.size(); ++n) above.push_back(record[n] != 0);
}

void EffectState::decide(std::vector<EffectNumber> numbers) {
  above.resize(numbers.size(), false);
  reason.clear();
  on = true;
  number = {};
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    EffectNumber& one = numbers[n];
    one.above = one.bounds.is_above(above[n], one.value);
    above[n] = one.above;
    const bool agrees = one.above == one.on_when_above;
    if (number.name.empty() || (on && !agrees)) number = one;
    on = on && agrees;
  }
}

void EffectState::decide(bool is_on, const std::string& why) {
  on = is_on;
  number = {};
  reason = why;
}

}  // namespace suffuse::coupling
