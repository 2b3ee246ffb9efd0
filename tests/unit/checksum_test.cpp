// Saved states, restart records and studies carry these sums: another value would make them unreadable.

#include "suffuse/common/checksum.h"

#include <catch2/catch.hpp>
#include <string>

#include "suffuse/common/script_variables.h"

using namespace suffuse;

TEST_CASE("a checksum is FNV-1a of 64 bits") {
  // Test vectors of its authors (isthe.com/chongo/tech/comp/fnv).
  CHECK(checksum_of("") == 0xcbf29ce484222325);
  CHECK(checksum_of("a") == 0xaf63dc4c8601ec8c);
  CHECK(checksum_of("foobar") == 0x85944171f73967e8);
  CHECK(fingerprint_of("foobar") == "85944171f73967e8");
}

TEST_CASE("the sum of a file goes by words of eight bytes, in blocks of any whole number of them") {
  const std::string bytes = "the quick brown fox jumps over the lazy dog";
  Checksum at_once, in_blocks;
  at_once.add_block(bytes.data(), bytes.size());
  in_blocks.add_block(bytes.data(), 16);
  in_blocks.add_block(bytes.data() + 16, bytes.size() - 16);
  CHECK(at_once.value() == in_blocks.value());
  CHECK(at_once.value() == 0xb85e32d1a89907b5);
  Checksum other;
  other.add_block(bytes.data(), bytes.size() - 1);
  CHECK(other.value() != at_once.value());
}
