#pragma once

#include <string>

namespace suffuse {

class Hdf5File;

/// What the files of a run say of their origin. A program sets it once, before it writes any.
struct Provenance {
  std::string version;  ///< of the program
  std::string script;   ///< as its command line names it; empty where it came by standard input
};
void set_provenance(const Provenance& provenance);
const Provenance& provenance();

/// Attributes suffuse_version and script of the file's root. Collective.
void write_provenance(Hdf5File& file);

}  // namespace suffuse
