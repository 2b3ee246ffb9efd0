// Gradings as laboratories and spreadsheets write them: each read right, or refused with the true reason.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "files/csv_file.h"
#include "files/decimal_mark.h"
#include "grading/grading_file.h"
#include "grading/sieve_columns.h"
#include "user_error_message.h"

using namespace suffuse;
using namespace suffuse::analysis;
using micromechanics::Grading;

namespace {

std::string file_of(const std::string& text) {
  const auto path =
      std::filesystem::temp_directory_path() / ("suffuse_unit_grading_" + std::to_string(getpid()) + ".csv");
  std::ofstream(path, std::ios::binary) << text;
  return path.string();
}

Grading read(const std::string& text) {
  return read_grading(file_of(text), "test");
}

std::string refusal(const std::string& text) {
  return message_of([&] { read(text); });
}

/// Four points of one curve, which every dialect below must give.
void check_is_the_curve(const Grading& grading) {
  REQUIRE(grading.curve().size() == 4);
  const double sizes[] = {0.075e-3, 0.25e-3, 1e-3, 4.75e-3}, finer[] = {0.032, 0.225, 0.6, 1};
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(grading.curve()[k].diameter == Approx(sizes[k]).epsilon(1e-12));
    CHECK(grading.curve()[k].finer == Approx(finer[k]).epsilon(1e-12));
  }
}

}  // namespace

TEST_CASE("one curve in many dialects of CSV") {
  const char* dialects[] = {
      "diameter_mm,percent_finer\n0.075,3.2\n0.25,22.5\n1.0,60\n4.75,100\n",
      "\xEF\xBB\xBF"
      "diameter_mm,percent_finer\r\n0.075,3.2\r\n0.25,22.5\r\n1.0,60\r\n4.75,100\r\n",
      "sieve_mm;percent_passing\n0,075;3,2\n0,25;22,5\n1,0;60\n4,75;100\n",
      "sieve_mm,percent_passing\n\"0,075\",\"3,2\"\n\"0,25\",\"22,5\"\n1,60\n\"4,75\",100\n",
      "# a comment\n\"Sieve size (mm)\"\t\"% passing\"\n0.075\t3.2 %\n\n0.25\t22.5 %\n1\t60 %\n4.75\t100 %\n",
      "note,Opening [\xC2\xB5m],\"finer, percent\"\n\"a, "
      "\"\"b\"\"\",75,3.2\n,250,22.5\n,\"1,000\",60\n,4750,100\n",
      "opening_mm,passing,,\n4.75,1,,\n1,0.6,,\n0.25,0.225,,\n0.075,0.032,,\n",
      "radius_m,fraction_finer\n3.75e-5,0.032\n1.25e-4,0.225\n5e-4,0.6\n2.375e-3,1\n",
      "sieve_no,percent_finer\nNo. 4,100\n#18,60\n60,22.5\nASTM 200,3.2\n",
      "sieve_no,percent_finer\n#4,100\n#18,60\n#60,22.5\n#200,3.2\n",
      "sieve_mm,retained_mass_g\n4.75,0\n1,\"1,600\"\n0.25,1500.0\n0.075,772\npan,128\n",
      "diameter_mm,mass_kg\n4.75,0\n1,400\n0.25,375\n0.075,193\n0,32\n",
      "sieve_mm,percent_retained\n4.75,0\n1,40\n0.25,37.5\n0.075,19.3\nPan,3.2\n",
      "sieve_mm,Cumulative % retained\n4.75,0\n1,40\n0.25,77.5\n0.075,96.8\npan,100\n",
      "sieve_mm,mass_retained_g,percent_retained,percent_passing\n4.75,0,0,100\n1,400,40,60\n0.25,375,37.5,"
      "22.5\n0.075,193,19.3,3.2\npan,32,3.2,0\n"};
  for (const char* dialect : dialects) {
    INFO(dialect);
    check_is_the_curve(read(dialect));
  }
}

TEST_CASE("phi is -log2 of the diameter in mm") {
  const Grading grading = read("phi,percent_finer\n-2,100\n0,80\n1,55\n4,1\n");
  CHECK(grading.largest() == Approx(4e-3));
  CHECK(grading.smallest() == Approx(0.0625e-3));
  CHECK(grading.finer_at(0.5e-3) == Approx(0.55));
}

TEST_CASE("thousands in quotes are thousands where the file's other numbers have points") {
  const Grading grading =
      read("diameter_mm,mass_kg\n0.1,\"350\"\n0.3,\"900\"\n1.01,\"1,250\"\n3.0,\"2,100\"\n");
  REQUIRE(grading.classes().size() == 4);
  CHECK(grading.classes()[2].mass == Approx(1250.0 / 4600));
}

