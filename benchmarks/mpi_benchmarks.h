#pragma once

// What the benchmarks share that run on all ranks at once.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

namespace suffuse {

inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Ranks other than the first take part in every run and say nothing.
class Silent : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>&) override {}
};

/// Runs run(state, scene) for each scene on every rank; their timers are the scenes' own. Every rank must
/// make the same number of iterations, so none is left to a clock.
template <class Scene>
void run_benchmarks(const std::vector<Scene>& scenes, void (*run)(benchmark::State&, const Scene&),
                    int iterations, int rank) {
  for (const Scene& scene : scenes)
    benchmark::RegisterBenchmark(scene.name.c_str(), run, scene)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->Iterations(iterations);
  Silent silent;
  if (rank == 0)
    benchmark::RunSpecifiedBenchmarks();
  else
    benchmark::RunSpecifiedBenchmarks(&silent);
}

}  // namespace suffuse
