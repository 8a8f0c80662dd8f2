// Measured and tabulated reflectance: made or read once, shared by all surfaces, kept for good.
//
// A source of a table is the name of a reflection model, with settings after it that are parted by spaces, or the path
// of a table's own text file (brdf_table.h):
//
//   ward alpha-x=0.1 alpha-y=0.1          measured here, its base colour white
//   rgl file=/data/paper_white_rgb.bsdf   measured elsewhere
//   brushed.brdf
//
// What of a model are deltas is left out. A file that changes on disk is read again by the next run of the program.
#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "bsdf/measured/brdf_table.h"
#include "bsdf/measured/direction_table.h"
#include "bsdf/measured/harmonic_brdf.h"
#include "bsdf/measured/merl_brdf.h"
#include "bsdf/measured/rgl_brdf.h"

namespace etendue {

// A function and the directions drawn for it.
template <class Function>
class SampledBrdf {
 public:
  SampledBrdf(Function function, int azimuths, bool coarse)
      : function_(std::move(function)),
        directions_([this](const Vec3& o, const Vec3& i) { return function_.f(o, i); }, azimuths, coarse) {}

  const Function& function() const { return function_; }
  Rgb f(const Vec3& o, const Vec3& i) const { return function_.f(o, i); }
  float density(const Vec3& o, const Vec3& i) const { return directions_.density(o, i); }
  bool sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const {
    return directions_.sample_direction(o, random, i);
  }
  float albedo(const Vec3& o) const { return directions_.albedo(o); }
  float alpha() const { return directions_.alpha(); }

 private:
  Function function_;
  DirectionTable directions_;
};

// No file was named yet.
inline constexpr const char* kNoFile = "none";

// Whether the text can be used; the error says what is wrong with it. A file is read for that.
Result<void> accepts_rgl_file(std::string_view path);
Result<void> accepts_merl_file(std::string_view path);
Result<void> accepts_table_source(std::string_view source);
Result<void> accepts_harmonic_source(std::string_view source);

// Null where the text cannot be used.
const RglBrdf* rgl_data(const std::string& path);
const SampledBrdf<MerlBrdf>* merl_data(const std::string& path);
// Polar angles and azimuths are those of a model that is measured; a file has its own.
const SampledBrdf<BrdfTable>* table_data(const std::string& source, int polar, int azimuths);
const SampledBrdf<HarmonicBrdf>* harmonic_data(const std::string& source, int bands);

}  // namespace etendue
