// Photometric files of IES LM-63, and the intensity that they describe.
#include "light/photometry_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>

#include "base/warp.h"
#include "light/photometry_source.h"
#include "light/types/photometric_light.h"

namespace etendue::photometry_profile_test {
namespace {

constexpr double kPiD = std::numbers::pi;

struct FileOptions {
  std::string header = "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n";
  int type = 1;
  std::string multiplier = "1", ballast = "1", photometric_factor = "1", lumens = "1000";
};

std::vector<double> steps(double first, double last, double step) {
  std::vector<double> list;
  for (double x = first; x <= last + 1e-6; x += step) list.push_back(x);
  return list;
}

// A file with the intensity of a function of the vertical and the horizontal angle in degrees.
std::string file(const std::vector<double>& vertical, const std::vector<double>& horizontal,
                 const std::function<double(double, double)>& candela, const FileOptions& options = {}) {
  std::string text = options.header + "1 " + options.lumens + " " + options.multiplier + " " +
                     std::to_string(vertical.size()) + " " + std::to_string(horizontal.size()) + " " +
                     std::to_string(options.type) + " 2 0.1 0.1 0\n" + options.ballast + " " +
                     options.photometric_factor + " 50\n";
  for (const double v : vertical) text += std::to_string(v) + " ";
  text += "\n";
  for (const double h : horizontal) text += std::to_string(h) + ",";
  for (const double h : horizontal) {
    text += "\n";
    for (const double v : vertical) text += std::to_string(candela(v, h)) + " ";
  }
  return text + "\n";
}

PhotometryProfile parsed(const std::string& text) {
  auto profile = parse_photometry(text, "light.ies");
  EXPECT_TRUE(profile) << (profile ? "" : profile.error().message);
  return std::move(*profile);
}

std::string error_of(const std::string& text) {
  const auto profile = parse_photometry(text, "light.ies");
  return profile ? "" : profile.error().message;
}

double cosine(double degrees) { return std::cos(degrees * kPiD / 180); }
double of(const PhotometryProfile& p, const Vec3& direction) {
  return static_cast<double>(p.intensity(glm::normalize(direction)));
}

// A Lambertian downlight of 100 cd has the flux 100 pi lm, in all three types of photometry.
TEST(PhotometryProfile, CosineProfileHasItsFlux) {
  const auto c = parsed(file(steps(0, 90, 1), {0}, [](double v, double) { return 100 * cosine(v); }));
  EXPECT_NEAR(c.flux(), 100 * kPiD, 0.02);
  EXPECT_NEAR(of(c, {0, 0, -1}), 100, 1e-3);
  EXPECT_NEAR(of(c, {1, 0, -1}), 100 * std::sqrt(0.5), 0.02);
  EXPECT_EQ(of(c, {0.1f, 0, 1}), 0);

  const auto product = [](double v, double h) { return 100 * cosine(v) * cosine(h); };
  for (const int type : {2, 3}) {
    const auto full = parsed(file(steps(-90, 90, 1), steps(-90, 90, 1), product, {.type = type}));
    EXPECT_NEAR(full.flux(), 100 * kPiD, 0.04) << type;
    const auto half = parsed(file(steps(-90, 90, 1), steps(0, 90, 1), product, {.type = type}));
    EXPECT_NEAR(half.flux(), 100 * kPiD, 0.04) << type;
    for (const Vec3& d : {Vec3(0.3f, 0.2f, -1), Vec3(-0.7f, 0.5f, -1), Vec3(0.1f, -0.9f, -0.4f)}) {
      EXPECT_NEAR(of(full, d), 100 * static_cast<double>(-glm::normalize(d).z), 0.03) << type;
      EXPECT_NEAR(of(half, d), of(full, d), 1e-3) << type;
    }
  }
}

TEST(PhotometryProfile, AnglesOfTheTypes) {
  // Type C: the vertical angle is from -z, the horizontal one from +x towards +y.
  const auto c = parsed(file(steps(0, 180, 10), steps(0, 360, 10), [](double v, double h) { return v * 1000 + h; }));
  EXPECT_NEAR(of(c, {1, 0, -1}), 45'000, 1);
  EXPECT_NEAR(of(c, {0, 1, 0}), 90'090, 1);
  EXPECT_NEAR(of(c, {0, -1, 1}), 135'270, 1);
  // Type B: a horizontal angle leads to +x, a vertical one to +y; type A the same.
  const auto linear = [](double v, double h) { return 1000 * (v + 90) + h + 90; };
  for (const int type : {2, 3}) {
    const auto p = parsed(file(steps(-90, 90, 10), steps(-90, 90, 10), linear, {.type = type}));
    EXPECT_NEAR(of(p, {0, 0, -1}), 90'090, 1) << type;
    EXPECT_NEAR(of(p, {1, 0, -1}), 90'135, 1) << type;
    EXPECT_NEAR(of(p, {0, 1, -1}), 135'090, 1) << type;
  }
  // The types differ where both angles are large.
  const Vec3 d = glm::normalize(Vec3(1, 1, -1));
  const double out = std::asin(static_cast<double>(d.x)) * 180 / kPiD;
  const auto b = parsed(file(steps(-90, 90, 1), steps(-90, 90, 1), linear, {.type = 2}));
  EXPECT_NEAR(of(b, d), linear(45, out), 5);
  const auto a = parsed(file(steps(-90, 90, 1), steps(-90, 90, 1), linear, {.type = 3}));
  EXPECT_NEAR(of(a, d), linear(out, 45), 20);
}

TEST(PhotometryProfile, ExpandsSymmetries) {
  const auto quarter = [](double v, double h) { return 200 - v + std::min({h, std::abs(180 - h), 360 - h}); };
  const auto full = parsed(file(steps(0, 90, 5), steps(0, 360, 5), quarter));
  const auto quadrant = parsed(file(steps(0, 90, 5), steps(0, 90, 5), quarter));
  const auto half = parsed(file(steps(0, 90, 5), steps(0, 180, 5), quarter));
  const auto turned = parsed(file(steps(0, 90, 5), steps(90, 270, 5), quarter));
  EXPECT_NEAR(quadrant.flux() / full.flux(), 1, 1e-5);
  EXPECT_NEAR(half.flux() / full.flux(), 1, 1e-5);
  EXPECT_NEAR(turned.flux() / full.flux(), 1, 1e-5);
  for (int k = 0; k < 36; ++k) {
    const float angle = kPi * (static_cast<float>(k) + 0.3f) / 18;
    const Vec3 d(std::cos(angle), std::sin(angle), -0.8f);
    for (const auto* p : {&quadrant, &half, &turned}) EXPECT_NEAR(of(*p, d), of(full, d), 0.01) << k;
  }
}

// Directions have the stated density, and their intensity over it has the flux as its mean.
TEST(PhotometryProfile, SamplesWithItsDensity) {
  for (const int type : {1, 2, 3}) {
    const bool is_c = type == 1;
    const auto p = parsed(file(is_c ? steps(20, 75, 5) : steps(-60, 80, 5), is_c ? std::vector{0.0} : steps(-50, 70, 5),
                               [](double v, double h) { return 50 + 0.2 * v + 0.1 * h; }, {.type = type}));
    std::mt19937 engine(static_cast<uint32_t>(type));
    std::uniform_real_distribution<float> uniform(0, 1);
    double sum = 0, squares = 0;
    constexpr int kSamples = 50'000;
    for (int i = 0; i < kSamples; ++i) {
      const Vec3 d = p.sample_direction({uniform(engine), uniform(engine)});
      EXPECT_NEAR(glm::length(d), 1, 1e-5);
      const double value = static_cast<double>(p.intensity(d) / p.direction_pdf());
      EXPECT_GT(value, 0);
      sum += value;
      squares += value * value;
    }
    const double mean = sum / kSamples;
    const double error = std::sqrt((squares / kSamples - mean * mean) / kSamples);
    EXPECT_NEAR(mean, static_cast<double>(p.flux()), 5 * error) << type;  // a false-alarm rate of 6e-7
    EXPECT_LT(error, 1e-2 * mean);
  }
}

TEST(PhotometryProfile, ScalesByMultiplierAndBallast) {
  const auto one = [](double, double) { return 10.0; };
  EXPECT_NEAR(of(parsed(file({0, 180}, {0}, one, {.multiplier = "2.5", .ballast = "0.8"})), {0, 0, -1}), 20, 1e-3);
}

// Candela values are absolute: lumens of -1 mark absolute photometry and change nothing. Standards before 1995 define a
// photometric factor; later ones reserve its place.
TEST(PhotometryProfile, FactorsOfTheStandards) {
  const auto one = [](double, double) { return 10.0; };
  const auto axis = [&](const char* header, const char* photometric_factor, const char* lumens) {
    return of(parsed(file({0, 180}, {0}, one,
                          {.header = std::string(header) + "TILT=NONE\n",
                           .photometric_factor = photometric_factor,
                           .lumens = lumens})),
              {0, 0, -1});
  };
  for (const char* header : {"IESNA:LM-63-1995\n", "IESNA:LM-63-2002\n[TEST] x\n", "IES:LM-63-2019\n"}) {
    EXPECT_NEAR(axis(header, "0.5", "1000"), 10, 1e-4) << header;
    EXPECT_NEAR(axis(header, "1", "-1"), 10, 1e-4) << header;
  }
  for (const char* header : {"", "A luminaire of 1986\n", "IESNA91\n[TEST] x\n"})
    EXPECT_NEAR(axis(header, "0.5", "1000"), 5, 1e-4) << header;
}

// The factors of the TILT data are interpolated between their angles, in the file or in a file beside it.
TEST(PhotometryProfile, TiltFactors) {
  const auto one = [](double, double) { return 10.0; };
  const char* data = "1\n3\n0 45 90\n1 0.9 0.5\n";
  const auto folder = std::filesystem::temp_directory_path() / "etendue-tilt-data";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "lamp.tlt") << data;
  std::ofstream(folder / "lamp.ies") << file({0, 180}, {0}, one, {.header = "IESNA91\nTILT=lamp.tlt\n"});
  const auto beside = read_photometry(folder / "lamp.ies");
  ASSERT_TRUE(beside) << beside.error().message;
  const auto included = parsed(file({0, 180}, {0}, one, {.header = std::string("IESNA91\nTILT = INCLUDE\n") + data}));
  const auto none = parsed(file({0, 180}, {0}, one));
  for (const PhotometryProfile* p : {&*beside, &included}) {
    EXPECT_NEAR(p->tilt_factor(0), 1, 1e-6);
    EXPECT_NEAR(p->tilt_factor(kPi / 8), 0.95, 1e-6);
    EXPECT_NEAR(p->tilt_factor(kPi / 2), 0.5, 1e-6);
    EXPECT_NEAR(p->tilt_factor(kPi), 0.5, 1e-6);
    EXPECT_NEAR(of(*p, {0, 0, -1}), 10, 1e-4);
  }
  EXPECT_EQ(none.tilt_factor(1), 1);

  // A light that points down has its full intensity, a horizontal one half of it, unless the factors are switched off.
  PhotometricLight light;
  light.profile.value = (folder / "lamp.ies").string();
  for (const bool tilt : {true, false}) {
    light.tilt.value = tilt;
    for (const Vec3& direction : {Vec3(0, -1, 0), Vec3(1, 0, 0)}) {
      LightPlace place;
      place.direction = direction;
      place.tangent = {0, 0, 1};
      const double expected = tilt && direction.y == 0 ? 5 : 10;
      EXPECT_NEAR(light.emitter(Rgb(1)).emitted(place, direction, 1).g, expected, 1e-4) << tilt << direction.y;
    }
  }
  std::filesystem::remove_all(folder);
}

TEST(PhotometryProfile, ErrorsInTiltData) {
  EXPECT_EQ(error_of("TILT=missing.tlt\n1 1000"),
            "light.ies: line 1: the file 'missing.tlt' with the TILT data cannot be read; put it beside this file, or "
            "write TILT=NONE");
  EXPECT_NE(error_of("TILT=INCLUDE\n4\n").find("from 1 to 3"), std::string::npos);
  EXPECT_NE(error_of("TILT=INCLUDE\n1\n2\n90 0\n1 1\n").find("larger than the one before it"), std::string::npos);
  EXPECT_NE(error_of("TILT=INCLUDE\n1\n2\n0 90\n1 -1\n").find("between 0 and 10"), std::string::npos);
  EXPECT_NE(error_of("TILT=INCLUDE\n1\n2\n0").find("the file ends before a tilt angle"), std::string::npos);
}

TEST(PhotometryProfile, SkipsKeywordsAndTiltData) {
  const auto one = [](double, double) { return 10.0; };
  const std::string tilt = "IESNA91\r\n[MORE] text, 1 2 3\r\nTILT=INCLUDE\r\n1\r\n3\r\n0 45 90\r\n1 0.9 0.8\r\n";
  EXPECT_NEAR(parsed(file({0, 180}, {0}, one, {.header = tilt})).flux(), 40 * kPiD, 1e-2);
  EXPECT_NEAR(parsed(file({0, 180}, {0}, one, {.header = "TILT=NONE\n"})).flux(), 40 * kPiD, 1e-2);
}

TEST(PhotometryProfile, ErrorsNameTheLineAndWhatIsRight) {
  const auto one = [](double, double) { return 10.0; };
  EXPECT_EQ(error_of("hello"),
            "light.ies: has no line that starts with TILT=; a photometric file of IES LM-63 is expected");
  EXPECT_EQ(error_of("TILT=NONE\n1 1000 x"), "light.ies: line 2: 'x' is not a number; expected the candela multiplier");
  EXPECT_EQ(error_of("TILT=NONE\n1 1000 1 2.5"),
            "light.ies: line 2: the number of vertical angles has to be a whole number from 1 to 1000");
  EXPECT_EQ(error_of("TILT=NONE\n1 1000 1 2 1 4"),
            "light.ies: line 2: the photometric type (1 is C, 2 is B, 3 is A) has to be a whole number from 1 to 3");
  EXPECT_NE(error_of(file({0, 0}, {0}, one)).find("larger than the one before it"), std::string::npos);
  EXPECT_NE(error_of(file({0, 90}, {0, 45}, one)).find("they go from 0 to 45"), std::string::npos);
  EXPECT_NE(error_of(file({0, 90}, {0}, [](double, double) { return -1.0; })).find("between 0 and 1e9"),
            std::string::npos);
  EXPECT_NE(error_of(file({0, 90}, {0}, one, {.multiplier = "0"})).find("positive"), std::string::npos);
  EXPECT_NE(error_of(file({0, 90}, {0}, one, {.multiplier = "nan"})).find("not a number"), std::string::npos);
  const std::string whole = file({0, 90}, {0, 90}, one);
  EXPECT_NE(error_of(whole.substr(0, whole.size() - 12)).find("the file ends before a candela value"),
            std::string::npos);
  EXPECT_NE(error_of("TILT=NONE\n1 1 1 1000 1000 1 1 1 1 1 1 1 1").find("the file ends"), std::string::npos);
  EXPECT_FALSE(read_photometry("no-such-file.ies"));
  EXPECT_FALSE(accepts_photometry("no-such-file.ies"));
  EXPECT_TRUE(accepts_photometry("street"));
}

}  // namespace
}  // namespace etendue::photometry_profile_test
