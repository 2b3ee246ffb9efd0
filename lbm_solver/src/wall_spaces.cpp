#include "suffuse/lbm/wall_spaces.h"

#include <mpi.h>

#include <algorithm>
#include <numeric>

#include "suffuse/lbm/boundary.h"
#include "suffuse/lbm/lattice.h"

namespace suffuse::lbm {

namespace {

using Label = std::int64_t;
constexpr Label kNobody = -1;

std::size_t slot(int n) {
  return static_cast<std::size_t>(n);
}

/// All ranks' values, sorted, each once. Collective.
std::vector<Label> union_of(std::vector<Label> mine, MPI_Comm communicator) {
  std::sort(mine.begin(), mine.end());
  mine.erase(std::unique(mine.begin(), mine.end()), mine.end());
  int ranks = 1, count = static_cast<int>(mine.size());
  MPI_Comm_size(communicator, &ranks);
  std::vector<int> counts(slot(ranks)), offsets(slot(ranks), 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator);
  std::partial_sum(counts.begin(), counts.end() - 1, offsets.begin() + 1);
  std::vector<Label> all(slot(offsets.back() + counts.back()));
  MPI_Allgatherv(mine.data(), count, MPI_INT64_T, all.data(), counts.data(), offsets.data(), MPI_INT64_T,
                 communicator);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// A label a cell of this rank and of those around it: the lowest number of any cell of the space.
class SpaceLabels {
 public:
  SpaceLabels(const Decomposition& decomposition, const FaceConditions& faces,
              const std::vector<WallLink>& links)
      : decomposition_(decomposition), faces_(faces), box_(decomposition.local_box()) {
    cut_.assign(box_.volume(), 0);
    for (const WallLink& link : links) cut_[number(local(link.cell))] |= 1U << link.direction;
    parent_.resize(box_.volume());
    std::iota(parent_.begin(), parent_.end(), Label{0});
    lowest_.resize(box_.volume());
    for_each_cell(box_, [&](int x, int y, int z) {
      lowest_[number(local({x, y, z}))] = of_whole({x, y, z});
    });
    for (std::size_t a = 0; a < 3; ++a) pitch_[a] = box_.extent(static_cast<int>(a)) + 2;
    around_.assign(slot(pitch_[0]) * slot(pitch_[1]) * slot(pitch_[2]), kNobody);
    join_inside();
    while (join_neighbours()) {
    }
  }

  /// Of a cell of this rank, numbered from its low corner.
  Label of(const Index3& cell) { return lowest_[root(number(cell))]; }
  Label of(std::size_t n) { return lowest_[root(n)]; }

  std::size_t number(const Index3& cell) const {
    return slot(cell[0]) + slot(box_.extent(0)) * (slot(cell[1]) + slot(box_.extent(1)) * slot(cell[2]));
  }
  Index3 local(const Index3& cell) const {
    return {cell[0] - box_.lo[0], cell[1] - box_.lo[1], cell[2] - box_.lo[2]};
  }
  /// Number of a cell in the whole box.
  Label of_whole(const Index3& cell) const {
    const Index3& n = decomposition_.cells();
    return cell[0] + Label{n[0]} * (cell[1] + Label{n[1]} * cell[2]);
  }

  /// The faces of the box that the link of a cell crosses.
  Index3 crossed(const Index3& cell, int direction) const {
    Index3 sides{0, 0, 0};
    for (std::size_t a = 0; a < 3; ++a) {
      const int there = box_.lo[a] + cell[a] + kVelocity[direction][a];
      if (there < 0 || there >= decomposition_.cells()[a]) sides[a] = kVelocity[direction][a];
    }
    return sides;
  }

 private:
  std::size_t root(std::size_t n) {
    while (parent_[n] != static_cast<Label>(n)) {
      const std::size_t next = static_cast<std::size_t>(parent_[n]);
      parent_[n] = parent_[next];
      n = next;
    }
    return n;
  }

  void join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (lowest_[b] < lowest_[a]) std::swap(a, b);
    parent_[b] = static_cast<Label>(a);
  }

  /// Where a link leads, counted from the low corner of this rank's cells; nowhere if it comes back, is cut,
  /// or goes on beyond a pressure face.
  bool leads_to(const Index3& cell, int direction, Index3& there) const {
    if ((cut_[number(cell)] >> direction & 1U) != 0) return false;
    const Index3 sides = crossed(cell, direction);
    if (sides != Index3{0, 0, 0}) {
      const LinkRule::Action action = link_rule(faces_, sides).action;
      if (action != LinkRule::Action::stream && action != LinkRule::Action::mirror) return false;
    }
    for (std::size_t a = 0; a < 3; ++a) {
      const bool periodic = faces_[2 * a].kind == FaceKind::periodic;
      there[a] = sides[a] != 0 && !periodic ? cell[a] : cell[a] + kVelocity[direction][a];
    }
    return true;
  }

  bool is_inside(const Index3& cell) const {
    for (int a = 0; a < 3; ++a)
      if (cell[slot(a)] < 0 || cell[slot(a)] >= box_.extent(a)) return false;
    return true;
  }

  void join_inside() {
    for_each_cell({{0, 0, 0}, box_.extents()}, [&](int x, int y, int z) {
      for (int i = 1; i < kDirections; ++i)
        if (Index3 there; leads_to({x, y, z}, i, there) && is_inside(there))
          join(number({x, y, z}), number(there));
    });
  }

  std::size_t place(const Index3& cell) const {
    return slot(cell[0] + 1) + slot(pitch_[0]) * (slot(cell[1] + 1) + slot(pitch_[1]) * slot(cell[2] + 1));
  }

  /// Takes lower labels over from cells around; true if any rank did. Collective.
  bool join_neighbours() {
    exchange();
    int changed = 0;
    for_each_cell({{0, 0, 0}, box_.extents()}, [&](int x, int y, int z) {
      const bool rim = x == 0 || y == 0 || z == 0 || x == box_.extent(0) - 1 || y == box_.extent(1) - 1 ||
                       z == box_.extent(2) - 1;
      if (!rim) return;
      for (int i = 1; i < kDirections; ++i) {
        Index3 there;
        if (!leads_to({x, y, z}, i, there) || is_inside(there)) continue;
        Label& mine = lowest_[root(number({x, y, z}))];
        const Label other = around_[place(there)];
        if (other == kNobody || other >= mine) continue;
        mine = other;
        changed = 1;
      }
    });
    MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_MAX, decomposition_.communicator());
    return changed != 0;
  }

