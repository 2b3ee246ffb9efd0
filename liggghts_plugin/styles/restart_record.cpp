#include "restart_record.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>

#include "suffuse/common/checksum.h"
#include "suffuse/common/error.h"

namespace suffuse {

namespace {

constexpr std::array<char, 8> kMark{'s', 'u', 'f', 'f', 'u', 's', 'e', '\n'};

/// What stands before text and values.
struct Head {
  std::array<char, 8> mark = kMark;
  std::int64_t version = 0, characters = 0, values = 0;
  std::uint64_t sum = 0;
};

std::string body_of(const RestartRecord& record) {
  std::string body = record.text;
  const auto* bytes = reinterpret_cast<const char*>(record.values.data());
  body.append(bytes, record.values.size() * sizeof(double));
  return body;
}

[[noreturn]] void refuse(const std::string& who, const std::string& found, int version) {
  throw_user_error(
      {who, "record in the restart file", found, fmt::format("be of version {} and whole", version),
       "read the restart file with the version of suffuse that wrote it, or leave the fix out of "
       "the reading: give it another ID, and it starts anew"});
}

/// Head and body, as they stand in the file.
std::string bytes_of(const RestartRecord& record) {
  const std::string body = body_of(record);
  Head head;
  head.version = record.version;
  head.characters = static_cast<std::int64_t>(record.text.size());
  head.values = static_cast<std::int64_t>(record.values.size());
  head.sum = checksum_of(body);
  std::string bytes(sizeof(head), 0);
  std::memcpy(bytes.data(), &head, sizeof(head));
  return bytes + body;
}

void write_bytes(FILE* file, const std::string& bytes) {
  const int size = static_cast<int>(bytes.size());
  fwrite(&size, sizeof(size), 1, file);
  fwrite(bytes.data(), 1, bytes.size(), file);
}

}  // namespace

void write_record(FILE* file, const RestartRecord& record) {
  write_bytes(file, bytes_of(record));
}

void write_list(FILE* file, const RestartRecord& record) {
  const auto count = static_cast<double>(record.values.size());
  write_bytes(file, bytes_of({record.version, "", {count}}) + bytes_of(record));
}

RestartRecord read_record(const char* buffer, int version, std::size_t values, const std::string& who) {
  constexpr std::int64_t longest_text = 1 << 16;
  // LIGGGHTS does not say how long the buffer is: nothing is read before the mark has shown that it is there.
  Head head;
  if (std::memcmp(buffer, kMark.data(), kMark.size()) != 0) refuse(who, "without a version", version);
  std::memcpy(&head, buffer, sizeof(head));
  if (head.version != version) refuse(who, fmt::format("version {}", head.version), version);
  if (head.values != static_cast<std::int64_t>(values) || head.characters < 0 ||
      head.characters > longest_text)
    refuse(who, fmt::format("{} values, not {}", head.values, values), version);
  RestartRecord record;
  record.version = version;
  const char* body = buffer + sizeof(head);
  record.text.assign(body, static_cast<std::size_t>(head.characters));
  record.values.resize(values);
  std::memcpy(record.values.data(), body + head.characters, values * sizeof(double));
  if (checksum_of({body, record.text.size() + values * sizeof(double)}) != head.sum)
    refuse(who, "damaged", version);
  return record;
}

RestartRecord read_list(const char* buffer, int version, const std::string& who) {
  constexpr double most = 1 << 28;  // LIGGGHTS counts a record's bytes in an int
  const RestartRecord count = read_record(buffer, version, 1, who);
  if (!count.text.empty() || !(count.values[0] >= 0 && count.values[0] < most))
    refuse(who, fmt::format("{:g} values", count.values[0]), version);
  return read_record(buffer + bytes_of(count).size(), version, static_cast<std::size_t>(count.values[0]),
                     who);
}

}  // namespace suffuse
