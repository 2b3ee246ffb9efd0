#include "suffuse/coupling/methods/drag_laws.h"

#include <algorithm>

#include "averaged/drag/beetstra.h"
#include "averaged/drag/di_felice.h"
#include "averaged/drag/gidaspow.h"
#include "averaged/drag/tang.h"

namespace suffuse::coupling {

namespace {

struct Registered {
  DragLawEntry entry;
  double (*factor)(double solid_fraction, double reynolds);
};

template <class Law>
Registered registered(DragLaw law) {
  return {{law, Law::word, Law::source}, &Law::factor};
}

/// One line a law, in the order of the enumeration.
const std::vector<Registered>& table() {
  static const std::vector<Registered> laws{
      registered<drag::Beetstra>(DragLaw::beetstra),
      registered<drag::DiFelice>(DragLaw::di_felice),
      registered<drag::Gidaspow>(DragLaw::gidaspow),
      registered<drag::Tang>(DragLaw::tang),
  };
  return laws;
}

const Registered& of(DragLaw law) {
  return table()[static_cast<std::size_t>(law)];
}

constexpr double kDensest = 0.75;

}  // namespace

const std::vector<DragLawEntry>& drag_laws() {
  static const std::vector<DragLawEntry> entries = [] {
    std::vector<DragLawEntry> all;
    for (const Registered& law : table()) all.push_back(law.entry);
    return all;
  }();
  return entries;
}

std::string name_of(DragLaw law) {
  return of(law).entry.word;
}

double drag_factor(DragLaw law, double solid_fraction, double reynolds) {
  return of(law).factor(std::clamp(solid_fraction, 0., kDensest), reynolds);
}

double graded_drag_factor(DragLaw law, double solid_fraction, double mean_reynolds, double size_ratio) {
  const double phi = std::clamp(solid_fraction, 0., kDensest), e = 1 - phi, y = size_ratio;
  const double weight = (e * y + phi * y * y + 0.064 * e * y * y * y) / (1 + 0.064 * e);
  const double lone = drag_factor(law, 0, mean_reynolds * y);
  return lone + weight * (drag_factor(law, phi, mean_reynolds) - drag_factor(law, 0, mean_reynolds));
}

}  // namespace suffuse::coupling
