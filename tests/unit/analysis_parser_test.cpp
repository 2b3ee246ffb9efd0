// The numbers of dumps: every text that a run can print gives the double that strtod gives.

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <random>

#include "files/number_parser.h"

using suffuse::analysis::parse_integer;
using suffuse::analysis::parse_number;

TEST_CASE("numbers of all usual forms are read as strtod reads them, to the last bit") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> mantissa(-10, 10);
  std::uniform_int_distribution<int> exponent(-30, 25);
  for (int n = 0; n < 200000; ++n) {
    const double number = mantissa(random) * std::pow(10., exponent(random));
    for (const std::string& text :
         {fmt::format("{:.6g}", number), fmt::format("{:.17g}", number), fmt::format("{:.10e}", number),
          fmt::format("{:.4f}", number), fmt::format("{:.0f}", number)}) {
      double value = 0;
      REQUIRE(parse_number(text, value));
      REQUIRE(value == std::strtod(text.c_str(), nullptr));
      // The same in the middle of a row, where eight characters can be read at once.
      const std::string row = text + " 0.000123 17 ";
      REQUIRE(parse_number(row.data(), row.data() + row.size(), value) == row.data() + text.size());
      REQUIRE(value == std::strtod(text.c_str(), nullptr));
    }
  }
}

TEST_CASE("odd forms of numbers: points at the ends, signs, small and large, not a number") {
  const auto reads = [](const char* text, double expected) {
    double value = -1;
    return parse_number(text, value) && value == expected;
  };
  CHECK(reads(".5", 0.5));
  CHECK(reads("5.", 5));
  CHECK(reads("-0.0", 0));
  CHECK(reads("+3e2", 300));
  CHECK(reads("1E+05", 1e5));
  CHECK(reads("12345678901234567890123", 12345678901234567890123.));
  CHECK(reads("0.000000000000000000000000000123", 1.23e-28));
  CHECK(reads("4.9e-324", 4.9e-324));
  CHECK(reads("1e-400", 0));
  double value = 0;
  CHECK(parse_number("nan", value));
  CHECK(std::isnan(value));
  CHECK(parse_number("-inf", value));
  CHECK(std::isinf(value));
  for (const char* text : {"", "-", ".", "e5", "abc", "1.2.3", "1e", "1 2", "0x10", "--1", "1e400", "1,5"}) {
    INFO(text);
    CHECK_FALSE(parse_number(text, value));
  }
  std::int64_t whole = 0;
  CHECK(parse_integer("120000000000", whole));
  CHECK(whole == 120000000000);
  CHECK_FALSE(parse_integer("12.5", whole));
  CHECK_FALSE(parse_integer("", whole));
}
