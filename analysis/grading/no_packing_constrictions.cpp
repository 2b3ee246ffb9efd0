// In place of packing_constrictions.cpp where CGAL was not installed when this was built.
#include "grading/packing_constrictions.h"
#include "suffuse/common/error.h"

namespace suffuse::analysis {

PackingConstrictions packing_constrictions(std::span<const Sphere>, const SphereBox&, double) {
  throw_user_error({"constriction", "--packing", "in a program that was built without CGAL",
                    "have its triangulation", "scripts/install_packages packing, configure and build again"});
}

}  // namespace suffuse::analysis
