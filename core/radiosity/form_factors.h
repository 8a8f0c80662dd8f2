// Form factors between all elements of a scene, and the methods that compute them.      [Lang, sec. 10.1.4, eq. 10.26]
//
//   F_ij = 1 / A_i  integral over A_i, A_j of  V cos cos / (pi r^2)
//
// is the fraction of the power that leaves element i and arrives at element j. Properties [Lang, eq. 10.45, 10.54]:
//
//   reciprocity   A_i F_ij = A_j F_ji
//   closure       the sum of F_ij over j is 1 in a closed scene, and less if light escapes
//
// A method estimates the row of one element at a time. FormFactorAssembly combines the two estimates of every pair, so
// that reciprocity holds exactly, and then scales the result symmetrically [Knight et al. 2014]: rows whose estimates add
// up to 1 or more, as in a closed room, get the sum 1, and all others at most 1.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "radiosity/patch_mesh.h"
#include "sampling/sampler.h"

namespace etendue::radiosity {

struct FormFactor {
  uint32_t element;
  float value;
};
using FormFactorRow = std::vector<FormFactor>;  // by element, without zeros

// Collects the factors of one row. Has an accumulator per element; reused by the rows of one thread.
class RowBuilder {
 public:
  void begin(size_t elements);
  void add(uint32_t element, double value) {
    if (sums_[element] == 0) touched_.push_back(element);
    sums_[element] += value;
  }
  // Returns the row and removes it.
  FormFactorRow finish();

  static constexpr size_t kBytesPerElement = sizeof(double) + sizeof(uint32_t);

 private:
  std::vector<double> sums_;
  std::vector<uint32_t> touched_;
};

// One line per method: the identifier, the name in commands and files, and the label.
// clang-format off
#define ETENDUE_FORM_FACTOR_METHODS(ENTRY)                             \
  ENTRY(hemisphere, "hemisphere", "Hemisphere sampling")               \
  ENTRY(nusselt, "nusselt", "Nusselt's analogue")                      \
  ENTRY(hemicube, "hemicube", "Hemicube")                              \
  ENTRY(area_sampling, "area", "Area-to-area Monte Carlo")             \
  ENTRY(point_to_polygon, "point-polygon", "Points to polygon")        \
  ENTRY(contour_integration, "contour", "Contour integration")
// clang-format on

#define ETENDUE_METHOD_ENUMERATOR(ID, NAME, LABEL) ID,
enum class FormFactorMethod : uint8_t { ETENDUE_FORM_FACTOR_METHODS(ETENDUE_METHOD_ENUMERATOR) };
#undef ETENDUE_METHOD_ENUMERATOR

struct RowRequest {
  const scene::CompiledScene& scene;
  const PatchMesh& mesh;
  const Sampler& sampler;
  uint32_t element;
  uint32_t samples;  // see FormFactorMethodInfo
  uint64_t seed;
  RowBuilder& row;
};

struct FormFactorMethodInfo {
  const char* doc;  // the method; its accuracy; its cost
  // Whether `samples` counts rays per pair of elements, not per element.
  bool samples_pairs;
  // Adds the factors of the element and returns the number of rays.
  uint64_t (*add_row)(const RowRequest& request);
};
const FormFactorMethodInfo& info_of(FormFactorMethod method);

struct FormFactorSettings {
  FormFactorMethod method = FormFactorMethod::hemisphere;
  uint32_t samples = 256;
  friend bool operator==(const FormFactorSettings&, const FormFactorSettings&) = default;
};

class FormFactors {
 public:
  // How well the estimated rows satisfy the properties. Elements that see no other element are left out.
  struct Quality {
    double mean_closure = 0;  // area-weighted mean of the row sums
    double least_closure = 0, most_closure = 0;
    double asymmetry = 0;  // sum of |A_i F_ij - A_j F_ji| over the sum of A_i F_ij + A_j F_ji, of the estimated rows
    double scaling_error = 0;  // largest difference of a row sum to the required one after scaling
  };
  // The same of one row.
  struct RowQuality {
    float closure = 0, asymmetry = 0;
  };

  FormFactors() = default;
  FormFactors(FormFactors&&) = default;
  FormFactors& operator=(FormFactors&&) = default;
  // `areas` has the area of every element. Runs all steps of a FormFactorAssembly.
  FormFactors(std::vector<FormFactorRow> rows, std::vector<double> areas);

  size_t size() const { return areas_.size(); }
  const std::vector<double>& areas() const { return areas_; }
  // The factors of row i: A_i F_ij with column j.
  std::span<const FormFactor> exchanges(size_t i) const { return rows_[i]; }
  double factor(size_t i, size_t j) const;
  // The sum of F_ij x_j over j.
  double row_times(size_t i, std::span<const double> x) const {
    double sum = 0;
    for (const FormFactor& f : exchanges(i)) sum += static_cast<double>(f.value) * x[f.element];
    return sum / areas_[i];
  }
  double closure(size_t i) const;

  const Quality& quality() const { return quality_; }
  const std::vector<RowQuality>& row_quality() const { return row_quality_; }  // by element
  size_t memory() const;

 private:
  friend class FormFactorAssembly;

  std::vector<double> areas_;
  std::vector<std::vector<FormFactor>> blocks_;  // the rows of consecutive elements
  std::vector<std::span<FormFactor>> rows_;      // parts of the blocks
  std::vector<RowQuality> row_quality_;
  Quality quality_;
};

// The areas of all elements.
std::vector<double> element_areas(const PatchMesh& mesh);

}  // namespace etendue::radiosity

#define ETENDUE_METHOD_OPTION(ID, NAME, LABEL) etendue::Option{NAME, LABEL},
template <>
struct etendue::Options<etendue::radiosity::FormFactorMethod> {
  static constexpr std::array kOptions{ETENDUE_FORM_FACTOR_METHODS(ETENDUE_METHOD_OPTION)};
};
#undef ETENDUE_METHOD_OPTION
