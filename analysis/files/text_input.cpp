#include "files/text_input.h"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "suffuse/common/error.h"
#include "suffuse/common/paths.h"

namespace suffuse::analysis {
namespace {

// Bytes that are read at a time; fewer of a small file, as a series may have thousands of them.
constexpr std::size_t kBlock = std::size_t{1} << 20, kSmallestBlock = std::size_t{1} << 14;

}  // namespace

void require_an_end(const std::string& path, const std::string& who) {
  std::error_code ignored;
  if (std::filesystem::is_character_file(path, ignored) || std::filesystem::is_block_file(path, ignored))
    throw_user_error({who, "file", path, "be a file", "this is a device, which may have no end"});
}

/// Plain files are read directly, gzip ones through zlib.
struct TextInput::Source {
  int descriptor = -1;
  gzFile gzip = nullptr;
  std::int64_t taken = 0;

  ~Source() {
    if (gzip != nullptr)
      gzclose(gzip);  // closes the descriptor
    else if (descriptor >= 0)
      close(descriptor);
  }
};

TextInput::TextInput(std::string path, std::string who)
    : path_(std::move(path)), who_(std::move(who)), source_(std::make_unique<Source>()), block_(kBlock) {
  source_->descriptor = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  std::error_code ignored;  // a pipe has no size
  if (source_->descriptor < 0 || is_folder(path_))
    throw_user_error({who_, "file", path_, "be readable",
                      source_->descriptor < 0 ? std::strerror(errno) : "this is a folder"});
  require_an_end(path_, who_);
  const auto size = std::filesystem::file_size(path_, ignored);
  bytes_ = ignored ? 0 : static_cast<std::int64_t>(size);
  unsigned char magic[2] = {};
  const bool is_gzip = pread(source_->descriptor, magic, 2, 0) == 2 && magic[0] == 0x1f && magic[1] == 0x8b;
  if (!is_gzip && bytes_ > 0)
    block_ = std::clamp(static_cast<std::size_t>(bytes_) + 1, kSmallestBlock, kBlock);
  buffer_.resize(2 * block_);
  if (!is_gzip) return;
  source_->gzip = gzdopen(source_->descriptor, "rb");
  gzbuffer(source_->gzip, 1 << 18);
}

TextInput::~TextInput() = default;

bool TextInput::fill() {
  if (ended_) return false;
  // What is left of the last line moves to the front; a line longer than the buffer makes it grow.
  const std::size_t left = end_ - begin_;
  std::memmove(buffer_.data(), buffer_.data() + begin_, left);
  begin_ = 0;
  end_ = left;
  if (buffer_.size() - end_ < block_) buffer_.resize(2 * buffer_.size());
  long got = 0;
  if (source_->gzip != nullptr) {
    got = gzread(source_->gzip, buffer_.data() + end_, static_cast<unsigned>(block_));
    int code = Z_OK;
    gzerror(source_->gzip, &code);
    if (got < 0 || (code != Z_OK && code != Z_STREAM_END))
      throw_user_error({who_, "file", path_, "be a whole gzip file",
                        code == Z_BUF_ERROR ? "it is cut short" : "it is damaged"});
  } else {
    got = read(source_->descriptor, buffer_.data() + end_, block_);
    if (got < 0) throw_user_error({who_, "file", path_, "be readable", std::strerror(errno)});
  }
  source_->taken += got;
  end_ += static_cast<std::size_t>(got);
  ended_ = got == 0;
  return got > 0;
}

bool TextInput::next_line(std::string_view& line) {
  std::size_t searched = begin_;
  const char* newline = nullptr;
  for (;;) {
    newline = static_cast<const char*>(std::memchr(buffer_.data() + searched, '\n', end_ - searched));
    if (newline != nullptr) break;
    searched = end_ - begin_;  // after fill() the line begins at 0
    if (!fill()) break;
  }
  if (newline == nullptr && begin_ == end_) return false;
  const std::size_t stop = newline != nullptr ? static_cast<std::size_t>(newline - buffer_.data()) : end_;
  std::size_t length = stop - begin_;
  if (length > 0 && buffer_[begin_ + length - 1] == '\r') --length;
  line = {buffer_.data() + begin_, length};
  line_has_end_ = newline != nullptr;
  begin_ = newline != nullptr ? stop + 1 : end_;
  ++line_number_;
  return true;
}

bool TextInput::is_compressed() const {
  return source_->gzip != nullptr;
}

std::int64_t TextInput::bytes_read() const {
  return source_->gzip != nullptr ? gzoffset(source_->gzip) : source_->taken;
}

}  // namespace suffuse::analysis
