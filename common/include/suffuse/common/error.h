#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>

namespace suffuse {

/// A mistake in what a person wrote (script, option, file), never in the program.
///
/// Thrown on every rank alike, before anything has been changed. The outermost level prints one line on rank
/// 0 and every rank exits with code 1.
class UserError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The parts of a message about wrong input, in the order in which they are read:
/// `who: what = value, must <rule>; <remedy>`. Where the rule lists words, `be one of a, b, c`, and the value
/// is near one of them, the line asks `did you mean b?`.
struct InputProblem {
  std::string who;     ///< command or style, e.g. "fix stress/servo"
  std::string what;    ///< the word that is wrong, e.g. "target"
  std::string value;   ///< what was given, e.g. "-5"
  std::string rule;    ///< what it must satisfy, e.g. "be > 0"
  std::string remedy;  ///< how to mend it; may be empty
};

/// Formats an InputProblem as one line and throws it as UserError.
[[noreturn]] void throw_user_error(const InputProblem& problem);

/// A run that has left what its method can do: not what was written, but what came of it. Thrown on every
/// rank alike; programs end with an exit code of its own (docs/reference/exit_codes.md).
class LostRun : public UserError {
 public:
  using UserError::UserError;
};
inline constexpr int kLostRunExitCode = 4;

/// The same line as a LostRun.
[[noreturn]] void throw_lost_run(const InputProblem& problem);

/// What the machine refused, as one line: a file's name too long, a loop of links, a folder that has
/// vanished, a full disk, memory that there is not. Empty for anything else, which is the program's own
/// mistake.
std::string refusal_of_the_machine(const std::exception& failure);

/// Throws UserError where what was printed has not arrived: a full disk behind the screen's output.
void require_printed_output();

}  // namespace suffuse
