// Fresnel's equations, their approximations, and the optical constants of materials [Lang, sec. 4.1.3].
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "bsdf/fresnel/fresnel_term.h"
#include "bsdf/fresnel/metal_spectra.h"
#include "bsdf/fresnel/optical_constants.h"
#include "spectrum/observer.h"
#include "support/model_cases.h"

namespace etendue {
namespace {

using test::direction;

// Reflectance of dielectrics by angle, and the hemispherical means on both sides.
TEST(Fresnel, Dielectrics) {
  struct Row {
    double eta, r0, at30, at45, at60, at75, at85, at89, mean_outside, mean_inside;
  };
  const Row rows[] = {
      {1.31, .018009, .018993, .025038, .055323, .204822, .577073, .894395, .062742, .453844},
      {1.333, .020373, .021436, .027898, .059691, .212378, .583523, .896276, .066406, .474591},
      {1.46, .034966, .036398, .044694, .082454, .245110, .607860, .902954, .085860, .571148},
      {1.5, .040000, .041523, .050240, .089187, .253061, .612800, .904185, .091778, .596346},
      {1.6, .053254, .054953, .064434, .105238, .269554, .621561, .906141, .106246, .650877},
      {1.77, .077272, .079123, .089137, .130425, .289949, .628793, .907097, .129968, .722292},
      {2.42, .172395, .173883, .181521, .211598, .330627, .621622, .899693, .212541, .865539},
  };
  const auto mean = [](float eta) {
    constexpr int kSteps = 200'000;
    double sum = 0;
    float cos_t;
    for (int k = 0; k < kSteps; ++k)
      sum += fresnel_dielectric(std::sqrt((static_cast<float>(k) + 0.5f) / kSteps), eta, cos_t);
    return sum / kSteps;
  };
  for (const Row& row : rows) {
    const FresnelTerm<Rgb> f{FresnelKind::dielectric, Rgb(static_cast<float>(row.eta)), Rgb(0)};
    const std::pair<float, double> all[] = {{0.0f, row.r0},    {30.0f, row.at30}, {45.0f, row.at45}, {60.0f, row.at60},
                                            {75.0f, row.at75}, {85.0f, row.at85}, {89.0f, row.at89}};
    for (const auto& [theta, expected] : all)
      EXPECT_NEAR(f(direction(theta).z).r, expected, 2e-6) << row.eta << ' ' << theta;
    EXPECT_NEAR(mean(static_cast<float>(row.eta)), row.mean_outside, 2e-6);
    EXPECT_NEAR(mean(static_cast<float>(1 / row.eta)), row.mean_inside, 1e-5);
    EXPECT_NEAR(row.mean_inside, 1 - (1 - row.mean_outside) / sqr(row.eta), 2e-6);
  }
}

// The known errors of Schlick's approximation. From the denser side it uses the cosine of the transmitted direction
// [Lang, eq. 4.75, corrected].
TEST(Fresnel, SchlickHasItsKnownErrors) {
  const std::array<double, 3> rows[] = {{1.31, .0653, 83.6}, {1.333, .0592, 83.8}, {1.46, .0388, 84.8},
                                        {1.5, .0357, 85.0},  {1.6, .0319, 85.3},   {1.77, .0335, 85.5},
                                        {2.42, .0757, 84.5}};
  for (const auto& [eta, error, angle] : rows) {
    double most = 0, where = 0;
    for (double theta = 0; theta < 90; theta += 0.05) {
      float cos_t;
      const float c = direction(static_cast<float>(theta)).z, n = static_cast<float>(eta);
      const double off = std::abs(double{fresnel_dielectric(c, n, cos_t)} - fresnel_schlick(c, n, 0));
      if (off > most) {
        most = off;
        where = theta;
      }
    }
    EXPECT_NEAR(most, error, 6e-5) << eta;
    EXPECT_NEAR(where, angle, 0.11) << eta;
  }
  float cos_t;
  const float inside = 1 / 1.5f;
  EXPECT_NEAR(fresnel_dielectric(direction(30).z, inside, cos_t), .055190, 1e-6);
  EXPECT_NEAR(fresnel_schlick(direction(30).z, inside, 0), .044270, 1e-6);
  EXPECT_NEAR(fresnel_dielectric(direction(41).z, inside, cos_t), .379751, 2e-5);
  EXPECT_NEAR(fresnel_schlick(direction(41).z, inside, 0), .400976, 2e-5);
  EXPECT_EQ(fresnel_schlick(direction(42).z, inside, 0), 1);
}

// The approximation for conductors [Lang, eq. 4.69-4.72, corrected] and the exact equations. Squaring the terms again,
// as printed, agrees with neither.
TEST(Fresnel, Conductors) {
  struct Row {
    const char* name;
    double at0, approximate[5], exact[5], mean;
  };
  const Row rows[] = {
      {"gold",
       .849430,
       {.848601, .848447, .866566, .890791, .934816},
       {.846622, .843883, .861775, .887398, .933158},
       .850529},
      {"silver",
       .951574,
       {.950390, .947685, .946909, .953338, .970417},
       {.949768, .946089, .944797, .951726, .969638},
       .949370},
      {"copper-printed",
       .919312,
       {.919094, .919793, .932110, .945992, .968923},
       {.917792, .916911, .929407, .944210, .968131},
       .920506},
      {"copper",
       .741072,
       {.741324, .745142, .781808, .822193, .893013},
       {.738754, .739305, .775704, .817701, .890578},
       .747214},
      {"steel",
       .584634,
       {.579654, .568335, .564767, .595319, .700489},
       {.578516, .565257, .559573, .590023, .695962},
       .577970},
  };
  const float angles[] = {45, 60, 75, 80, 85};
  for (const Row& row : rows) {
    const auto* metal = std::find_if(kConductors.begin(), kConductors.end(),
                                     [&](const auto& c) { return std::string_view(c.name) == row.name; });
    ASSERT_NE(metal, kConductors.end());
    const float n = metal->eta.x, k = metal->kappa.x;
    EXPECT_NEAR(fresnel_conductor(1, n, k), row.at0, 1e-6) << row.name;
    EXPECT_NEAR(fresnel_conductor_approximate(1, n, k), row.at0, 1e-6) << row.name;
    EXPECT_NEAR(fresnel_schlick(1, n, k), row.at0, 1e-6) << row.name;
    EXPECT_NEAR(fresnel_conductor(0, n, k), 1, 1e-6);
    for (size_t a = 0; a < 5; ++a) {
      const float c = direction(angles[a]).z;
      EXPECT_NEAR(fresnel_conductor(c, n, k), row.exact[a], 2e-6) << row.name << ' ' << angles[a];
      EXPECT_NEAR(fresnel_conductor_approximate(c, n, k), row.approximate[a], 2e-6) << row.name << ' ' << angles[a];
    }
    const FresnelTerm<Rgb> f{FresnelKind::conductor, Rgb(n), Rgb(k)};
    EXPECT_NEAR(f.mean().r, row.mean, 2e-6) << row.name;
  }
  double most = 0;
  for (int k = 0; k < 900; ++k) {
    const float c = direction(0.1f * static_cast<float>(k)).z;
    most =
        std::max(most, double{fresnel_conductor_approximate(c, 0.370f, 2.820f)} - fresnel_conductor(c, 0.370f, 2.820f));
  }
  EXPECT_NEAR(most, 0.0054, 5e-5);
}

// A table of a file of measured data: numbers by row. Empty if the file cannot be read.
using Table = std::vector<std::array<double, 4>>;
Table read_table(const std::string& folder, const std::string& name) {
  Table table;
  std::ifstream file(folder + "/spectra/" + name + ".csv");
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || !std::isdigit(static_cast<unsigned char>(line[0]))) continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    std::array<double, 4> row{};
    for (double& x : row) numbers >> x;
    table.push_back(row);
  }
  return table;
}