  /// Fills the layer around this rank's cells, axis by axis, edges and corners along the way.
  void exchange() {
    for_each_cell({{0, 0, 0}, box_.extents()}, [&](int x, int y, int z) {
      around_[place({x, y, z})] = of({x, y, z});
    });
    for (int axis = 0; axis < 3; ++axis)
      for (const bool high : {false, true}) {
        // What lies at this end goes to the neighbour beyond it, which has it beyond its other end.
        const int last = box_.extent(axis) - 1;
        std::vector<Label> out = layer(axis, high ? last : 0), in(out.size(), kNobody);
        const int to = decomposition_.neighbour(face_at(axis, high)),
                  from = decomposition_.neighbour(face_at(axis, !high));
        MPI_Sendrecv(out.data(), static_cast<int>(out.size()), MPI_INT64_T, to, high ? 1 : 0, in.data(),
                     static_cast<int>(in.size()), MPI_INT64_T, from, high ? 1 : 0,
                     decomposition_.communicator(), MPI_STATUS_IGNORE);
        set_layer(axis, high ? -1 : last + 1, in);
      }
  }

  CellBox layer_box(int axis, int position) const {
    CellBox box{{-1, -1, -1}, {pitch_[0] - 1, pitch_[1] - 1, pitch_[2] - 1}};
    box.lo[slot(axis)] = position;
    box.hi[slot(axis)] = position + 1;
    return box;
  }
  std::vector<Label> layer(int axis, int position) const {
    std::vector<Label> values;
    for_each_cell(layer_box(axis, position), [&](int x, int y, int z) {
      values.push_back(around_[place({x, y, z})]);
    });
    return values;
  }
  void set_layer(int axis, int position, const std::vector<Label>& values) {
    std::size_t n = 0;
    for_each_cell(layer_box(axis, position), [&](int x, int y, int z) {
      around_[place({x, y, z})] = values[n++];
    });
  }

  const Decomposition& decomposition_;
  const FaceConditions& faces_;
  CellBox box_;
  Index3 pitch_{};
  std::vector<std::uint32_t> cut_;  ///< a bit a direction
  std::vector<Label> parent_, lowest_, around_;
};

bool anywhere(bool mine, MPI_Comm communicator) {
  int any = mine ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, communicator);
  return any != 0;
}

