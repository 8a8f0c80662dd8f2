// A reflectance function as a table, and the virtual gonioreflectometer that makes one.    thesis 4.2.2.4, item 45
//
// Polar angles are at the middles of n equal steps from 0 to 90 degrees, azimuths at m equal steps of the circle. An
// isotropic table has n x n x m entries, by the polar angles of o and i and the azimuth from o to i; another has both
// azimuths, n x m x n x m. Between them it is linear, beyond the outermost angles constant. A table of a reciprocal
// function stays reciprocal; energy may be a little more or less than the function's. As a text:
//
//   etendue-brdf 1
//   # any number of comments
//   isotropic 24 48                    or: anisotropic 12 24
//   0.1 0.1 0.1                        one entry a line, red, green and blue in 1/sr; the azimuth of i runs fastest,
//   ...                                then the polar angle of i, the azimuth of o if there is one, the polar angle of
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
  static constexpr int kMostPolar = 90, kMostAzimuths = 360;
  static constexpr size_t kMostEntries = 4'000'000;

  // Measures f(o, i). A table that would have too many entries gets fewer azimuths and then fewer polar angles.
  static BrdfTable measured(const std::function<Rgb(const Vec3&, const Vec3&)>& f, int polar, int azimuths,
                            bool isotropic);
  static Result<BrdfTable> read(const std::filesystem::path& path);
  static Result<BrdfTable> parsed(const std::string& text, const std::string& name);
  Result<void> write(const std::filesystem::path& path) const;

  Rgb f(const Vec3& o, const Vec3& i) const;
  bool isotropic() const { return isotropic_; }
  int azimuths() const { return azimuths_; }
  size_t size() const { return values_.size(); }

 private:
  BrdfTable(int polar, int azimuths, bool isotropic);

  static size_t entries(int polar, int azimuths, bool isotropic);

  int polar_ = 1, azimuths_ = 1;
  bool isotropic_ = true;
  std::vector<Rgb> values_;
};

}  // namespace etendue
