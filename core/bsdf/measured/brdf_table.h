// A BRDF as a table, and the virtual gonioreflectometer that measures one.                     [Lang, sec. 4.2.2.4]
//
// Polar angles are the midpoints of n equal steps from 0 to 90 degrees, azimuths m equal steps of the circle. An
// isotropic table has n x n x m entries, by the polar angles of o and i and the azimuth from o to i. An anisotropic
// table has both azimuths, n x m x n x m. Values are interpolated linearly, and constant beyond the outermost angles.
// The table of a reciprocal function is reciprocal; its energy can differ slightly from that of the function. The file
// format is text:
//
//   etendue-brdf 1
//   # any number of comments
//   isotropic 24 48                    or: anisotropic 12 24
//   0.1 0.1 0.1                        one entry a line: red, green and blue in 1/sr. The azimuth of i varies fastest,
//   ...                                then the polar angle of i, the azimuth of o (if anisotropic), the polar angle of
//   o
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vec.h"
#include "spectrum/rgb.h"

namespace etendue {

class BrdfTable {
 public:
  static constexpr int kMaxPolar = 90, kMaxAzimuths = 360;
  static constexpr size_t kMaxEntries = 4'000'000;

  // Measures f(o, i). A table with more than kMaxEntries entries gets fewer azimuths, then fewer polar angles.
  static BrdfTable measured(const std::function<Rgb(const Vec3&, const Vec3&)>& f, int polar, int azimuths,
                            bool isotropic);
  // Input errors name the file and what is wrong with it.
  static Result<BrdfTable> read(const std::filesystem::path& path);
  // The same for a text; `name` is used in errors.
  static Result<BrdfTable> parse(const std::string& text, const std::string& name);
  Result<void> write(const std::filesystem::path& path) const;

  // Both directions above the surface.
  Rgb f(const Vec3& o, const Vec3& i) const;
  bool isotropic() const { return isotropic_; }
  int azimuths() const { return azimuths_; }
  size_t size() const { return values_.size(); }

 private:
  BrdfTable(int polar, int azimuths, bool isotropic);

  static size_t entry_count(int polar, int azimuths, bool isotropic);

  int polar_ = 1, azimuths_ = 1;
  bool isotropic_ = true;
  std::vector<Rgb> values_;
};

}  // namespace etendue
