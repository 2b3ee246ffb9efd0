#include "solid_links.h"

#include "lattice_vectors.h"
#include "suffuse/lbm/boundary.h"

namespace suffuse::lbm {

namespace {

/// Does the link of cell (x,y,z) of this rank in direction i come back at a face of the box?
bool returns_at_face(const Decomposition& decomposition, const FaceConditions& faces, int x, int y, int z,
                     int i) {
  const Index3 cells = decomposition.local_box().extents();
  const Index3 there{x + kVelocity[i][0], y + kVelocity[i][1], z + kVelocity[i][2]};
  Index3 crossed{0, 0, 0};
  for (int a = 0; a < 3; ++a) {
    const auto at = static_cast<std::size_t>(a);
    if (there[at] < 0 && decomposition.at_global_face(face_at(a, false))) crossed[at] = -1;
    if (there[at] >= cells[at] && decomposition.at_global_face(face_at(a, true))) crossed[at] = 1;
  }
  const LinkRule::Action action = link_rule(faces, crossed).action;
  return action == LinkRule::Action::bounce || action == LinkRule::Action::anti_bounce;
}

}  // namespace

template <class T>
SolidLinks<T>::SolidLinks(const Decomposition& decomposition, const FaceConditions& faces,
                          const Populations<T>& populations, const CellLabels& labels) {
  std::map<std::pair<int, std::uint8_t>, std::vector<std::ptrdiff_t>> found;
  for_each_cell({{0, 0, 0}, decomposition.local_box().extents()}, [&](int x, int y, int z) {
    if (labels.at(x, y, z) != 0) return;
    for (int i = 1; i < kDirections; ++i) {
      const std::uint8_t label = labels.at(x + kVelocity[i][0], y + kVelocity[i][1], z + kVelocity[i][2]);
      if (label != 0 && !returns_at_face(decomposition, faces, x, y, z, i))
        found[{i, label}].push_back(populations.index(x, y, z));
    }
  });
  for (auto& [key, cells] : found) groups_.push_back({key.first, key.second, std::move(cells)});
}

template <class T>
void SolidLinks<T>::fill(Populations<T>& populations) {
  forces_.clear();
  for (const Group& group : groups_) {
    const int i = group.direction;
    const T* own = populations.slot(opposite(i));
    T* beyond = populations.slot(i) + populations.offset_of(i);
    double sum = 0;
    for (const std::ptrdiff_t cell : group.cells) {
      beyond[cell] = own[cell];
      sum += static_cast<double>(own[cell]);
    }
    forces_.try_emplace(group.label, Vec3::Zero()).first->second += 2 * sum * velocity_of(i);
  }
}

template <class T>
void SolidLinks<T>::fold(Populations<T>& populations) {
  forces_.clear();
  for (const Group& group : groups_) {
    const int i = group.direction;
    T* own = populations.slot(opposite(i));
    const T* beyond = populations.slot(i) + populations.offset_of(i);
    double sum = 0;
    for (const std::ptrdiff_t cell : group.cells) {
      own[cell] = beyond[cell];
      sum += static_cast<double>(beyond[cell]);
    }
    forces_.try_emplace(group.label, Vec3::Zero()).first->second += 2 * sum * velocity_of(i);
  }
}

template <class T>
Vec3 SolidLinks<T>::force(std::uint8_t label) const {
  const auto found = forces_.find(label);
  return found == forces_.end() ? Vec3::Zero() : found->second;
}

template class SolidLinks<double>;
template class SolidLinks<float>;

}  // namespace suffuse::lbm
