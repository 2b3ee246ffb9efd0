// The saved state of a fluid of 4 x 3 x 5 cells; and a file of fields that a run goes on with.

#include <mpi.h>

#include "hdf5_tree.h"
#include "suffuse/lbm/checkpoint.h"
#include "suffuse/lbm/field_output.h"

using namespace suffuse;

namespace {

constexpr std::size_t kDirections = 19;

void write_state(const std::string& path, fuzz::Bytes& bytes) {
  fuzz::Hdf5Tree file(path);
  if (bytes.below(8) != 1)
    file.attribute("/", "what", bytes.below(8) == 1 ? "a poem" : "suffuse fluid state, version 1");
  file.attribute("/", "storage", bytes.below(8) == 1 ? "float" : "double");
  file.attribute("/", "steps", 12, bytes);
  file.attribute("/", "at_odd_step", 0, bytes);
  file.array("/populations", {kDirections, 5, 3, 4}, {1e-4, 0, -1e-4}, bytes);
  file.array("/solid_labels", {5, 3, 4}, {0, 0, 0, 1}, bytes);
}

void write_fields(const std::string& path, fuzz::Bytes& bytes) {
  fuzz::Hdf5Tree file(path);
  for (const char* step : {"/step_000000000000", "/step_000000000007", "/step_900000000000"}) {
    if (bytes.below(3) == 0) continue;
    file.group(step);
    file.attribute(step, "time_s", 0.5, bytes);
    file.array(std::string(step) + "/velocity", {5, 3, 4, 3}, {0}, bytes);
    file.array(std::string(step) + "/pressure", {5, 3, 4}, {0}, bytes);
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const std::string state = fuzz::folder().file("fluid.h5"), fields = fuzz::folder().file("fields.h5");
  write_state(state, bytes);
  write_fields(fields, bytes);
  lbm::FluidSettings settings;
  lbm::Fluid fluid(settings, lbm::Decomposition::balanced(MPI_COMM_WORLD, {4, 3, 5}));
  fuzz::refused_or_read([&] { lbm::load_state(fluid, state); });
  return fuzz::refused_or_read([&] {
    lbm::UnitsRequest request;
    request.spacing = 1e-4, request.relaxation_time = 0.8;
    lbm::FieldOutputSettings output;
    output.path = fields;
    output.append = true;
    lbm::FieldOutput(output, lbm::Units(request)).write(fluid);
  });
}
