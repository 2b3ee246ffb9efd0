// A grading as a CSV file, and what is made of it: criteria, and classes of grains.

#include "fuzz_input.h"
#include "grading/grading_file.h"
#include "suffuse/micromechanics/grain_sample.h"
#include "suffuse/micromechanics/internal_stability.h"

using namespace suffuse;
namespace mm = suffuse::micromechanics;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::refused_or_read([&] {
    const std::string path = fuzz::folder().file("grading.csv", fuzz::text_of(data, size));
    if (analysis::is_dump(path, "grading")) return;
    const mm::Grading grading = analysis::read_grading(path, "grading");
    mm::grading_indices(grading);
    mm::grading_criteria(grading);
    const auto classes = mm::sample_classes(grading);
    const double split = grading.gap() ? grading.gap()->finer_diameter : grading.diameter_at(0.2);
    const mm::GrainSample sample = mm::grain_sample(classes, 1000, split);
    mm::whole_numbers(sample);
    mm::grains_with_coarse(classes, 500, split);
    mm::placing_box_edge(sample, mm::placing_solid_fraction(classes));
  });
}
