#include "files/number_parser.h"

#include <array>
#include <bit>
#include <charconv>
#include <cstring>

namespace suffuse::analysis {
namespace {

/// Powers of ten that a double holds exactly.
constexpr std::array<double, 23> kPowers{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                         1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                         1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr int kLargestExact = 22;
constexpr std::uint64_t kLargestMantissa = std::uint64_t{1} << 53;

bool is_digit(char c) {
  return static_cast<unsigned char>(c - '0') < 10;
}

/// Number of digits at the low end of eight characters that have been lowered by '0' (0 to 8).
int digits_at_the_front(std::uint64_t lowered) {
  const std::uint64_t above_nine = ((lowered + 0x7676767676767676) | lowered) & 0x8080808080808080;
  return above_nine == 0 ? 8 : std::countr_zero(above_nine) / 8;
}

/// Eight digits, the first in the lowest byte, as a number: pairs, then fours, then all.
std::uint64_t value_of_eight(std::uint64_t digits) {
  digits = digits * 10 + (digits >> 8);
  return (((digits & 0x000000FF000000FF) * 0x000F424000000064) +
          (((digits >> 16) & 0x000000FF000000FF) * 0x0000271000000001)) >>
         32;
}

constexpr std::array<std::uint64_t, 9> kShifts{1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};

/// Appends the digits at `at` to the mantissa, eight at a time where the text is long enough; returns where
/// they end. The mantissa is wrong, without harm, beyond 19 digits.
const char* take_digits(const char* at, const char* end, std::uint64_t& mantissa) {
  while (std::endian::native == std::endian::little && end - at >= 8) {
    std::uint64_t chunk = 0;
    std::memcpy(&chunk, at, 8);
    chunk ^= 0x3030303030303030;
    const int count = digits_at_the_front(chunk);
    if (count == 0) return at;
    const std::uint64_t aligned = chunk << (64 - 8 * count);  // leading zeros instead of what follows
    mantissa = mantissa * kShifts[static_cast<std::size_t>(count)] + value_of_eight(aligned);
    at += count;
    if (count < 8) return at;
  }
  while (at < end && is_digit(*at)) mantissa = 10 * mantissa + static_cast<std::uint64_t>(*at++ - '0');
  return at;
}

/// The general way: nan, inf, many digits, far exponents.
const char* parse_slowly(const char* at, const char* end, double& value) {
  if (at < end && *at == '+') ++at;
  const std::from_chars_result result = std::from_chars(at, end, value);
  if (result.ec == std::errc()) return result.ptr;
  if (result.ec != std::errc::result_out_of_range) return nullptr;
  value = 0;  // below the smallest double; above the largest is not a number a run can have
  const std::string_view text(at, static_cast<std::size_t>(result.ptr - at));
  const bool tiny = text.find("e-") != text.npos || text.find("E-") != text.npos;
  return tiny ? result.ptr : nullptr;
}

}  // namespace

// Few digits and a small power of ten, which is what dumps hold, need one rounding (Clinger's fast path): the
// mantissa and the power are exact doubles, and their product or quotient is the nearest double.
const char* parse_number(const char* at, const char* end, double& value) {
  const char* const start = at;
  const bool negative = at < end && *at == '-';
  if (negative) ++at;
  std::uint64_t mantissa = 0;
  const char* const first_digit = at;
  at = take_digits(at, end, mantissa);
  long digits = at - first_digit;
  int exponent = 0;
  if (at < end && *at == '.') {
    const char* const first_decimal = ++at;
    at = take_digits(at, end, mantissa);
    exponent = -static_cast<int>(at - first_decimal);
    digits -= exponent;
  }
  if (digits == 0 || digits > 19) return parse_slowly(start, end, value);
  if (at + 1 < end && (*at == 'e' || *at == 'E')) {
    const char* power = at + 1;
    const bool down = *power == '-';
    if (down || *power == '+') ++power;
    if (power < end && is_digit(*power)) {
      int given = 0;
      for (; power < end && is_digit(*power) && given < 10000; ++power) given = 10 * given + (*power - '0');
      exponent += down ? -given : given;
      at = power;
    }
  }
  if (mantissa > kLargestMantissa || exponent > kLargestExact || exponent < -kLargestExact)
    return parse_slowly(start, end, value);
  const double magnitude = static_cast<double>(mantissa);
  const double scaled = exponent < 0 ? magnitude / kPowers[static_cast<std::size_t>(-exponent)]
                                     : magnitude * kPowers[static_cast<std::size_t>(exponent)];
  value = negative ? -scaled : scaled;
  return at;
}

bool parse_number(std::string_view text, double& value) {
  return !text.empty() &&
         parse_number(text.data(), text.data() + text.size(), value) == text.data() + text.size();
}

bool parse_integer(std::string_view text, std::int64_t& value) {
  const std::from_chars_result result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc() && result.ptr == text.data() + text.size();
}

}  // namespace suffuse::analysis
