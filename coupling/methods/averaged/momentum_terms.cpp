#include "averaged/momentum_terms.h"

namespace suffuse::coupling::averaged {

double MomentumTerms::beyond(std::size_t axis, const Index3& at, std::size_t along, int direction,
                             double here) const {
  Index3 next = at;
  next[along] += direction;
  const int extent = grid.extent(axis, along);
  if (grid.periodic(along)) next[along] = (next[along] + extent) % extent;
  if (next[along] >= 0 && next[along] < extent) return velocity[axis][grid.face(axis, next)];
  if (along == axis) return here;
  const WaterFace& face = box_face(faces, along, direction);
  const double wall = face.velocity[static_cast<Eigen::Index>(axis)];
  if (face.kind == lbm::FaceKind::no_slip) return -here;
  return face.kind == lbm::FaceKind::velocity ? 2 * wall - here : here;
}

double MomentumTerms::viscous(std::size_t axis, const Index3& at, std::size_t n) const {
  const double here = velocity[axis][n];
  double sum = 0;
  for (std::size_t along = 0; along < 3; ++along)
    for (const int direction : {-1, 1}) sum += beyond(axis, at, along, direction, here) - here;
  return mu * sum / (spacing * spacing);
}

double MomentumTerms::inertia(std::size_t axis, const Index3& at, std::size_t n) const {
  const double here = velocity[axis][n];
  const int side = grid.side(axis, at);
  double out = 0;
  for (std::size_t along = 0; along < 3; ++along)
    for (const int direction : {-1, 1}) {
      double q;
      if (along == axis && side == direction) {
        q = flux[axis][n];
      } else if (along == axis) {
        Index3 next = at;
        const int extent = grid.extent(axis, axis);
        next[axis] += direction;
        if (grid.periodic(axis)) next[axis] = (next[axis] + extent) % extent;
        q = 0.5 * (flux[axis][n] + flux[axis][grid.face(axis, next)]);
      } else {
        const auto [low, high] = grid.cells_beside(axis, at);
        const std::size_t which = direction > 0 ? 1 : 0;
        q = 0.5 * (flux[along][grid.face(along, grid.faces_of(along, low)[which])] +
                   flux[along][grid.face(along, grid.faces_of(along, high)[which])]);
      }
      const double leaving = direction * q;
      const double carried = leaving > 0 ? here : beyond(axis, at, along, direction, here);
      const double width = along == axis && side != 0 ? 0.5 * spacing : spacing;
      out += leaving * carried / width;
    }
  return out;
}

}  // namespace suffuse::coupling::averaged
