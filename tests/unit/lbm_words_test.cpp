// What is declared of `lbm`'s words: reading, refusals, saved states and the quantities of monitors.
#include <catch2/catch.hpp>
#include <sstream>

#include "commands/lbm_words.h"
#include "commands/monitor.h"
#include "user_error_message.h"

using namespace suffuse;
using namespace suffuse::coupling;

namespace {

/// One line of a script, into the request.
void read(const std::string& line, LbmRequest& request) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  ArgumentReader reader("lbm " + words[1], static_cast<int>(arguments.size()), arguments.data(), 2);
  const bool known = read_request(words[1], reader, nullptr, request);
  REQUIRE(known);
}

std::string refusal(const std::string& line, LbmRequest& request) {
  return message_of([&] { read(line, request); });
}

std::string refusal(const std::string& line) {
  LbmRequest request;
  return refusal(line, request);
}

}  // namespace

TEST_CASE("a misspelt word of a line, value or line is answered by the one that was meant") {
  CHECK_THAT(refusal("lbm couple substep 5"), Catch::Contains("did you mean substeps?"));
  CHECK_THAT(refusal("lbm collision trt_comovin"), Catch::Contains("did you mean trt_comoving?"));
  CHECK_THAT(refusal("lbm boundary zli noslip"), Catch::Contains("face = zli"));
  CHECK_THAT(refusal("lbm monitor m every 1 file m.csv eroded_mas"),
             Catch::Contains("did you mean eroded_mass?"));
  CHECK_THAT(message_of([] { (void)lbm_command("boundry"); }), Catch::Contains("did you mean boundary?"));
}

TEST_CASE("a line that is refused leaves the request as it was, whatever was read before the mistake") {
  LbmRequest request;
  read("lbm couple substeps 7 max_mach 0.2", request);
  CHECK_THAT(refusal("lbm couple substeps 9 max_mach 2", request), Catch::Contains("max_mach = 2"));
  CHECK(request.substeps == 7);
  CHECK(request.largest_mach == 0.2);
}

TEST_CASE("rules between words of a line") {
  CHECK_THAT(refusal("lbm collision bgk magic 0.2"), Catch::Contains("go with trt or trt_comoving"));
  CHECK_THAT(refusal("lbm solid weighting fraction coefficient 2"), Catch::Contains("viscosity_independent"));
  CHECK_THAT(refusal("lbm method resolved drag tang"), Catch::Contains("go with averaged"));
  CHECK_THAT(refusal("lbm force"), Catch::Contains("gravity, pressure_gradient"));
  CHECK_THAT(refusal("lbm monitor m every 1 file m.csv layer_porosity"), Catch::Contains("layers LO HI N"));
  LbmRequest request;
  read("lbm solid weighting fraction", request);
  CHECK_FALSE(request.solids.automatic_coefficient);
  read("lbm solid weighting viscosity_independent", request);
  CHECK(request.solids.automatic_coefficient);
  read("lbm solid coefficient 3", request);
  CHECK_FALSE(request.solids.automatic_coefficient);
  CHECK(request.solids.cells.coefficient == 3);
}

TEST_CASE("saved states name and write the words that they keep as states always have") {
  LbmRequest request;
  read("lbm lattice spacing 1e-4 relaxation_time 0.6", request);
  CoupledSettings settings;
  settings.units = request.units;
  const lbm::Units units(request.units);
  std::string all;
  for (const KeptWord& word : kept_words({units, settings}))
    all += word.line + " " + word.name + "=" + word.value + "\n";
  CHECK(all ==
        "fluid density=1000\nfluid viscosity=1e-06\nlattice spacing=0.0001\nlattice relaxation_time=0.6\n"
        "collision operator=trt\ncollision magic=0.1875\ncollision incompressible=no\n"
        "solid operator=force\nsolid weighting=viscosity_independent\nsolid coefficient=auto\n"
        "solid fraction=exact\neffect turbulence=auto 0.1\neffect comoving=auto\n"
        "effect lubrication=auto\neffect buoyancy=on\neffect rotation=on\n");
}

TEST_CASE("every quantity of the registry is read by its word, and every word says what it means") {
  for (const QuantityKind& kind : quantity_kinds()) {
    LbmRequest request;
    const std::string after = kind.facts.word == "mean_force" ? " all"
                              : kind.facts.value.empty()      ? ""
                                                              : " 1e-3 2e-3";
    read("lbm monitor m every 1 file m.csv layers 0 1 2 " + kind.facts.word + after, request);
    REQUIRE(request.monitors.size() == 1);
    CHECK(request.monitors[0].quantities.at(0).word == kind.facts.word);
    CHECK(kind.make != nullptr);
  }
  for (const CommandFacts& line : lbm_commands()) {
    CHECK_FALSE(line.meaning.empty());
    for (const auto* words : {&line.first, &line.words})
      for (const WordFacts& word : *words) CHECK_FALSE(word.meaning.empty());
  }
}
