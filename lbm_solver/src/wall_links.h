#pragma once

#include <cstdint>
#include <vector>

#include "populations.h"
#include "suffuse/lbm/decomposition.h"
#include "suffuse/lbm/walls.h"

namespace suffuse::lbm {

/// Bounce-back off walls that cut links at any distance (walls.h), after everything else of a step: it
/// overwrites what the exchange and the faces have put into the places of these links.
///
/// With q the distance and i the direction towards the wall, j that back (docs key: bouzidi2001):
///   q < 1/2:   f_j = 2q f_i* + (1 - 2q) f_i,  f_i what streams in behind the cell in the same step
///   q >= 1/2:  f_j = f_i*/(2q) + (1 - 1/(2q)) f_j*,  the star for what leaves the cell.
/// Both are f_i* + share (second - f_i*). Where the link behind the cell is cut too, f_j* stands for what
/// streams in: it is what a half-way wall there would return.
template <class T>
class WallLinks {
 public:
  /// Collective.
  WallLinks(const Decomposition& decomposition, const Populations<T>& populations, const Walls& walls);

  /// Collective.
  void fill(Populations<T>& populations) { apply<false>(populations); }
  void fold(Populations<T>& populations) { apply<true>(populations); }

  std::size_t bytes() const;

 private:
  struct Link {
    std::ptrdiff_t cell = 0;
    double share = 0;
    int space = -1;
  };
  /// Links of one direction whose second value is found in the same way.
  struct Group {
    int direction = 0;
    bool second_streams_in = false;
    std::vector<Link> links;
  };
  template <bool kAfterOddStep>
  void apply(Populations<T>& populations);
  template <bool kAfterOddStep>
  std::size_t read(const Populations<T>& populations, const Group& group, std::size_t n);
  Group& group_of(int direction, bool second_streams_in);
  std::vector<double> corrections() const;
  void count_weights(const Walls& walls);

  MPI_Comm communicator_;
  std::vector<Group> groups_;
  bool interpolates_ = false;          ///< some link of some rank has a share that is not zero
  std::vector<std::int64_t> added_;    ///< to each space in this step, in units of kUnit
  std::vector<std::int64_t> weights_;  ///< of the links of each space on all ranks, 1/36
  std::vector<double> returned_;       ///< one value a link, before the correction
};

}  // namespace suffuse::lbm
