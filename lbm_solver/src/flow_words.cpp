#include "suffuse/lbm/flow_words.h"

namespace suffuse::lbm {

std::vector<std::pair<std::string, Precision>> precision_words() {
  return {{"double", Precision::double_precision}, {"float", Precision::float_precision}};
}

std::vector<std::pair<std::string, FaceKind>> face_kind_words() {
  std::vector<std::pair<std::string, FaceKind>> words;
  for (const FaceKind kind :
       {FaceKind::periodic, FaceKind::no_slip, FaceKind::free_slip, FaceKind::velocity, FaceKind::pressure})
    words.emplace_back(name_of(kind), kind);
  return words;
}

}  // namespace suffuse::lbm
