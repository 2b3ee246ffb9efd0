// A study's TOML file. Nothing of it is run.

#include "fuzz_input.h"
#include "suffuse/study/study_cases.h"
#include "suffuse/study/study_file.h"

using namespace suffuse;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::refused_or_read([&] {
    fuzz::folder().file("in.scene", "variable a index 1\n");
    study::study_cases(study::read_study(fuzz::folder().file("study.toml", fuzz::text_of(data, size))));
  });
}
