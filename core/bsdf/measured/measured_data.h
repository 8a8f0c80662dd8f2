// Measured and tabulated BRDFs: loaded or computed once, shared by all surfaces, kept until the program ends.
//
// The source of a table is the name of a BSDF model with parameters, separated by spaces, or the path of a table file
// (brdf_table.h):
//
//   ward alpha-x=0.1 alpha-y=0.1          measured by the virtual gonioreflectometer with a white base colour
//   rgl file=/data/paper_white_rgb.bsdf   a table of a measured material
//   brushed.brdf                          a table file
//
// Deltas of a model are left out. A file that changes on disk is read again only by another run of the program. All
// functions are thread-safe.
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

// A BRDF with tabulated sampling: the Data of a MeasuredLobe.
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

// The value of a file parameter that names no file.
inline constexpr const char* kNoFile = "none";

// Checks the value of a parameter; the error says what is wrong with it. Files are read.
Result<void> accepts_rgl_file(std::string_view path);
Result<void> accepts_merl_file(std::string_view path);
Result<void> accepts_table_source(std::string_view source);
Result<void> accepts_harmonic_source(std::string_view source);

// The data; null if the value is not accepted or is kNoFile.
const RglBrdf* rgl_data(const std::string& path);
const SampledBrdf<MerlBrdf>* merl_data(const std::string& path);
// The numbers of polar angles and azimuths apply to a model; a file has its own.
const SampledBrdf<BrdfTable>* table_data(const std::string& source, int polar, int azimuths);
const SampledBrdf<HarmonicBrdf>* harmonic_data(const std::string& source, int bands);

}  // namespace etendue
