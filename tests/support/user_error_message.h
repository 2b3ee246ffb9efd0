#pragma once

#include <functional>
#include <string>

#include "suffuse/common/error.h"

namespace suffuse {

/// What the UserError of an action says, or `otherwise` where it throws none.
inline std::string message_of(const std::function<void()>& action, const std::string& otherwise = "") {
  try {
    action();
  } catch (const UserError& problem) {
    return problem.what();
  }
  return otherwise;
}

}  // namespace suffuse
