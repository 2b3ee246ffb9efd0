#include "suffuse/common/xdmf_series.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "suffuse/common/collective_text.h"
#include "suffuse/common/safe_file.h"

namespace suffuse {

namespace {

constexpr std::string_view kEnd = "    </Grid>\n  </Domain>\n</Xdmf>\n";

/// The file without its end; nothing where it has another length.
std::optional<std::string> beginning_of(const std::string& path, std::uint64_t length) {
  std::ifstream file(path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file || length < kEnd.size() || text.size() != length) return std::nullopt;
  text.resize(text.size() - kEnd.size());
  return text;
}

}  // namespace

void XdmfSeries::write(std::string_view grids, MPI_Comm communicator) {
  const std::string text = fmt::format(
      "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"2.0\">\n  <Domain>\n    <Grid Name=\"{}\" "
      "GridType=\"Collection\" CollectionType=\"Temporal\">\n{}{}",
      name_, grids, kEnd);
  length_ = 0;
  write_text(path_, "output of " + name_, text, communicator);
  length_ = text.size();
}

bool XdmfSeries::add(std::string_view grids, MPI_Comm communicator) {
  const std::string who = "output of " + name_;
  int added = 0;
  on_first_rank(who, communicator, [&] {
    const auto text = beginning_of(path_, std::exchange(length_, 0));
    if (!text) return;
    SafeFile file(path_, who);
    for (const std::string_view part : {std::string_view(*text), grids, kEnd}) file.write(part);
    file.commit();
    length_ = text->size() + grids.size() + kEnd.size();
    added = 1;
  });
  MPI_Bcast(&added, 1, MPI_INT, 0, communicator);
  return added == 1;
}

}  // namespace suffuse
