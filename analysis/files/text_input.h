#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace suffuse::analysis {

/// Throws UserError for a device in a file's place: it may never end.
void require_an_end(const std::string& path, const std::string& who);

/// A text file, plain or gzip (told by its first bytes), read line by line through one large buffer.
class TextInput {
 public:
  /// Throws UserError where the file cannot be read; `who` begins the message.
  TextInput(std::string path, std::string who);
  ~TextInput();
  TextInput(const TextInput&) = delete;
  TextInput& operator=(const TextInput&) = delete;

  /// The next line without its end (also without a carriage return), valid until the next call. False at the
  /// end of the file. Throws UserError where a gzip file is cut short or damaged.
  bool next_line(std::string_view& line);
  /// False where the file ended before the last line did.
  bool line_has_end() const { return line_has_end_; }
  std::int64_t line_number() const { return line_number_; }
  const std::string& path() const { return path_; }
  /// Bytes taken from the disk so far, and the file's size.
  std::int64_t bytes_read() const;
  std::int64_t bytes() const { return bytes_; }
  bool is_compressed() const;

 private:
  struct Source;
  bool fill();

  std::string path_, who_;
  std::unique_ptr<Source> source_;
  std::size_t block_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;
  std::int64_t line_number_ = 0, bytes_ = 0;
  bool ended_ = false, line_has_end_ = true;
};

}  // namespace suffuse::analysis
