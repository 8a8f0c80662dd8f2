// Spectra of light: values, colours, files and bad input.
#include "spectrum/spectrum_names.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

namespace etendue {
namespace {

std::string error_of(std::vector<Spectrum::Sample> samples) {
  const auto spectrum = Spectrum::piecewise_linear(std::move(samples));
  return spectrum ? "" : spectrum.error().message;
}

TEST(Spectrum, IsLinearBetweenSamples) {
  const Spectrum s = *Spectrum::piecewise_linear({{400, 1}, {500, 3}, {600, 0}});
  EXPECT_DOUBLE_EQ(s(400), 1);
  EXPECT_DOUBLE_EQ(s(450), 2);
  EXPECT_DOUBLE_EQ(s(575), 0.75);
  EXPECT_DOUBLE_EQ(s(600), 0);
  EXPECT_EQ(s(399), 0);
  EXPECT_EQ(s(601), 0);
}

TEST(Spectrum, BadSamplesAreErrors) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of({{400, 1}}).find("fewer than two"), std::string::npos);
  EXPECT_NE(error_of({{400, 1}, {400, 2}}).find("sample 2, 400 nm: the wavelength occurs twice"), std::string::npos);
  EXPECT_NE(error_of({{500, 1}, {400, 2}}).find("sort by wavelength"), std::string::npos);
  EXPECT_NE(error_of({{400, 1}, {500, -2}}).find("sample 2, 500 nm: the value -2 is negative"), std::string::npos);
  EXPECT_NE(error_of({{400, 1}, {500, kNan}}).find("not a finite number"), std::string::npos);
  EXPECT_NE(error_of({{kNan, 1}, {500, 1}}).find("the wavelength has to be a finite number"), std::string::npos);
  EXPECT_FALSE(Spectrum::blackbody(0));
  EXPECT_FALSE(Spectrum::blackbody(kNan));
}

TEST(Spectrum, IlluminantsHaveThePublishedEfficacy) {
  for (const Illuminant& illuminant : illuminants()) {
    const Spectrum spectrum = illuminant.make();
    EXPECT_NEAR(spectrum.rgb()[0] * 0.2126729 + spectrum.rgb()[1] * 0.7151522 + spectrum.rgb()[2] * 0.0721750, 1, 1e-3)
        << illuminant.name;
  }
  // 683 lm/W times the integral of V(lambda) over the 400 nm of the visible part.
  EXPECT_NEAR(Spectrum::constant(2).luminous_efficacy(), 683 * 106.857 / 400, 0.05);
  EXPECT_EQ(Spectrum::constant(0).luminous_efficacy(), 0);
}

class SpectrumFile : public testing::Test {
 protected:
  std::string written(const std::string& text) {
    std::ofstream(path_) << text;
    return path_.string();
  }
  void TearDown() override { std::filesystem::remove(path_); }
  std::filesystem::path path_ = std::filesystem::temp_directory_path() / "etendue-spectrum-test.csv";
};

TEST_F(SpectrumFile, IsRead) {
  const auto spectrum = read_spectrum(written("# a bulb\nwavelength_nm,power\n400,1\r\n\n500 3\n"));
  ASSERT_TRUE(spectrum) << spectrum.error().message;
  EXPECT_DOUBLE_EQ((*spectrum)(450), 2);
}

TEST_F(SpectrumFile, ErrorsNameFileAndRow) {
  const auto message = [&](const std::string& text) {
    const auto spectrum = read_spectrum(written(text));
    return spectrum ? "" : spectrum.error().message;
  };
  EXPECT_NE(message("400,1\n500,x\n").find("row 2 is not a wavelength and a value"), std::string::npos);
  EXPECT_NE(message("a\nb\n400,1\n").find("row 2"), std::string::npos);
  EXPECT_NE(message("400,1\n400,1\n").find("occurs twice"), std::string::npos);
  EXPECT_NE(message("400,nan\n500,1\n").find("not a finite number"), std::string::npos);
  EXPECT_NE(message("").find("fewer than two"), std::string::npos);
  EXPECT_NE(message("400,1\n400,1\n").find(path_.string()), std::string::npos);
  EXPECT_FALSE(read_spectrum("/nonexistent/spectrum.csv"));
}

}  // namespace
}  // namespace etendue
