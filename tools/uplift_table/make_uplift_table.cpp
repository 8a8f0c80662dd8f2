// Writes the source file of the table of core/spectrum/uplift_table.h: make_uplift_table FILE
#include <cstdio>
#include <vector>

#include "sigmoid_fit.h"
#include "spectrum/uplift_table.h"

namespace etendue {
namespace {

class TableMaker {
 public:
  TableMaker() : table_(uplift::kTableSize) {
    for (size_t largest = 0; largest < 3; ++largest)
      for (size_t y = 0; y < uplift::kRatios; ++y)
        for (size_t x = 0; x < uplift::kRatios; ++x) fill_column(largest, y, x);
  }

  const std::vector<float>& table() const { return table_; }

 private:
  // All values of the largest component, from the middle towards dark and bright, each from the solution before.
  void fill_column(size_t largest, size_t y, size_t x) {
    Coefficients c{};
    fill(largest, uplift::kScales / 2, y, x, c);
    const Coefficients middle = c;
    for (size_t z = uplift::kScales / 2 + 1; z < uplift::kScales; ++z) fill(largest, z, y, x, c);
    c = middle;
    for (size_t z = uplift::kScales / 2; z-- > 0;) fill(largest, z, y, x, c);
  }
  void fill(size_t largest, size_t z, size_t y, size_t x, Coefficients& c) {
    constexpr double kDarkest = 1e-6;
    const double scale = std::max(uplift::scale_at(z), kDarkest);
    Coefficients color{};
    color[largest] = scale;
    color[(largest + 1) % 3] = scale * static_cast<double>(x) / (uplift::kRatios - 1);
    color[(largest + 2) % 3] = scale * static_cast<double>(y) / (uplift::kRatios - 1);
    fit_.fit(color, c);
    float* node = &table_[uplift::table_index(largest, z, y, x)];
    for (size_t k = 0; k < 3; ++k) node[k] = static_cast<float>(c[k]);
  }

  SigmoidFit fit_;
  std::vector<float> table_;
};

bool write_table(const char* path) {
  std::FILE* file = std::fopen(path, "w");
  if (!file) return false;
  std::fprintf(file, "#include \"spectrum/uplift_table.h\"\n\n");
  std::fprintf(file, "alignas(16) const float etendue::uplift::kTable[etendue::uplift::kTableSize]{\n");
  const TableMaker maker;
  for (size_t i = 0; i < maker.table().size(); ++i)
    std::fprintf(file, "%.8ef,%c", static_cast<double>(maker.table()[i]), i % 4 == 3 ? '\n' : ' ');
  std::fprintf(file, "};\n");
  return std::fclose(file) == 0;
}

}  // namespace
}  // namespace etendue

int main(int count, char** arguments) {
  if (count == 2 && etendue::write_table(arguments[1])) return 0;
  std::fprintf(stderr, "make_uplift_table: give the path of a file that can be written\n");
  return 1;
}