/// Nothing enters closed cells through the faces of the box: what a velocity face lets in would not get out.
void close_faces(const Decomposition& decomposition, const FaceConditions& faces, const SpaceLabels& labels,
                 const std::vector<std::uint8_t>& closed, std::vector<WallLink>& links) {
  for_each_cell(decomposition.local_box(), [&](int x, int y, int z) {
    const Index3 cell = labels.local({x, y, z});
    if (closed[labels.number(cell)] == 0) return;
    for (int i = 1; i < kDirections; ++i) {
      const Index3 crossed = labels.crossed(cell, i);
      if (crossed == Index3{0, 0, 0}) continue;
      const LinkRule rule = link_rule(faces, crossed);
      if (rule.action != LinkRule::Action::stream && rule.action != LinkRule::Action::mirror)
        links.push_back({{x, y, z}, i, 0.5, -1});
    }
  });
}

/// Numbers the spaces with water, and closes the faces behind walls.
Walls finish(const Decomposition& decomposition, const FaceConditions& faces, std::vector<WallLink> links,
             std::vector<std::uint8_t> closed, SpaceLabels& labels) {
  const MPI_Comm communicator = decomposition.communicator();
  Walls walls;
  walls.links = std::move(links);
  if (anywhere(std::any_of(closed.begin(), closed.end(), [](std::uint8_t c) { return c != 0; }),
               communicator))
    walls.closed = std::move(closed);
  std::vector<Label> wet;
  const auto is_open = [&](const WallLink& link) {
    return walls.closed.empty() || walls.closed[labels.number(labels.local(link.cell))] == 0;
  };
  for (const WallLink& link : walls.links)
    if (is_open(link)) wet.push_back(labels.of(labels.local(link.cell)));
  const std::vector<Label> spaces = union_of(std::move(wet), communicator);
  walls.spaces = static_cast<int>(spaces.size());
  std::vector<WallLink> at_faces;
  if (!walls.closed.empty()) close_faces(decomposition, faces, labels, walls.closed, at_faces);
  std::erase_if(walls.links, [&](const WallLink& link) { return !is_open(link); });
  for (WallLink& link : walls.links) {
    const Label label = labels.of(labels.local(link.cell));
    link.space = static_cast<int>(std::lower_bound(spaces.begin(), spaces.end(), label) - spaces.begin());
  }
  walls.links.insert(walls.links.end(), at_faces.begin(), at_faces.end());
  return walls;
}

}  // namespace

Walls divide(const Decomposition& decomposition, const FaceConditions& faces, std::vector<WallLink> links,
             const std::vector<Index3>& wet) {
  const MPI_Comm communicator = decomposition.communicator();
  if (!anywhere(!links.empty(), communicator)) return {};
  SpaceLabels labels(decomposition, faces, links);
  std::vector<Label> cells;
  for (const Index3& cell : wet) {
    bool inside = true;
    for (std::size_t a = 0; a < 3; ++a) inside &= cell[a] >= 0 && cell[a] < decomposition.cells()[a];
    if (inside) cells.push_back(labels.of_whole(cell));
  }
  const std::vector<Label> wet_cells = union_of(std::move(cells), communicator);
  std::vector<Label> mine;
  const CellBox& box = decomposition.local_box();
  const Index3& n = decomposition.cells();
  for (const Label cell : wet_cells) {
    const Index3 where{static_cast<int>(cell % n[0]), static_cast<int>(cell / n[0] % n[1]),
                       static_cast<int>(cell / n[0] / n[1])};
    bool here = true;
    for (std::size_t a = 0; a < 3; ++a) here &= where[a] >= box.lo[a] && where[a] < box.hi[a];
    if (here) mine.push_back(labels.of(labels.local(where)));
  }
  const std::vector<Label> open = union_of(std::move(mine), communicator);
  std::vector<std::uint8_t> closed(box.volume(), 0);
  if (!open.empty())
    for (std::size_t c = 0; c < closed.size(); ++c)
      closed[c] = std::binary_search(open.begin(), open.end(), labels.of(c)) ? 0 : 1;
  return finish(decomposition, faces, std::move(links), std::move(closed), labels);
}

Walls divide(const Decomposition& decomposition, const FaceConditions& faces, std::vector<WallLink> links,
             const std::vector<std::uint8_t>& closed) {
  if (!anywhere(!links.empty(), decomposition.communicator())) return {};
  SpaceLabels labels(decomposition, faces, links);
  return finish(decomposition, faces, std::move(links), closed, labels);
}

}  // namespace suffuse::lbm
