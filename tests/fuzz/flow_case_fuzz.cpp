// A TOML file of suffuse-flow, and its numbers in lattice units.

#include "fuzz_input.h"
#include "suffuse/lbm/flow_case.h"

using namespace suffuse;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::refused_or_read([&] {
    const lbm::FlowCase flow =
        lbm::read_flow_case(fuzz::folder().file("flow.toml", fuzz::text_of(data, size)));
    const lbm::Units units(flow.units);
    lbm::cells_of(flow, units);
    lbm::faces_at(flow, units, 0.5 * flow.time);
    lbm::force_at(flow, units, 0.5 * flow.time);
  });
}
