// A monitor's CSV file that a run goes on with: what is left must be read again as a table of numbers.

#include <mpi.h>

#include "fuzz_input.h"
#include "suffuse/common/time_series_file.h"
#include "verdict/flow_record.h"

using namespace suffuse;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::refused_or_read([&] {
    const std::string path = fuzz::folder().file("series.csv", fuzz::text_of(data, size));
    {
      TimeSeriesFile file(path, "time_s,pressure_pa", "lbm monitor", SeriesContinuation{1.5}, MPI_COMM_WORLD);
      file.add({2.0, 3.0});
    }
    const analysis::NumberTable table(path, "lbm monitor");
    const auto& time = table.column("time_s");
    if (time.back() != 2.0) std::abort();
    for (std::size_t k = 1; k < time.size(); ++k)
      if (time[k - 1] > 1.5 && k < time.size()) std::abort();
  });
}