double interpolated(const Table& table, double wavelength, size_t column) {
  for (size_t k = 1; k < table.size(); ++k)
    if (wavelength <= table[k][0]) {
      const double t = (wavelength - table[k - 1][0]) / (table[k][0] - table[k - 1][0]);
      return table[k - 1][column] * (1 - t) + table[k][column] * t;
    }
  return table.back()[column];
}

// The reflectance of a metal for the linear sRGB components, under illuminant D65.
std::array<double, 3> band_reflectance(const MetalSpectrum& metal, float cosine) {
  return relative_rgb_of([&](double wavelength) {
    const auto w = static_cast<float>(wavelength);
    return double{fresnel_conductor(cosine, metal.eta(w), metal.kappa(w))};
  });
}

const ConductorConstants& constants_of(const MetalSpectrum& metal) {
  return *std::find_if(kConductors.begin(), kConductors.end(),
                       [&](const auto& c) { return std::string_view(c.name) == metal.name; });
}

// The constants for RGB are fitted to the reflectances of the spectra; the deviations are those that
// optical_constants.h states.
TEST(Conductors, RgbConstantsReproduceTheBandReflectances) {
  const std::map<std::string, std::array<double, 3>> stated{{"silver-measured", {0.0002, 0.0002, 0.0002}},
                                                            {"aluminium-measured", {0.0008, 0.0008, 0.0008}},
                                                            {"gold-measured", {0.0395, 0.002, 0.002}},
                                                            {"copper-measured", {0.0045, 0.0045, 0.0045}}};
  for (const MetalSpectrum& metal : metal_spectra()) {
    const ConductorConstants& constants = constants_of(metal);
    for (int k = 0; k < 20; ++k) {
      const float cosine = (static_cast<float>(k) + 0.5f) / 20;
      const auto expected = band_reflectance(metal, cosine);
      for (int c = 0; c < 3; ++c) {
        const auto band = static_cast<size_t>(c);
        EXPECT_NEAR(fresnel_conductor(cosine, constants.eta[c], constants.kappa[c]), expected[band],
                    stated.at(metal.name)[band])
            << metal.name << ", component " << c << ", cosine " << cosine;
        EXPECT_LE(fresnel_conductor(cosine, constants.eta[c], constants.kappa[c]), 1);
      }
    }
    const auto rgb = [](const Vec3& v) { return Rgb(v.x, v.y, v.z); };
    EXPECT_EQ(find_metal_spectrum(rgb(constants.eta), rgb(constants.kappa)), &metal);
  }
}

