// Spectra as lists of points: text, errors, and approximation with few points.
#include "spectrum/spectrum_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "medium/coefficient_spectrum.h"
#include "spectrum/emission_spectrum.h"
#include "spectrum/spectrum_names.h"

namespace etendue {
namespace {

TEST(SpectrumPoints, TextIsReadAndWritten) {
  const auto points = parse_points(" 400:0.25 550.5:1,700:2.5e-3\n");
  ASSERT_TRUE(points) << points.error().message;
  ASSERT_EQ(points->size(), 3u);
  EXPECT_EQ((*points)[1].wavelength, 550.5);
  EXPECT_EQ((*points)[2].value, 0.0025);
  EXPECT_EQ(text_of_points(*points), "400:0.25 550.5:1 700:0.0025");
}

TEST(SpectrumPoints, OtherNamesAreNoPoints) {
  for (const char* name : {"2700K", "a", "d65", "bulb.csv", "./400:1.csv", "400", "", "none"})
    EXPECT_FALSE(is_point_list(name)) << name;
  EXPECT_TRUE(is_point_list("400:1 500:2"));
}

TEST(SpectrumPoints, ErrorsNameThePart) {
  const struct {
    const char *text, *part;
  } cases[] = {{"400:1", "two points"},
               {"400:1 500", "'500' is not a point"},
               {"400:1 x:2", "'x:2'"},
               {"400:1 500:2:3", "'500:2:3'"},
               {"400:1 400:2", "occurs twice"},
               {"500:1 400:2", "smaller than that of the sample before"},
               {"400:1 500:-2", "is negative"},
               {"400:1 500:nan", "not a finite number"},
               {"400:1 500:1e999", "'500:1e999'"},
               {"-5:1 500:1", "above 0"}};
  for (const auto& [text, part] : cases) {
    const auto spectrum = spectrum_of_points(text);
    ASSERT_FALSE(spectrum) << text;
    EXPECT_NE(spectrum.error().message.find(part), std::string::npos) << spectrum.error().message;
  }
}

// Points of an illuminant give its colour; a table needs no file.
TEST(SpectrumPoints, StandForEmittersAndCoefficients) {
  const auto flat = find_emission_spectrum("380:2 780:2"), equal = find_emission_spectrum("e");
  ASSERT_TRUE(flat && equal);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR((*flat)->rgb()[c], (*equal)->rgb()[c], 1e-5);
  EXPECT_FALSE(names_spectrum_file("380:2 780:2"));
  EXPECT_FALSE(find_emission_spectrum("900:1 1000:1"));

  const auto absorption = find_coefficient_spectrum(Coefficient::absorption, "400:0.5 600:1.5");
  ASSERT_TRUE(absorption);
  EXPECT_FLOAT_EQ((*absorption)->at(500.0f), 1);
  EXPECT_FLOAT_EQ((*absorption)->at(700.0f), 1.5f);
  EXPECT_FALSE(names_coefficient_file("400:0.5 600:1.5"));
  EXPECT_FALSE(find_coefficient_spectrum(Coefficient::absorption, "400:0.5 600:1e7"));
}

TEST(SpectrumPoints, FewPointsKeepTheToleranceEverywhere) {
  const Spectrum lamp = *find_spectrum("fl2");
  std::vector<Spectrum::Sample> points;
  for (double nm = 380; nm <= 780; nm += 5) points.push_back({nm, lamp(nm)});
  for (const double tolerance : {0.1, 1.0}) {
    const auto few = simplified_points(points, tolerance);
    EXPECT_LT(few.size(), points.size());
    const Spectrum simple = *Spectrum::piecewise_linear(few);
    for (const auto& [nm, value] : points) EXPECT_LE(std::abs(simple(nm) - value), tolerance * (1 + 1e-12)) << nm;
  }
  // A line needs its ends only.
  EXPECT_EQ(simplified_points(std::vector<Spectrum::Sample>{{400, 1}, {500, 2}, {600, 3}}, 1e-9).size(), 2u);
}

}  // namespace
}  // namespace etendue
