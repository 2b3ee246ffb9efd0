#include "laws/expected_values.h"

#include <catch2/catch.hpp>
#include <optional>
#include <sstream>

#include "suffuse/common/error.h"

using namespace suffuse;

TEST_CASE("expected values are read with comments, quotes and empty tolerances") {
  std::istringstream file(
      "# from a table\ncase,quantity,value,tolerance,unit,source\nA,porosity,0.231,,-,\"Table 5.1, A(30%)\"\n"
      "A,mean_stress,200000,1000,Pa,text\n");
  const auto values = read_expected_values(file, "expected.csv");
  REQUIRE(values.size() == 2);
  CHECK(values[0].value == 0.231);
  CHECK(values[0].tolerance == 0);
  CHECK(values[0].source == "Table 5.1, A(30%)");
  CHECK(values[1].tolerance == 1000);
}

TEST_CASE("a wrong header, number or cell count names its line") {
  for (const char* text : {"name,value\n", "case,quantity,value,tolerance,unit,source\nA,porosity,abc,,-,x\n",
                           "case,quantity,value,tolerance,unit,source\nA,porosity,1\n"}) {
    std::istringstream file(text);
    CHECK_THROWS_AS(read_expected_values(file, "expected.csv"), UserError);
  }
}

TEST_CASE("the comparison gives the difference in per cent, and a dash for what the source does not give") {
  const std::string table = comparison_table({{"porosity", 0.22}, {"beta", 1.0}},
                                             {{"A", "porosity", 0.2, 0, "-", "Table 5.1"}}, "A");
  CHECK(table.find("+10.0") != std::string::npos);
  CHECK(table.find("Table 5.1") != std::string::npos);
  CHECK(table.find("beta") != std::string::npos);
}

TEST_CASE("the comparison says which values keep their tolerance") {
  const auto said = [](std::optional<double> measured, double tolerance) {
    const std::string table =
        comparison_table({{"porosity", measured}}, {{"A", "porosity", 0.2, tolerance, "-", "text"}}, "A");
    return std::pair(table.find(" yes ") != std::string::npos, table.find(" NO ") != std::string::npos);
  };
  CHECK(said(0.21, 0.011) == std::pair(true, false));
  CHECK(said(0.19, 0.009) == std::pair(false, true));
  CHECK(said(0.19, 0) == std::pair(false, false));
  CHECK(said(std::nullopt, 0.1) == std::pair(false, true));  // a run without the value keeps no tolerance
  CHECK(said(std::nullopt, 0) == std::pair(false, false));
}

TEST_CASE("what is expected of any case holds where a case has nothing of its own") {
  const std::vector<ExpectedValue> expected{{"any", "porosity", 0.3, 0, "-", "of any"},
                                            {"A", "porosity", 0.2, 0, "-", "of A"}};
  CHECK(comparison_table({{"porosity", 0.2}}, expected, "A").find("of A") != std::string::npos);
  CHECK(comparison_table({{"porosity", 0.2}}, expected, "B").find("of any") != std::string::npos);
}
