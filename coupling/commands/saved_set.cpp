#include "saved_set.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "../liggghts/restart_file.h"
#include "suffuse/common/checksum.h"
#include "suffuse/common/collective_text.h"
#include "suffuse/common/error.h"
#include "suffuse/common/paths.h"
#include "suffuse/common/safe_file.h"

namespace suffuse::coupling {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFluid = "fluid.h5";
constexpr const char* kGrains = "grains";
constexpr const char* kSet = "set";
/// The first line of it: raised with its layout.
constexpr const char* kVersion = "suffuse state, version 2\n";
constexpr std::string_view kAnyVersion = "suffuse state";

std::string folder(const std::string& file, int n) {
  return fmt::format("{}.{}", file, n);
}

/// Of the name itself, not of what it links to; none where it cannot be one.
fs::file_status own_status(const std::string& path) {
  std::error_code ignored;
  return fs::symlink_status(path, ignored);
}

/// 1 or 2 if FILE is a link to such a folder, whether it is there or not.
std::optional<int> last_of(const std::string& file) {
  if (!fs::is_symlink(own_status(file))) return std::nullopt;
  const std::string target = fs::read_symlink(file).string();
  for (const int n : {1, 2})
    if (target == fs::path(folder(file, n)).filename()) return n;
  return std::nullopt;
}

/// Is the name taken, if only by a link to nothing?
bool is_taken(const std::string& path) {
  return fs::exists(own_status(path));
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Is it a folder with a state or a part of one in it, and nothing else?
bool holds_only_a_state(const fs::path& folder) {
  if (!fs::is_directory(own_status(folder.string()))) return false;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    const std::string whole = (name.extension() == ".part" ? name.stem() : name).string();
    // MPI's files beside the fluid's, too, which a killed run leaves
    if (!whole.starts_with(kFluid) && whole != kGrains && whole != kSet) return false;
  }
  const std::string set = text_of(folder / kSet);
  return set.empty() || set.starts_with(kAnyVersion);
}

void require_free(const std::string& file, const std::string& who) {
  const std::string grains = file + ".grains";
  const bool ours = last_of(file).has_value();
  if ((is_taken(file) && !ours) || (is_taken(grains) && !fs::is_symlink(own_status(grains))))
    throw_user_error({who, "file", file, "be a name that is free, or of states that this command wrote",
                      "take another name, or move what is there away"});
  for (const std::string& part : {folder(file, 1), folder(file, 2), file + ".new"}) {
    if (!is_taken(part)) continue;
    if (!holds_only_a_state(part))
      throw_user_error({who, "file", file,
                        "be a name of which " + part + " is free: states are written there",
                        "take another name, or move what is there away"});
    if (!ours && part != file + ".new" && is_taken((fs::path(part) / kSet).string()))
      throw_user_error({who, "file", file,
                        fmt::format("be the link to the states {} and {}", folder(file, 1), folder(file, 2)),
                        fmt::format("it was moved or removed: remove these folders as well, or `ln -s {} {}`",
                                    fs::path(part).filename().string(), file)});
  }
  const fs::path place = fs::path(file).parent_path();
  if (const std::string at = place.empty() ? "." : place.string();
      !is_folder(at) || access(at.c_str(), W_OK) != 0)
    throw_user_error({who, "file", file, "be writable", "check its folder"});
}

/// Makes `link` point to `target`, in one step for whoever looks.
void set_link(const std::string& target, const std::string& link) {
  const std::string fresh = link + ".link";
  fs::remove(fresh);
  fs::create_symlink(target, fresh);
  fs::rename(fresh, link);
}

std::uint64_t sum_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<char> block(1 << 20);
  Checksum sum;
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0)
    sum.add_block(block.data(), static_cast<std::size_t>(file.gcount()));
  return sum.value();
}

/// What `set` says of the files beside it.
std::string contents(const fs::path& set) {
  std::string text = kVersion;
  for (const char* name : {kFluid, kGrains})
    if (const fs::path file = set / name; is_there(file.string()))
      text += fmt::format("{} {} bytes, sum {:016x}\n", name, fs::file_size(file), sum_of(file.string()));
  return text;
}

