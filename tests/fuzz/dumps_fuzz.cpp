// A dump of grains and one of contacts, a byte 1 between them, and what is measured of their snapshots.

#include <algorithm>

#include "contacts/contact_measures.h"
#include "fuzz_input.h"

using namespace suffuse;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  const std::size_t cut = std::min(text.find('\1'), text.size());
  return fuzz::refused_or_read([&] {
    const std::string grains = fuzz::folder().file("grains.dump", text.substr(0, cut));
    const std::string contacts =
        fuzz::folder().file("contacts.dump", cut < text.size() ? text.substr(cut + 1) : std::string_view{});
    const auto series = analysis::open_series({grains, contacts}, {});
    analysis::ContactMeasurer measurer({});
    for (analysis::Snapshot snapshot; series->next(snapshot);) measurer.measure(snapshot);
    series->notes();
  });
}
