#pragma once

namespace suffuse {

/// How a fix ends the current `run` early.
///
/// LIGGGHTS leaves its time loop once SignalHandler::request_quit is set, and would then leave the script as
/// well. The `run` command that `suffuse` registers (command_run_until.h) takes the flag back if a fix has
/// set it, so that the script goes on. Where that command is not in place (our styles dropped into a LIGGGHTS
/// source tree), a fix must not ask.
struct EarlyStop {
  static inline bool supported = false;  ///< set while our `run` command is active
  static inline bool requested = false;  ///< set by a fix, on all ranks in the same step
};

/// Of the last `run` of LIGGGHTS's: the share of its time in which this process was on a processor; the rest
/// went to other programs. Of ranks that wait for each other, the one that had its processor least tells.
struct LastRun {
  static inline double share = 1;
};

}  // namespace suffuse
