#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace suffuse {

/// Waits until what was written to a file, or to the list of files in a folder, is on the disk. A UserError
/// that `who` begins where the disk does not take it.
void wait_for_disk(const std::string& path, const std::string& who);

/// One name for all that lead to a file: its absolute path, or `path` as it stands where that cannot be found
/// out. Whether it can be written is another question.
std::string one_name_of(const std::string& path);

/// A UserError that `who` begins where the file cannot be written. Leaves none behind, and one that is there
/// as it is.
void require_writable(const std::string& path, const std::string& who);

/// A UserError that `who` begins where a new file could not take the place of what is there: of a folder, a
/// device, a pipe.
void require_replaceable(const std::string& path, const std::string& who);

/// Puts aside what an earlier run left under this name: a regular file becomes PATH.before (in place of one
/// of that name); a link leads on to where it led. Gives the new name, or nothing where there was no such
/// file.
std::optional<std::string> keep_earlier(const std::string& path, const std::string& who);

/// A text file that appears under its name only when it is complete: what is written goes to `PATH.part`,
/// commit() renames it, and without commit() (an error on the way) it is removed.
class SafeFile {
 public:
  /// Throws UserError where the file cannot be made; `who` begins the message ("contacts --output").
  SafeFile(std::string path, std::string who);
  ~SafeFile();
  SafeFile(const SafeFile&) = delete;
  SafeFile& operator=(const SafeFile&) = delete;

  void write(std::string_view text);
  /// Closes, waits for the disk and renames. Throws UserError if the disk is full or the name cannot be
  /// taken.
  void commit();
  const std::string& path() const { return path_; }

 private:
  std::string path_, part_, who_;
  std::ofstream stream_;
  bool committed_ = false;
};

}  // namespace suffuse
