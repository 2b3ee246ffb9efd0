#pragma once

#include "suffuse/common/error.h"

namespace suffuse::coupling {

/// What `suffuse` ends with, beside 0. docs/reference/exit_codes.md says what each is for a user.
namespace exit_code {
inline constexpr int user_error = 1;      ///< a script, an option, a file, or what the machine refuses
inline constexpr int internal_error = 2;  ///< a mistake of the program
inline constexpr int time_limit = 3;  ///< the wall time that the script gave is used up; the state is saved
inline constexpr int guard = kLostRunExitCode;  ///< a run has left what its method can do
inline constexpr int signal = 128;              ///< and the signal's number
}  // namespace exit_code

}  // namespace suffuse::coupling
