#include "suffuse/common/provenance.h"

#include "suffuse/common/hdf5_file.h"

namespace suffuse {

namespace {
Provenance& of_this_program() {
  static Provenance known;
  return known;
}
}  // namespace

void set_provenance(const Provenance& provenance) {
  of_this_program() = provenance;
}

const Provenance& provenance() {
  return of_this_program();
}

void write_provenance(Hdf5File& file) {
  if (!provenance().version.empty()) file.set_attribute("/", "suffuse_version", provenance().version);
  if (!provenance().script.empty()) file.set_attribute("/", "script", provenance().script);
}

}  // namespace suffuse
