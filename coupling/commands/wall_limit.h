#pragma once

#include <optional>
#include <string>

#include "styles/style_support.h"

namespace suffuse::coupling {

/// A time of the clock on the wall after which a run ends in order, counted from the start of the program.
class WallLimit {
 public:
  WallLimit() = default;
  /// The next word: a number with its unit, s, min, h or d, as in 2h or 90min. A UserError for anything else.
  static WallLimit read(ArgumentReader& reader);
  /// To be called when the program begins.
  static void start_clock();

  bool given() const { return seconds_.has_value(); }
  /// On one rank: clocks differ.
  bool is_over() const;
  /// "2h", as it was written.
  const std::string& text() const { return text_; }

 private:
  std::optional<double> seconds_;
  std::string text_;
};

/// What the ranks agree on as a reason to stop, beside signals (LiggghtsPort::stop_requested).
inline constexpr int kWallLimitStops = 1000;

}  // namespace suffuse::coupling
