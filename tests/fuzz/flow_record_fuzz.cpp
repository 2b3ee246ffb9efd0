// The CSV file of an upward-flow run, and what is measured of it.

#include "fuzz_input.h"
#include "verdict/flow_record.h"

using namespace suffuse;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::refused_or_read([&] {
    const std::string path = fuzz::folder().file("flow.csv", fuzz::text_of(data, size));
    const analysis::FlowRecord record = analysis::flow_record({path, "fluidisation"}, "fluidisation", {});
    micromechanics::holds_of(record.driving);
    micromechanics::measure_fluidisation(record.states, 1, record.height);
  });
}