TEST_CASE("what may be two numbers is refused, with the reason") {
  const std::pair<const char*, const char*> cases[] = {
      {"diameter_mm,percent_finer\n1,18,12,5\n2,36,41,0\n19,0,100\n", "line 2 = 4 cells, must be 2"},
      {"diameter_mm,mass_kg\n1,\"1,250\"\n2,\"2,100\"\n", "'1,250', must be 1.250 or 1250"},
      {"diameter_mm;mass_kg\n1;1.250\n2;2.100\n", "'1.250', must be 1.250 or 1250"},
      {"diameter_mm;mass_kg\n1,5;12.5\n2;2\n", "'12.5' and '1,5'"},
      {"diameter_mm,mass_kg\n1,\"1,2500\"\n2,7.5\n", "decimal marks"},
      {"diameter_mm,percent_finer\n1,0\n2,12,\n3,100,7\n", "line 4 = 3 cells"},
      {"\xFF\xFE"
       "d",
       "UTF-16"},
      {"diameter_mm,percent_finer\n1,\"0\n2,100\n", "a quote that does not end"},
      {"sieve,percent_finer\n1,0\n2,100\n", "column 'sieve', must name its unit"},
      {"sieve_no,percent_finer\n4,100\n201,0\n", "sieve '201', must be one of ASTM E11"},
      {"sieve_mm,retained_mass_g\n4.75,0\n1,400\n0.25,375\n", "what passes the finest sieve = not given"},
      {"sieve_mm,retained_mass_g\n4.75,3\n1,400\n0.25,375\npan,7\n", "amount on the coarsest sieve = 3"},
      {"sieve_mm,percent_retained\n4.75,0\n1,40\n0.25,77.5\n0.075,96.8\npan,100\n",
       "cumulative_percent_retained"},
      {"sieve_mm,percent_passing\n4.75,100\n1,40\npan,3\n", "amount of the pan = 3, must be 0"},
      {"sieve_mm,passing\n4.75,97\n1,40\n", "must be 100 or 1"},
      {"diameter_mm,mass_kg\n9.5,0\n4.75,9.7\n2.00,39.5\n0.85,71.6\n0.075,8.5\n", "openings of sieves only"},
      {"diameter_mm,percent_finer\n1,0\ntotal,100\n2,100\n", "'total', must be a finite number"},
      {"diameter_mm,passing_g\n1,0\n2,100\n", "be in per cent or a share"}};
  for (const auto& [text, reason] : cases) {
    INFO(text);
    CHECK_THAT(refusal(text), Catch::Contains(reason));
  }
}

TEST_CASE("decimal marks are told from all numbers of a file") {
  CHECK(decimal_mark_of({"1", "2"}, ',', "t") == DecimalMark::point);
  CHECK(decimal_mark_of({"1.250", "2"}, ',', "t") == DecimalMark::point);
  CHECK(decimal_mark_of({"0,250", "2"}, ';', "t") == DecimalMark::comma);
  CHECK(decimal_mark_of({"1.250", "3,5"}, ';', "t") == DecimalMark::comma);
  CHECK(decimal_mark_of({"1.250.000"}, ';', "t") == DecimalMark::comma);
  CHECK(parse_decimal("1.250,5", DecimalMark::comma) == 1250.5);
  CHECK(parse_decimal("1,250,000.25", DecimalMark::point) == 1250000.25);
  CHECK(parse_decimal("1\xC2\xA0"
                      "250",
                      DecimalMark::point) == 1250);
  CHECK(parse_decimal("1'250.5", DecimalMark::point) == 1250.5);
  CHECK(parse_decimal("-1.5e-3", DecimalMark::point) == -1.5e-3);
  for (const char* wrong : {"", "1,25", "12,50.0", "1 25", "nan", "inf", "1.2.3", "one"}) {
    INFO(wrong);
    CHECK_FALSE(parse_decimal(wrong, DecimalMark::point));
  }
}

TEST_CASE("`in` before a unit is no unit, and is the inch where it stands for one") {
  const auto largest = [](const char* name) {
    return read(std::string(name) + ",percent_finer\n1,0\n2,100\n").largest();
  };
  CHECK(largest("size in m") == Approx(2));
  CHECK(largest("size in metres") == Approx(2));
  CHECK(largest("diameter in mm") == Approx(2e-3));
  for (const char* name : {"sieve_in", "size in in", "Sieve (in)", "Opening [in.] of the mesh",
                           "size in inches", "\"sieve, in.\""})
    CHECK(largest(name) == Approx(2 * 25.4e-3));
  CHECK_THAT(refusal("size in nm,percent_finer\n1,0\n2,100\n"), Catch::Contains("name its unit"));
  // "in" says nothing of a sieve's numbers either.
  CHECK(read("sieve no. in ASTM,percent_finer\n200,0\n4,100\n").largest() == Approx(4.75e-3));
}

TEST_CASE("ASTM sieves by number and by inches") {
  CHECK(astm_sieve_opening("No. 200") == Approx(0.075e-3));
  CHECK(astm_sieve_opening("#40") == Approx(0.425e-3));
  CHECK(astm_sieve_opening("3/8 in.") == Approx(9.5e-3));
  CHECK(astm_sieve_opening("1 1/2\"") == Approx(37.5e-3));
  CHECK_FALSE(astm_sieve_opening("No. 199"));
}
