#ifndef SUFFUSE_LOCAL_COLLECTOR_H
#define SUFFUSE_LOCAL_COLLECTOR_H

#include "lammps.h"
#include "update.h"

namespace suffuse {

/// Makes a compute of the class ComputePairGranLocal that no script names. Its base class refuses to be made
/// after a first run, since it would be asked for values of the past; ours are only ever asked for the
/// present. `make(first, words)` constructs it.
template <class Make>
auto make_local_collector(LAMMPS_NS::LAMMPS* lmp, Make&& make) {
  const LAMMPS_NS::bigint now = lmp->update->ntimestep;
  lmp->update->ntimestep = 0;
  char id[] = "suffuse_collector";
  char group[] = "all";
  char style[] = "pair/gran/local";
  char* words[] = {id, group, style};
  int first = 3;
  auto collector = make(first, words);
  lmp->update->ntimestep = now;
  return collector;
}

}  // namespace suffuse

#endif
