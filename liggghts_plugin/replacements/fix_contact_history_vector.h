#pragma once

#include "fix_contact_history.h"

namespace LAMMPS_NS {

/// LIGGGHTS's store of contact histories, which first asks our pair style to bring home the springs that it
/// keeps in its own order. LIGGGHTS's pair style makes one under the name `contacthistory`.
class FixContactHistoryVector : public FixContactHistory {
 public:
  using FixContactHistory::FixContactHistory;
  void pre_exchange() override;
};

}  // namespace LAMMPS_NS
