#include "wall_limit.h"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>

#include "suffuse/common/error.h"

namespace suffuse::coupling {

namespace {

std::chrono::steady_clock::time_point& beginning() {
  static auto moment = std::chrono::steady_clock::now();
  return moment;
}

}  // namespace

void WallLimit::start_clock() {
  (void)beginning();
}

WallLimit WallLimit::read(ArgumentReader& reader) {
  static const std::map<std::string, double> units{{"s", 1}, {"min", 60}, {"h", 3600}, {"d", 86400}};
  WallLimit limit;
  limit.text_ = reader.word("a time with its unit, as 2h");
  char* end = nullptr;
  const double value = std::strtod(limit.text_.c_str(), &end);
  const auto unit = units.find(end);
  if (unit == units.end() || !(value > 0) || !std::isfinite(value))
    throw_user_error({reader.who(), "time", limit.text_, "be > 0 with its unit: s, min, h or d",
                      "write `after 2h` or `after 90min`"});
  limit.seconds_ = value * unit->second;
  return limit;
}

bool WallLimit::is_over() const {
  if (!seconds_) return false;
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - beginning()).count() >= *seconds_;
}

}  // namespace suffuse::coupling
