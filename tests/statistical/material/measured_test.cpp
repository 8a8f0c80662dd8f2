// Tabulated reflectance: files of the RGL and MERL databases, BRDF tables, and spherical harmonics.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include "bsdf/measured/bilinear_density.h"
#include "bsdf/measured/measured_data.h"
#include "bsdf/measured/tensor_file.h"
#include "support/chi_square.h"
#include "support/model_cases.h"
#include "support/rgl_bytes.h"
#include "support/sphere_partition.h"

namespace etendue {
namespace {

using test::direction;
using test::lobes_of;
using test::model_with;
using test::Random;

std::filesystem::path temporary(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / ("etendue_measured_" + name);
}

void write_bytes(const std::filesystem::path& path, const std::vector<char>& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::vector<char> read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::filesystem::path> rgl_files() {
  std::vector<std::filesystem::path> files;
  const char* data = std::getenv("ETENDUE_TEST_DATA");
  if (data && std::filesystem::exists(std::filesystem::path(data) / "brdf"))
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(data) / "brdf"))
      if (entry.path().extension() == ".bsdf") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// Inversion, and normalisation to one; also between slices and with empty regions.
TEST(BilinearDensity, IsInvertedAndNormalised) {
  Random random(2);
  constexpr size_t kWidth = 7, kHeight = 5;
  std::vector<float> values(2 * kWidth * kHeight);
  for (float& v : values) v = random.uniform() < 0.2f ? 0 : 3 * random.uniform();
  const BilinearDensity density(values, kWidth, kHeight);
  for (const float t : {0.0f, 0.3f, 1.0f}) {
    double sum = 0;
    constexpr int kSteps = 240;
    for (int y = 0; y < kSteps; ++y)
      for (int x = 0; x < kSteps; ++x)
        sum +=
            density
                .invert(Vec2((static_cast<float>(x) + 0.5f) / kSteps, (static_cast<float>(y) + 0.5f) / kSteps), {0, t})
                .pdf;
    EXPECT_NEAR(sum / (kSteps * kSteps), 1, 1e-3);
    for (int k = 0; k < 1000; ++k) {
      const Vec2 u = random.uniform2();
      const auto sample = density.sample(u, {0, t});
      const auto back = density.invert(sample.p, {0, t});
      // A small change of the density is a large step where the density is close to zero.
      if (sample.pdf < 0.05f) continue;
      ASSERT_NEAR(back.p.x, u.x, 2e-4f);
      ASSERT_NEAR(back.p.y, u.y, 2e-4f);
      ASSERT_NEAR(back.pdf, sample.pdf, 2e-3f * sample.pdf);
    }
  }
}

// The sampling density of [Dupuy and Jakob 2018] is nearly proportional to the measured values. Sample weights
// therefore vary little, which would not hold if a part of the file were misread; and directions follow the density.
TEST(Rgl, IsSampledNearlyInProportion) {
  const auto files = rgl_files();
  if (files.empty()) GTEST_SKIP() << "ETENDUE_TEST_DATA has no measurements";
  unsigned seed = 1;
  for (const auto& file : files) {
    ASSERT_TRUE(accepts_rgl_file(file.string())) << accepts_rgl_file(file.string()).error().message;
    const auto lobes = lobes_of(*model_with("rgl", {{"file", file.string()}}), Rgb(1));
    for (const float theta : {1.0f, 30.0f, 60.0f, 80.0f}) {
      const Vec3 wo = direction(theta, 0.5f);
      Random random(++seed);
      double sum = 0, squares = 0;
      constexpr int kSamples = 20'000;
      for (int k = 0; k < kSamples; ++k)
        if (LobeSample<Rgb> s; lobes.sample(wo, {random.uniform(), random.uniform2()}, TransportMode::radiance, s)) {
          const double w = luminance(s.weight);
          ASSERT_TRUE(std::isfinite(w) && w >= 0);
          sum += w / kSamples;
          squares += w * w / kSamples;
        }
      EXPECT_GT(sum, 0.02) << file;
      EXPECT_LT(sum, 1) << file;
      EXPECT_LT(std::sqrt(squares - sum * sum), 0.15 * sum) << file << ' ' << theta;
      const auto chi = test::chi_square_on_sphere(
          [&](Vec3& wi) {
            LobeSample<Rgb> s;
            const bool ok = lobes.sample(wo, {random.uniform(), random.uniform2()}, TransportMode::radiance, s);
            wi = s.wi;
            return ok;
          },
          [&](const Vec3& wi) { return lobes.pdf(wo, wi, TransportMode::radiance); }, 20'000);
      EXPECT_GT(chi.p_value, 1 - std::pow(0.99, 1.0 / (4 * static_cast<double>(files.size())))) << file << ' ' << theta;
    }
  }
}

// Paper is nearly Lambertian. The stored values include a cosine, which is divided out.
TEST(Rgl, WhitePaperIsWhiteAndNearlyLambertian) {
  for (const auto& file : rgl_files()) {
    if (file.filename() != "paper_white_rgb.bsdf") continue;
    const RglBrdf* paper = rgl_data(file.string());
    ASSERT_NE(paper, nullptr);
    for (const float theta : {10.0f, 40.0f, 60.0f, 75.0f})
      EXPECT_NEAR(paper->f(direction(5), direction(theta, 2)).g, 0.26, 0.03) << theta;
    return;
  }
  GTEST_SKIP() << "ETENDUE_TEST_DATA has no measurement of paper";
}

// Measurements are reciprocal up to their measurement error.
TEST(Rgl, IsApproximatelyReciprocal) {
  for (const auto& file : rgl_files()) {
    const RglBrdf* brdf = rgl_data(file.string());
    ASSERT_NE(brdf, nullptr);
    Random random(8);
    double off = 0, all = 0;
    for (int k = 0; k < 5000; ++k) {
      const Vec3 a = direction(70 * random.uniform(), 6 * random.uniform()),
                 b = direction(70 * random.uniform(), 6 * random.uniform());
      const double forth = brdf->f(a, b).g, back = brdf->f(b, a).g;
      off += std::abs(forth - back);
      all += forth;
    }
    EXPECT_LT(off, 0.5 * all) << file;
    EXPECT_GT(off, 0.005 * all) << file;
  }
}

// Files that are truncated anywhere or have damaged bytes: an error with the file name, or data that can be evaluated.
TEST(Rgl, DamagedFilesAreErrors) {
  const auto files = rgl_files();
  if (files.empty()) GTEST_SKIP() << "ETENDUE_TEST_DATA has no measurements";
  const auto whole = read_bytes(files[0]);
  const auto path = temporary("damaged.bsdf");
  for (const size_t length :
       {size_t{0}, size_t{5}, size_t{17}, size_t{40}, size_t{200}, size_t{416}, whole.size() - 2000}) {
    write_bytes(path, {whole.begin(), whole.begin() + static_cast<ptrdiff_t>(length)});
    const auto read = RglBrdf::read(path);
    ASSERT_FALSE(read) << length;
    EXPECT_NE(read.error().message.find("damaged.bsdf"), std::string::npos) << read.error().message;
  }
  EXPECT_FALSE(RglBrdf::read(temporary("not there.bsdf")));
  EXPECT_FALSE(accepts_rgl_file("/no/such/file_rgb.bsdf"));
  // Random bytes in the directory of fields.
  Random random(4);
  for (int k = 0; k < 300; ++k) {
    auto bytes = whole;
    for (int hits = 0; hits < 3; ++hits)
      bytes[static_cast<size_t>(random.uniform() * 416)] =
          static_cast<char>(static_cast<int>(random.uniform() * 256) - 128);
    write_bytes(path, bytes);
    if (const auto read = RglBrdf::read(path)) {
      const Rgb f = read->f(direction(30), direction(50, 3));
      EXPECT_TRUE(is_finite(f));
    }
  }
  std::filesystem::remove(path);
}

TEST(Rgl, ValuesAreBounded) {
  const auto path = temporary("values.bsdf");
  const auto f_of = [&](float area, float facets) -> std::optional<Rgb> {
    write_bytes(path, test::rgl_bytes(area, facets));
    const auto read = RglBrdf::read(path);
    if (!read) return {};
    return read->f(direction(30), direction(50, 3));
  };
  const auto usual = f_of(1, 1);
  ASSERT_TRUE(usual);
  EXPECT_GT(usual->r, 0);
  const auto no_area = f_of(1e-40f, 1);
  ASSERT_TRUE(no_area);
  EXPECT_TRUE(is_finite(*no_area));
  const auto extreme = f_of(1e-11f, 1e12f);
  ASSERT_TRUE(extreme);
  EXPECT_TRUE(is_finite(*extreme));
  EXPECT_FALSE(f_of(1, 1e13f));
  std::filesystem::remove(path);
}

// A MERL file of a known function.
double merl_value(double theta_h, double theta_d, double phi_d) {
  return 0.2 + 0.3 * std::exp(-4 * theta_h * theta_h) + 0.1 * std::cos(theta_d) +
         0.05 * std::cos(2 * phi_d) * std::sin(theta_d);
}

std::vector<char> merl_bytes(int32_t halves, int32_t differences, int32_t azimuths) {
  std::vector<char> bytes;
  const auto put = [&](const auto& x) {
    const char* p = reinterpret_cast<const char*>(&x);
    bytes.insert(bytes.end(), p, p + sizeof x);
  };
  put(halves);
  put(differences);
  put(azimuths);
  for (const double scale : {1500.0, 1500 / 1.15, 1500 / 1.66})
    for (int h = 0; h < halves; ++h)
      for (int d = 0; d < differences; ++d)
        for (int p = 0; p < azimuths; ++p)
          put(scale * merl_value(sqr((h + 0.5) / halves) * M_PI / 2, (d + 0.5) / differences * M_PI / 2,
                                 (p + 0.5) / azimuths * M_PI));
  return bytes;
}

TEST(Merl, IsIndexedByHalfAndDifferenceAngles) {
  const auto path = temporary("known.binary");
  write_bytes(path, merl_bytes(60, 60, 90));
  const auto read = MerlBrdf::read(path);
  ASSERT_TRUE(read) << read.error().message;
  Random random(3);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 a = direction(85 * random.uniform(), 6 * random.uniform()),
               b = direction(85 * random.uniform(), 6 * random.uniform());
    // The angles from rotations, as in the documentation of the database.
    const Vec3 h = glm::normalize(a + b);
    const double theta_h = std::acos(std::min(1.0, double{h.z})), phi_h = std::atan2(h.y, h.x);
    const double x = std::cos(phi_h) * b.x + std::sin(phi_h) * b.y, y = -std::sin(phi_h) * b.x + std::cos(phi_h) * b.y;
    const double dx = std::cos(theta_h) * x - std::sin(theta_h) * b.z,
                 dz = std::sin(theta_h) * x + std::cos(theta_h) * b.z;
    const double expected = merl_value(theta_h, std::acos(std::min(1.0, dz)), std::atan2(y, dx));
    const Rgb f = read->f(a, b), back = read->f(b, a);
    for (int band = 0; band < 3; ++band) {
      ASSERT_NEAR(f[band], expected, 2e-3) << theta_h * 180 / M_PI;
      ASSERT_NEAR(f[band], back[band], 1e-6);
    }
  }
  const auto lobes = lobes_of(*model_with("merl", {{"file", path.string()}}));
  for (const float theta : {5.0f, 45.0f, 80.0f}) {
    const auto chi = test::chi_square_on_sphere(
        [&](Vec3& wi) {
          LobeSample<Rgb> s;
          const bool ok =
              lobes.sample(direction(theta), {random.uniform(), random.uniform2()}, TransportMode::radiance, s);
          wi = s.wi;
          return ok;
        },
        [&](const Vec3& wi) { return lobes.pdf(direction(theta), wi, TransportMode::radiance); }, 30'000);
    EXPECT_GT(chi.p_value, 1 - std::pow(0.99, 1.0 / 3)) << theta;
  }
  std::filesystem::remove(path);
}

TEST(Merl, DamagedFilesAreErrors) {
  const auto path = temporary("damaged.binary");
  const auto whole = merl_bytes(6, 6, 9);
  const auto error_of = [&](std::vector<char> bytes) {
    write_bytes(path, bytes);
    const auto read = MerlBrdf::read(path);
    return read ? std::string() : read.error().message;
  };
  EXPECT_EQ(error_of(whole), "");
  EXPECT_NE(error_of({}).find("too short"), std::string::npos);
  EXPECT_NE(error_of({whole.begin(), whole.end() - 8}).find("length"), std::string::npos);
  auto huge = whole;
  std::memset(huge.data(), 0x7f, 12);
  EXPECT_NE(error_of(huge).find("sizes"), std::string::npos);
  auto nan = whole;
  std::memset(nan.data() + 100, 0xff, 8);
  EXPECT_NE(error_of(nan).find("between -1e12 and 1e12"), std::string::npos);
  // Infinite as a float.
  auto large = whole;
  const double value = 1e153;
  std::memcpy(large.data() + 100, &value, sizeof value);
  EXPECT_NE(error_of(large).find("between -1e12 and 1e12"), std::string::npos);
  std::filesystem::remove(path);
}

std::function<Rgb(const Vec3&, const Vec3&)> function_of(const AllLobes<Rgb>& lobes) {
  return [&lobes](const Vec3& o, const Vec3& i) { return lobes.eval(o, i, TransportMode::radiance); };
}

// The root mean square difference of f cos cos, relative to the root mean square of f cos cos.
template <class Table>
double error_of(const Table& table, const AllLobes<Rgb>& lobes) {
  Random random(9);
  double off = 0, all = 0;
  for (int k = 0; k < 20'000; ++k) {
    const Vec3 o = random.upper_direction(), i = random.upper_direction();
    const double f = lobes.eval(o, i, TransportMode::radiance).r;
    off += sqr(table.f(o, i).r - f);
    all += sqr(f);
  }
  return std::sqrt(off / all);
}

TEST(BrdfTable, LambertIsExactAndGlossyLobesConverge) {
  const auto lambert = lobes_of(*make_bsdf_model("lambert"), Rgb(1));
  for (const int steps : {2, 7, 24})
    EXPECT_LT(error_of(BrdfTable::measured(function_of(lambert), steps, 8, true), lambert), 1e-6);
  const auto glossy = lobes_of(*model_with("modified-phong", {{"exponent", "10"}}), Rgb(1));
  double last = 1;
  for (const int steps : {6, 12, 24, 48}) {
    const double error = error_of(BrdfTable::measured(function_of(glossy), steps, 3 * steps, true), glossy);
    EXPECT_LT(error, 0.5 * last) << steps;
    last = error;
  }
  EXPECT_LT(last, 0.01);
  const auto brushed = lobes_of(*model_with("ward", {{"alpha-x", "0.3"}, {"alpha-y", "0.7"}}), Rgb(1));
  EXPECT_LT(error_of(BrdfTable::measured(function_of(brushed), 20, 40, false), brushed), 0.06);
}

TEST(BrdfTable, EntryCountIsLimited) {
  const auto constant = [](const Vec3&, const Vec3&) { return Rgb(0.3f); };
  const auto table = BrdfTable::measured(constant, 90, 360, false);
  EXPECT_LE(table.size(), BrdfTable::kMaxEntries);
  EXPECT_NEAR(table.f(direction(20), direction(70, 2)).g, 0.3f, 1e-6f);
}

TEST(BrdfTable, FileRoundTripIsExact) {
  const auto path = temporary("table.brdf");
  for (const char* source : {"ward alpha-x=0.3 alpha-y=0.3", "ward alpha-x=0.3 alpha-y=0.6"}) {
    const auto* made = table_data(source, 6, 12);
    ASSERT_NE(made, nullptr);
    ASSERT_TRUE(made->function().write(path));
    const auto read = BrdfTable::read(path);
    ASSERT_TRUE(read) << read.error().message;
    Random random(3);
    for (int k = 0; k < 200; ++k) {
      const Vec3 o = random.upper_direction(), i = random.upper_direction();
      ASSERT_EQ(read->f(o, i), made->f(o, i));
    }
  }
  std::filesystem::remove(path);
}

TEST(BrdfTable, DamagedTextsAreErrors) {
  const std::string good = "etendue-brdf 1\n# by hand\nisotropic 1 2\n0.1 0.2 0.3\n0.1 0.2 0.3\n";
  ASSERT_TRUE(BrdfTable::parse(good, "t"));
  EXPECT_NEAR(BrdfTable::parse(good, "t")->f(direction(10), direction(20)).b, 0.3f, 1e-6f);
  const std::pair<const char*, const char*> bad[] = {
      {"", "does not start with"},
      {"etendue-brdf 2\nisotropic 1 1\n0 0 0\n", "does not start with"},
      {"etendue-brdf 1\nround 1 1\n0 0 0\n", "isotropic"},
      {"etendue-brdf 1\nisotropic 0 1\n", "polar"},
      {"etendue-brdf 1\nisotropic 9999999999 1\n", "polar"},
      {"etendue-brdf 1\nanisotropic 90 360\n0 0 0\n", "entries"},
      {"etendue-brdf 1\nisotropic 90 360\n0 0 0\n", "entries"},
      {"etendue-brdf 1\nisotropic 1 1\n0 -1 0\n", "from 0 to 1e12"},
      {"etendue-brdf 1\nisotropic 1 1\n0 nan 0\n", "from 0 to 1e12"},
      {"etendue-brdf 1\nisotropic 1 1\n0 1e13 0\n", "from 0 to 1e12"},
      {"etendue-brdf 1\nisotropic 1 1\n0 0 bad\n", "from 0 to 1e12"},
      {"etendue-brdf 1\nisotropic 1 1\n0 0 0\n1 1 1\n", "more"},
  };
  for (const auto& [text, expected] : bad) {
    const auto read = BrdfTable::parse(text, "t");
    ASSERT_FALSE(read) << text;
    EXPECT_NE(read.error().message.find(expected), std::string::npos) << read.error().message;
  }
}

TEST(TableSource, IsAModelWithParametersOrAFile) {
  EXPECT_TRUE(accepts_table_source("ward alpha-x=0.1 alpha-y=0.2"));
  EXPECT_TRUE(accepts_harmonic_source("ward alpha-x=0.2 alpha-y=0.2"));
  const std::pair<const char*, const char*> bad[] = {{"ward alpha-z=0.1", "is not a parameter"},
                                                     {"ward alpha-x", "is not a parameter"},
                                                     {"ward alpha-x=7", "alpha-x"},
                                                     {"mirror", "reflects only specularly"},
                                                     {"dielectric roughness=0.5", "transmits light"},
                                                     {"/no/such/table.brdf", "table"},
                                                     {"tabulated", "itself"},
                                                     {"spherical-harmonics", "itself"}};
  for (const auto& [source, expected] : bad) {
    const auto accepted = accepts_table_source(source);
    ASSERT_FALSE(accepted) << source;
    EXPECT_NE(accepted.error().message.find(expected), std::string::npos) << accepted.error().message;
  }
  EXPECT_FALSE(accepts_harmonic_source("ward alpha-x=0.1 alpha-y=0.4"));
  EXPECT_FALSE(accepts_harmonic_source("spherical-harmonics"));
}

TEST(Harmonics, LambertNeedsOneBandAndGlossMore) {
  const auto lambert = lobes_of(*make_bsdf_model("lambert"), Rgb(1));
  const HarmonicBrdf flat(function_of(lambert), 1);
  EXPECT_LT(error_of(flat, lambert), 1e-5);
  EXPECT_EQ(flat.clamped_part(), 0);
  const auto glossy = lobes_of(*model_with("modified-phong", {{"exponent", "20"}}), Rgb(1));
  double last = 1;
  for (const int bands : {2, 4, 8, 16, 24}) {
    const HarmonicBrdf harmonics(function_of(glossy), bands);
    const double error = error_of(harmonics, glossy);
    EXPECT_LT(error, last) << bands;
    last = error;
  }
  EXPECT_LT(last, 0.05);
}

// Negative lobes are clamped and their amount is reported: a narrow lobe has them, a wide one has not.
TEST(Harmonics, RingingIsReported) {
  const std::vector<std::pair<std::string, std::string>> narrow{{"diffuse", "0"}, {"exponent", "100"}};
  const auto lobes = lobes_of(*model_with("modified-phong", narrow), Rgb(1));
  const std::pair<int, float> all[] = {{6, 0.346f}, {12, 0.390f}, {24, 0.080f}};
  for (const auto& [bands, cut] : all)
    EXPECT_NEAR(HarmonicBrdf(function_of(lobes), bands).clamped_part(), cut, 5e-3f) << bands;
  const HarmonicBrdf harmonics(function_of(lobes), 6);
  Random random(3);
  bool negative = false;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 o = random.upper_direction(), i = random.upper_direction();
    negative = negative || harmonics.sum(o, i).r < 0;
    ASSERT_GE(harmonics.f(o, i).r, 0);
    ASSERT_NEAR(harmonics.sum(o, i).r, harmonics.sum(i, o).r, 1e-5f * (1 + std::abs(harmonics.sum(o, i).r)));
  }
  EXPECT_TRUE(negative);
}

}  // namespace
}  // namespace etendue
