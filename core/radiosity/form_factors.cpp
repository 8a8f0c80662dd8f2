#include "radiosity/form_factors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace etendue::radiosity {

#define ETENDUE_METHOD_DECLARATION(ID, NAME, LABEL) FormFactorMethodInfo ID##_method();
ETENDUE_FORM_FACTOR_METHODS(ETENDUE_METHOD_DECLARATION)
#undef ETENDUE_METHOD_DECLARATION

const FormFactorMethodInfo& info_of(FormFactorMethod method) {
#define ETENDUE_METHOD_INFO(ID, NAME, LABEL) ID##_method(),
  static const std::array infos{ETENDUE_FORM_FACTOR_METHODS(ETENDUE_METHOD_INFO)};
#undef ETENDUE_METHOD_INFO
  return infos[static_cast<size_t>(method)];
}

void RowBuilder::begin(size_t elements) {
  sums_.resize(elements, 0);
  touched_.clear();
}

FormFactorRow RowBuilder::finish() {
  std::ranges::sort(touched_);
  FormFactorRow row;
  row.reserve(touched_.size());
  for (const uint32_t element : touched_) {
    if (sums_[element] > 0) row.push_back({element, static_cast<float>(sums_[element])});
    sums_[element] = 0;
  }
  return row;
}

double FormFactors::factor(size_t i, size_t j) const {
  const auto row = exchanges(i);
  const auto found = std::ranges::lower_bound(row, static_cast<uint32_t>(j), {}, &FormFactor::element);
  return found != row.end() && found->element == j ? static_cast<double>(found->value) / areas_[i] : 0;
}

double FormFactors::closure(size_t i) const {
  double sum = 0;
  for (const FormFactor& f : exchanges(i)) sum += static_cast<double>(f.value);
  return sum / areas_[i];
}

size_t FormFactors::memory() const {
  size_t bytes = areas_.capacity() * sizeof(double) + rows_.capacity() * sizeof(rows_[0]) +
                 row_quality_.capacity() * sizeof(RowQuality) + blocks_.capacity() * sizeof(blocks_[0]);
  for (const auto& block : blocks_) bytes += block.capacity() * sizeof(FormFactor);
  return bytes;
}

std::vector<double> element_areas(const PatchMesh& mesh) {
  std::vector<double> areas;
  areas.reserve(mesh.element_count());
  for (const Patch& p : mesh.patches()) areas.insert(areas.end(), 2, static_cast<double>(p.area));
  return areas;
}

}  // namespace etendue::radiosity
