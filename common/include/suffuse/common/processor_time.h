#pragma once

#include <ctime>

namespace suffuse {

/// Seconds that processors have spent on this process, all of its threads together: what other programs take
/// of the machine does not count. From an origin of its own; differences mean something.
inline double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace suffuse
