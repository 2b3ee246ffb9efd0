#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace suffuse {

/// FNV-1a, 64 bits (Fowler, Noll and Vo): tells texts and files apart where they differ by chance,
/// not where someone means them to be alike.
class Checksum {
 public:
  /// Of each byte, as the standard has it.
  void add(std::string_view bytes) {
    for (const char c : bytes) add_word(static_cast<unsigned char>(c));
  }

  void add_word(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3; }

  /// Of words of eight bytes, the last filled up with zeros, each followed by a shift that carries high bits
  /// down: a sum of gigabytes costs little beside their writing. All blocks but the last are whole words.
  void add_block(const char* bytes, std::size_t count) {
    for (std::size_t n = 0; n < count; n += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + n, count - n < sizeof(word) ? count - n : sizeof(word));
      add_word(word);
      value_ ^= value_ >> 32;
    }
  }

  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

inline std::uint64_t checksum_of(std::string_view bytes) {
  Checksum sum;
  sum.add(bytes);
  return sum.value();
}

}  // namespace suffuse
