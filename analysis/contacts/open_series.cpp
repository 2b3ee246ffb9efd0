#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "contacts/dump_series.h"
#include "contacts/hdf5_series.h"
#include "contacts/snapshot.h"
#include "files/file_pattern.h"
#include "suffuse/common/error.h"
#include "suffuse/common/paths.h"

namespace suffuse::analysis {
namespace {

/// A dump file by its first snapshot.
struct FoundDump {
  std::int64_t first_step = 0;
  std::string path;
};

/// Names as people count: "d_20" before "d_100".
bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      const auto number = [&](const std::string& text, std::size_t& at) {
        while (at + 1 < text.size() && text[at] == '0' && digit(text[at + 1])) ++at;
        const std::size_t start = at;
        while (at < text.size() && digit(text[at])) ++at;
        return text.substr(start, at - start);
      };
      const std::string m = number(a, i), n = number(b, j);
      if (m.size() != n.size()) return m.size() < n.size();
      if (m != n) return m < n;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  return a.size() - i < b.size() - j;
}

std::vector<std::string> expanded(const std::vector<std::string>& patterns, const std::string& who) {
  std::vector<std::string> paths;
  for (const std::string& pattern : patterns) {
    const std::vector<std::string> found = files_of_pattern(pattern);
    if (found.empty())
      throw_user_error({who, "files", pattern, "match a file", "check the folder and the pattern"});
    paths.insert(paths.end(), found.begin(), found.end());
  }
  return paths;
}

std::vector<std::string> in_order(std::vector<FoundDump> dumps) {
  std::sort(dumps.begin(), dumps.end(), [](const FoundDump& a, const FoundDump& b) {
    return a.first_step != b.first_step ? a.first_step < b.first_step : natural_less(a.path, b.path);
  });
  std::vector<std::string> paths;
  for (FoundDump& dump : dumps) paths.push_back(std::move(dump.path));
  return paths;
}

}  // namespace

std::unique_ptr<SnapshotSeries> open_series(const std::vector<std::string>& files,
                                            const ReadSettings& settings) {
  const std::vector<std::string> paths = expanded(files, settings.who);
  std::vector<FoundDump> grains, contacts;
  std::int64_t bytes = 0;
  for (const std::string& path : paths) {
    if (is_file(path) && Hdf5Series::is_hdf5(path)) {
      if (paths.size() > 1)
        throw_user_error(
            {settings.who, "files", path, "be the only one, as an HDF5 file", "give each run by itself"});
      if (!settings.columns.empty() || !settings.contact_words.empty())
        throw_user_error({settings.who, "files", path, "be dumps for --column and --pair-values",
                          "leave these out: in an HDF5 file quantities have their names"});
      return std::make_unique<Hdf5Series>(path, settings);
    }
    DumpFile file(path, settings.who);
    DumpHeader header;
    if (!file.next(header)) file.complain("the file is empty", "leave it out");
    bytes += file.input().bytes();
    (header.kind == DumpHeader::Kind::grains ? grains : contacts).push_back({header.step, path});
  }
  const auto need = [&](const std::vector<FoundDump>& dumps, const char* what, const char* remedy) {
    if (dumps.empty()) throw UserError(fmt::format("{}: no file has {}; {}", settings.who, what, remedy));
  };
  need(grains, "grains", "give the dump of the grains too: dump … custom … id radius x y z");
  need(contacts, "contacts", "give the dump of the contacts too: dump … local … of compute pair/gran/local");
  return std::make_unique<DumpSeries>(in_order(std::move(grains)), in_order(std::move(contacts)), settings,
                                      bytes);
}

}  // namespace suffuse::analysis
