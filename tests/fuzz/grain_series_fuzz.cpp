// An HDF5 file of grains and contacts, and what is measured of its snapshots.

#include "contacts/contact_measures.h"
#include "hdf5_tree.h"

using namespace suffuse;

namespace {

void write_step(fuzz::Hdf5Tree& file, const std::string& step, fuzz::Bytes& bytes) {
  file.group(step);
  file.attribute(step, "time_s", 0.25, bytes);
  file.group(step + "/grains");
  file.array(step + "/grains/id", {3}, {1, 2, 3}, bytes);
  file.array(step + "/grains/radius", {3}, {1e-3, 1e-3, 5e-4}, bytes);
  file.array(step + "/grains/position", {3, 3}, {1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 2.9e-3, 2.4e-3, 1e-3, 1e-3},
             bytes);
  file.group(step + "/contacts");
  file.array(step + "/contacts/ids", {2, 2}, {1, 2, 1, 3}, bytes);
  file.array(step + "/contacts/force", {2, 3}, {0, 0, -1, -1, 0, 0.1}, bytes);
  file.array(step + "/contacts/branch", {2, 3}, {0, 0, -1.9e-3, -1.4e-3, 0, 0}, bytes);
  file.array(step + "/contacts/friction", {2}, {0.3}, bytes);
  file.array(step + "/contacts/friction_limit", {2}, {0.3}, bytes);
  file.array(step + "/contacts/spring_force", {2}, {0.1}, bytes);
  file.array(step + "/box", {2, 3}, {0, 0, 0, 4e-3, 4e-3, 4e-3}, bytes);
  file.array(step + "/periodic", {3}, {1, 1, 0}, bytes);
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const std::string path = fuzz::folder().file("grains.h5");
  {
    fuzz::Hdf5Tree file(path);
    static constexpr const char* kNames[] = {"/step_0", "/step_000000000100", "/step_100",
                                             "/step_x", "/step_-3",           "/step_99999999999999999999"};
    for (int k = 1 + bytes.below(3); k > 0; --k) write_step(file, kNames[bytes.below(6)], bytes);
  }
  return fuzz::refused_or_read([&] {
    const auto series = analysis::open_series({path}, {});
    analysis::ContactMeasurer measurer({});
    for (analysis::Snapshot snapshot; series->next(snapshot);) measurer.measure(snapshot);
    series->notes();
  });
}
