#pragma once

#include <array>
#include <string>

#include "suffuse/common/linear_algebra.h"
#include "suffuse/lbm/index3.h"

namespace suffuse::lbm {

/// The six sides of the box, in LIGGGHTS's order and with its names: xlo xhi ylo yhi zlo zhi.
enum class Face { xlo, xhi, ylo, yhi, zlo, zhi };
inline constexpr int kFaces = 6;

constexpr int axis_of(Face face) {
  return static_cast<int>(face) / 2;
}
constexpr bool is_high(Face face) {
  return static_cast<int>(face) % 2 == 1;
}
constexpr Face face_at(int axis, bool high) {
  return static_cast<Face>(2 * axis + (high ? 1 : 0));
}
std::string name_of(Face face);

enum class FaceKind {
  periodic,
  no_slip,    ///< half-way bounce-back: the wall lies on the face, half a cell outside the last cell's centre
  free_slip,  ///< specular reflection: a plane of symmetry
  velocity,   ///< bounce-back off a wall that moves, or that lets fluid through, at a given velocity
  pressure,   ///< a given density on the face; velocity and stress go on unchanged across it
};
std::string name_of(FaceKind kind);

/// What happens at one face, in lattice units. The values may be changed between steps, the kind may not.
struct FaceCondition {
  FaceKind kind = FaceKind::periodic;
  Vec3 velocity = Vec3::Zero();  ///< used by FaceKind::velocity
  double density = 1.;           ///< used by FaceKind::pressure; pressure = (density - 1)/3
};

using FaceConditions = std::array<FaceCondition, kFaces>;

/// Refuses mixes that mean nothing, with a UserError that names the face and a remedy: one periodic side
/// without its partner; a box in which velocity faces let in more than they let out while no pressure face
/// balances it; adjacent pressure faces at different pressures; densities that are not positive; supersonic
/// velocities.
void check(const FaceConditions& faces, const Index3& cells);

/// What becomes of a population that leaves the box through one face or, along a diagonal, through two.
struct LinkRule {
  enum class Action {
    stream,  ///< goes on to a neighbour cell, perhaps through a periodic face
    mirror,  ///< goes on to the mirror image of the neighbour (free-slip faces only)
    bounce,  ///< comes back into the cell that it left, changed by the wall's velocity
    extend,  ///< the cell beyond a pressure face continues the flow at the density that the face asks for
    anti_bounce,  ///< where two pressure faces meet: comes back with its sign turned, about the face's
                  ///< equilibrium
  };
  Action action = Action::stream;
  Face face = Face::xlo;  ///< whose value holds
  Face other =
      Face::xlo;  ///< a second face with a value of its own: the mean of both holds; else equal to `face`
};

/// The rule for a link that crosses the given faces (crossed[axis] is -1, 0 or +1). Where two faces meet:
/// a periodic or free-slip face leaves the other in charge; a no-slip wall is stronger than all; a velocity
/// is stronger than a pressure; two of the same kind share (mean value). Two free-slip faces mirror
/// twice; one beside a pressure face mirrors what continues beyond that.
LinkRule link_rule(const FaceConditions& faces, const Index3& crossed);

}  // namespace suffuse::lbm