void require_whole(const std::string& who, const std::string& file, const fs::path& set) {
  const bool there = is_file(set / kGrains) && is_file(set / kSet);
  const std::string said = there ? text_of(set / kSet) : "";
  if (there && said == contents(set)) return;
  if (said.starts_with(kAnyVersion) && !said.starts_with(kVersion))
    throw_user_error({who, "file", file, "be a state of version 2, not of " + said.substr(0, said.find('\n')),
                      "read it with the version of suffuse that wrote it"});
  throw_user_error({who, "file", file, "be whole, as it was saved",
                    "it is damaged or unfinished; the state before it is in the folder NAME.1 or NAME.2"});
}

}  // namespace

void require_free_for_sets(const std::string& file, const std::string& who, MPI_Comm communicator) {
  on_first_rank(who, communicator, [&] { require_free(file, who); });
}

NewSet begin_set(const std::string& file, const std::string& who, MPI_Comm communicator) {
  const std::string fresh = file + ".new";
  on_first_rank(who, communicator, [&] {
    require_free(file, who);
    fs::remove_all(fresh);
    fs::create_directory(fresh);
  });
  return {fresh + "/" + kFluid, fresh + "/" + kGrains};
}

void finish_set(const std::string& file, const std::string& who, MPI_Comm communicator) {
  on_first_rank(who, communicator, [&] {
    const std::string fresh = file + ".new";
    if (is_there(fresh + "/" + kFluid)) wait_for_disk(fresh + "/" + kFluid, who);
    SafeFile set(fresh + "/" + kSet, who);
    set.write(contents(fresh));
    set.commit();
    wait_for_disk(fresh, who);
    const std::string next = folder(file, 3 - last_of(file).value_or(2));
    const std::string target = fs::path(next).filename().string();
    if (!last_of(file)) set_link(target, file);  // before there is a state that nothing would lead to
    fs::remove_all(next);
    fs::rename(fresh, next);
    set_link(target, file);
    if (const std::string grains = file + ".grains"; !is_taken(grains))
      set_link((fs::path(file).filename() / kGrains).string(), grains);
    const fs::path place = fs::path(file).parent_path();
    wait_for_disk(place.empty() ? "." : place.string(), who);
  });
}

std::string fluid_of_set(const std::string& file) {
  if (is_folder(file)) {
    require_whole("lbm restart read", file, file);
    if (!is_there((fs::path(file) / kFluid).string()))
      throw_user_error({"lbm restart read", "file", file, "have water in it",
                        "it was saved by `restart_set` of a dry scene; leave the line out"});
    return (fs::path(file) / kFluid).string();
  }
  if (!is_file(file))
    throw_user_error(
        {"lbm restart read", "file", file, "be a state that `lbm restart write` saved", "check the path"});
  return file;
}

void require_whole_restart_file(const std::string& file) {
  std::error_code ignored;
  const fs::path real = fs::canonical(file, ignored);
  if (ignored || !is_file(real)) return;  // LIGGGHTS says that it is not there
  if (real.filename() == kGrains && is_there(real.parent_path() / kSet)) {
    require_whole("read_restart", file, real.parent_path());
    return;
  }
  if (!is_whole_restart_file(real.string()))
    throw_user_error({"read_restart", "file", file, "be a whole restart file of LIGGGHTS",
                      "it is damaged, or its disk was full; take an older one"});
}

void write_checked(int from, const std::string& path, const std::string& who) {
  const int to = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  int problem = to < 0 ? errno : 0;
  std::vector<char> block(1 << 20);
  off_t at = 0;
  while (problem == 0) {
    const ssize_t got = pread(from, block.data(), block.size(), at);
    if (got < 0) problem = errno;
    if (got <= 0) break;
    for (ssize_t done = 0; done < got && problem == 0;) {
      const ssize_t put = write(to, block.data() + done, static_cast<std::size_t>(got - done));
      if (put < 0 && errno != EINTR) problem = errno;
      if (put > 0) done += put;
    }
    at += got;
  }
  if (to >= 0 && fsync(to) != 0 && problem == 0 && errno != EINVAL) problem = errno;
  if (to >= 0 && close(to) != 0 && problem == 0) problem = errno;
  if (problem != 0)
    throw_user_error({who, "file", path, "take what is written",
                      std::generic_category().message(problem) + "; what was saved before is whole"});
}

}  // namespace suffuse::coupling
