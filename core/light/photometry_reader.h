// Reads photometric files of IES LM-63.                                                              [IES LM-63-2002]
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"
#include "light/photometry_profile.h"

namespace etendue {

// Input errors name the file, the line and what would be right. `name` stands for the file. Files with TILT data are
// read from `folder`.
Result<PhotometryProfile> parse_photometry(std::string_view text, const std::string& name,
                                           const std::filesystem::path& folder = {});
Result<PhotometryProfile> read_photometry(const std::filesystem::path& path);

class PhotometryReader {
 public:
  PhotometryReader(std::string_view text, const std::string& name, const std::filesystem::path& folder)
      : text_(text), name_(name), folder_(folder) {}

  Result<PhotometryProfile> read();

 private:
  using Type = PhotometryProfile::Type;
  // Angles in radians that ascend, and one row of `polar` values per azimuth.
  struct Grid {
    std::vector<float> polar, azimuths, values;
  };

  Error error(const std::string& what) const;
  // Moves past the keywords and the TILT data.
  Result<void> read_header();
  Result<void> read_tilt();
  Result<void> read_tilt_file(std::string_view file);
  std::string_view next_line();
  std::string_view next_word();
  Result<double> number(const char* what);
  Result<int> count(const char* what, int largest);
  // Ascending, in degrees.
  Result<std::vector<float>> angles(int count, const char* what);

  Result<Grid> grid_of_type_c(const std::vector<float>& vertical, const std::vector<float>& horizontal,
                              const std::vector<float>& values) const;
  Grid grid_of_type_b(std::vector<float> vertical, const std::vector<float>& horizontal,
                      const std::vector<float>& values) const;
  Grid grid_of_type_a(const std::vector<float>& vertical, const std::vector<float>& horizontal,
                      const std::vector<float>& values) const;

  std::string_view text_;
  const std::string& name_;
  const std::filesystem::path& folder_;
  std::vector<float> tilt_angles_, tilt_factors_;  // radians
  bool has_photometric_factor_ = true;             // the standard of the file defines this factor
  size_t at_ = 0;
  int line_ = 1;
};

}  // namespace etendue