// [Akenine-Möller et al. 2018, table 9.2] lists linear sRGB reflectances at normal incidence that follow from other
// measurements.
TEST(Conductors, ColorsAreNearPublishedOnes) {
  const std::map<std::string, std::array<double, 3>> published{{"silver-measured", {0.972, 0.960, 0.915}},
                                                               {"aluminium-measured", {0.913, 0.922, 0.924}},
                                                               {"gold-measured", {1.022, 0.782, 0.344}},
                                                               {"copper-measured", {0.955, 0.638, 0.538}}};
  for (const MetalSpectrum& metal : metal_spectra()) {
    const auto color = band_reflectance(metal, 1);
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(color[c], published.at(metal.name)[c], 0.065) << metal.name << ' ' << c;
  }
}

TEST(Conductors, SpectraAreTheMeasuredOnes) {
  const char* data = std::getenv("ETENDUE_TEST_DATA");
  if (!data) GTEST_SKIP() << "ETENDUE_TEST_DATA is not set";
  const std::map<std::string, std::string> files{{"silver-measured", "Ag_johnson"},
                                                 {"aluminium-measured", "Al_rakic"},
                                                 {"gold-measured", "Au_johnson"},
                                                 {"copper-measured", "Cu_johnson"}};
  for (const MetalSpectrum& metal : metal_spectra()) {
    const Table table = read_table(data, files.at(metal.name));
    ASSERT_GT(table.size(), 10U);
    for (float wavelength = 380; wavelength <= 780; wavelength += 5) {
      EXPECT_NEAR(metal.eta(wavelength), interpolated(table, double{wavelength}, 1), 1e-5) << metal.name;
      EXPECT_NEAR(metal.kappa(wavelength), interpolated(table, double{wavelength}, 2), 1e-5) << metal.name;
    }
  }
}

TEST(Dielectrics, AreTheMeasuredOnes) {
  const char* data = std::getenv("ETENDUE_TEST_DATA");
  if (!data) GTEST_SKIP() << "ETENDUE_TEST_DATA is not set";
  const std::pair<const char*, const char*> glasses[] = {{"n-bk7", "N-BK7_schott"},
                                                         {"n-sf11", "N-SF11_schott"},
                                                         {"fused-silica", "fused_silica_malitson"},
                                                         {"water-measured", "water_daimon_20C"}};
  for (const auto& [name, file] : glasses) {
    const auto* constants = std::find_if(kDielectrics.begin(), kDielectrics.end(),
                                         [&](const auto& c) { return std::string_view(c.name) == name; });
    EXPECT_NEAR(constants->eta, interpolated(read_table(data, file), 587.6, 1), 1e-5) << name;
  }
}

}  // namespace
}  // namespace etendue
