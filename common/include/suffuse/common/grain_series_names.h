#pragma once

#include <string>

/// Names in FILE_grains.h5, which runs write and `suffuse-analyse` reads (docs/analysis/suffuse-analyse.md):
/// groups step_N with a box, what is periodic, and the groups of grains and contacts with their arrays. Files
/// of fields have the same groups step_N, with their time.
namespace suffuse::grain_series {

inline constexpr const char kStep[] = "step_", kTime[] = "time_s", kBox[] = "box", kPeriodic[] = "periodic",
                            kGrains[] = "grains", kContacts[] = "contacts";
/// Of a grain.
inline constexpr const char kId[] = "id", kRadius[] = "radius", kPosition[] = "position";
/// Of a contact; kForce of a grain too.
inline constexpr const char kIds[] = "ids", kForce[] = "force", kBranch[] = "branch",
                            kFriction[] = "friction", kFrictionLimit[] = "friction_limit",
                            kSpringForce[] = "spring_force";

/// "grains/id"
inline std::string in(const char* group, const char* array) {
  return std::string(group) + "/" + array;
}

}  // namespace suffuse::grain_series
