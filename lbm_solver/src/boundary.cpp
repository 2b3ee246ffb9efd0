#include "suffuse/lbm/boundary.h"

#include <fmt/format.h>

#include <cmath>

#include "suffuse/common/error.h"
#include "suffuse/lbm/lattice.h"

namespace suffuse::lbm {

namespace {

const FaceCondition& at(const FaceConditions& faces, Face face) {
  return faces[static_cast<std::size_t>(face)];
}

void check_values(const FaceConditions& faces, Face face) {
  const FaceCondition& condition = at(faces, face);
  const std::string who = "fluid boundary " + name_of(face);
  if (condition.kind == FaceKind::pressure && !(condition.density > 0 && std::isfinite(condition.density)))
    throw_user_error({who, "density", fmt::format("{}", condition.density), "be > 0 in lattice units",
                      "a smaller pressure difference or a smaller time step"});
  if (condition.kind == FaceKind::velocity && !(condition.velocity.norm() < std::sqrt(kSoundSpeedSquared)))
    throw_user_error({who, "velocity", fmt::format("{} cells a step", condition.velocity.norm()),
                      "be below the lattice speed of sound, 0.577", "a smaller time step"});
}

void check_periodic_pair(const FaceConditions& faces, int axis) {
  const Face lo = face_at(axis, false), hi = face_at(axis, true);
  const bool lo_periodic = at(faces, lo).kind == FaceKind::periodic;
  const bool hi_periodic = at(faces, hi).kind == FaceKind::periodic;
  if (lo_periodic == hi_periodic) return;
  const Face odd = lo_periodic ? hi : lo, partner = lo_periodic ? lo : hi;
  throw_user_error({"fluid boundary " + name_of(odd), "kind", name_of(at(faces, odd).kind),
                    "be periodic because " + name_of(partner) + " is", "or give both faces another kind"});
}

void check_adjacent_pressures(const FaceConditions& faces) {
  for (int a = 0; a < kFaces; ++a)
    for (int b = a + 1; b < kFaces; ++b) {
      const Face first = static_cast<Face>(a), second = static_cast<Face>(b);
      if (axis_of(first) == axis_of(second)) continue;
      const FaceCondition &one = at(faces, first), &two = at(faces, second);
      if (one.kind == FaceKind::pressure && two.kind == FaceKind::pressure && one.density != two.density)
        throw_user_error(
            {"fluid boundary " + name_of(second), "density", fmt::format("{}", two.density),
             fmt::format("equal {} of {}, which meets it along an edge", one.density, name_of(first)),
             "or put a wall between the two"});
    }
}

void check_net_inflow(const FaceConditions& faces, const Index3& cells) {
  double inflow = 0, largest = 0;
  for (int f = 0; f < kFaces; ++f) {
    const Face face = static_cast<Face>(f);
    if (at(faces, face).kind == FaceKind::pressure) return;
    if (at(faces, face).kind != FaceKind::velocity) continue;
    const int axis = axis_of(face);
    const double area = static_cast<double>(cells[static_cast<std::size_t>((axis + 1) % 3)]) *
                        cells[static_cast<std::size_t>((axis + 2) % 3)];
    const double through = area * at(faces, face).velocity[axis];
    inflow += is_high(face) ? -through : through;
    largest = std::max(largest, std::abs(through));
  }
  // Rounding of the SI values is no leak; anything above it fills the box for ever.
  if (std::abs(inflow) > 1e-12 * largest)
    throw_user_error({"fluid boundary", "net inflow of the velocity faces", fmt::format("{:g}", inflow),
                      "be zero where no face has a pressure", "make the outlet a pressure face"});
}

}  // namespace

std::string name_of(Face face) {
  static const char* const names[] = {"xlo", "xhi", "ylo", "yhi", "zlo", "zhi"};
  return names[static_cast<int>(face)];
}

std::string name_of(FaceKind kind) {
  switch (kind) {
    case FaceKind::periodic:
      return "periodic";
    case FaceKind::no_slip:
      return "noslip";
    case FaceKind::free_slip:
      return "freeslip";
    case FaceKind::velocity:
      return "velocity";
    case FaceKind::pressure:
      return "pressure";
  }
  return "unknown";
}

void check(const FaceConditions& faces, const Index3& cells) {
  for (int f = 0; f < kFaces; ++f) check_values(faces, static_cast<Face>(f));
  for (int axis = 0; axis < 3; ++axis) check_periodic_pair(faces, axis);
  check_adjacent_pressures(faces);
  check_net_inflow(faces, cells);
}

LinkRule link_rule(const FaceConditions& faces, const Index3& crossed) {
  const auto strength = [](FaceKind kind) {
    switch (kind) {
      case FaceKind::periodic:
        return 0;
      case FaceKind::free_slip:
        return 1;
      case FaceKind::pressure:
        return 2;
      case FaceKind::velocity:
        return 3;
      case FaceKind::no_slip:
        return 4;
    }
    return 0;
  };
  LinkRule rule;
  int strongest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int side = crossed[static_cast<std::size_t>(axis)];
    if (side == 0) continue;
    const Face face = face_at(axis, side > 0);
    const int here = strength(at(faces, face).kind);
    if (here > strongest) {
      strongest = here;
      rule.face = rule.other = face;
    } else if (here == strongest) {
      rule.other = face;
    }
  }
  constexpr LinkRule::Action actions[] = {LinkRule::Action::stream, LinkRule::Action::mirror,
                                          LinkRule::Action::extend, LinkRule::Action::bounce,
                                          LinkRule::Action::bounce};
  rule.action = actions[strongest];
  if (rule.action == LinkRule::Action::extend && rule.face != rule.other)
    rule.action = LinkRule::Action::anti_bounce;
  return rule;
}

}  // namespace suffuse::lbm
