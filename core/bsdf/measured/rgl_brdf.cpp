#include "bsdf/measured/rgl_brdf.h"

#include "bsdf/measured/tensor_file.h"
#include "bsdf/measured/value_limit.h"
#include "bsdf/microfacet/half_vector.h"

namespace etendue {
namespace {

// Maps of angles to the unit interval and back.
float from_theta(float theta) { return std::sqrt(theta * (2 / kPi)); }
float to_theta(float u) { return sqr(u) * (kPi / 2); }
float from_phi(float phi) { return (phi + kPi) / (2 * kPi); }
float to_phi(float u) { return (2 * u - 1) * kPi; }

float theta_of(const Vec3& w) { return std::atan2(std::sqrt(sqr(w.x) + sqr(w.y)), w.z); }

// Solid angle of i over area of the unit square of normals; bounded below, because it vanishes for h = z. `cosine` is
// <o, h>.
float solid_angle_per_area(const Vec2& normal, const Vec3& h, float cosine) {
  return std::max(2 * sqr(kPi) * normal.x * std::sqrt(sqr(h.x) + sqr(h.y)), 1e-6f) * 4 * cosine;
}

Error wrong(const std::filesystem::path& path, const std::string& what) {
  return input_error(path.string() + ": " + what);
}

// Colours outside the sRGB gamut have negative components, which a BRDF must not have.
void clamp_negative(Tensor& t) {
  for (float& x : t.values) x = std::max(x, 0.0f);
}

}  // namespace

Result<RglBrdf> RglBrdf::read(const std::filesystem::path& path) {
  const auto file = TensorFile::read(path);
  if (!file) return file.error();
  if (!file->has("rgb") && file->has("spectra"))
    return wrong(path, "spectral measurements are not supported; use the file whose name ends in _rgb.bsdf");
  const struct {
    const char* name;
    size_t dimensions;
  } kFields[] = {{"phi_i", 1}, {"theta_i", 1}, {"ndf", 2}, {"sigma", 2}, {"vndf", 4}, {"luminance", 4}, {"rgb", 5}};
  std::vector<Tensor> all;
  for (const auto& field : kFields) {
    auto tensor = file->floats(field.name, field.dimensions);
    if (!tensor) return tensor.error();
    if (std::ranges::any_of(tensor->values, [](float x) { return x > kMostTabulated; }))
      return wrong(path, "field " + std::string(field.name) + " contains a value above 1e12");
    clamp_negative(*tensor);
    all.push_back(std::move(*tensor));
  }
  const Tensor &phi = all[0], &theta = all[1], &ndf = all[2], &sigma = all[3], &vndf = all[4], &lum = all[5],
               &rgb = all[6];
  if (phi.shape[0] != 1) return wrong(path, "anisotropic measurements are not supported");
  const size_t n = theta.shape[0];
  for (size_t k = 0; k < n; ++k)
    if (theta.values[k] > 2 || (k > 0 && theta.values[k] <= theta.values[k - 1]))
      return wrong(path, "the angles of the field theta_i are not ascending between 0 and pi/2");
  const auto grid = [&](const Tensor& t, std::vector<size_t> slices) {
    for (size_t d = 0; d < slices.size(); ++d)
      if (t.shape[d] != slices[d]) return false;
    return t.shape[t.shape.size() - 1] >= 2 && t.shape[t.shape.size() - 2] >= 2;
  };
  if (n < 2 || !grid(ndf, {}) || !grid(sigma, {}) || !grid(vndf, {1, n}) || !grid(lum, {1, n}) || !grid(rgb, {1, n, 3}))
    return wrong(path, "the sizes of the fields do not match");

  RglBrdf brdf;
  brdf.thetas_ = theta.values;
  const auto width = [](const Tensor& t) { return t.shape[t.shape.size() - 1]; };
  const auto height = [](const Tensor& t) { return t.shape[t.shape.size() - 2]; };
  brdf.ndf_ = BilinearGrid(ndf.values, width(ndf), height(ndf));
  brdf.sigma_ = BilinearGrid(sigma.values, width(sigma), height(sigma));
  brdf.rgb_ = BilinearGrid(rgb.values, width(rgb), height(rgb));
  brdf.visible_ = BilinearDensity(vndf.values, width(vndf), height(vndf));
  brdf.luminance_ = BilinearDensity(lum.values, width(lum), height(lum));
  brdf.estimate_alpha();
  return brdf;
}

SliceBlend RglBrdf::blend_at(float theta) const {
  const auto above = std::upper_bound(thetas_.begin(), thetas_.end(), theta);
  const auto k = std::clamp<ptrdiff_t>(above - thetas_.begin() - 1, 0, static_cast<ptrdiff_t>(thetas_.size()) - 2);
  const auto first = static_cast<size_t>(k);
  const float t = (theta - thetas_[first]) / (thetas_[first + 1] - thetas_[first]);
  return {first, std::clamp(t, 0.0f, 1.0f)};
}

Vec2 RglBrdf::normal_at(const Vec3& h, float phi_o) const {
  const float phi = from_phi(std::atan2(h.y, h.x) - phi_o);
  return {from_theta(theta_of(h)), phi - std::floor(phi)};
}

// The quantities that f and the density of a pair of directions have in common.
struct RglBrdf::Pair {
  HalfVector half;
  SliceBlend blend;
  Vec2 normal, at_o;
  BilinearDensity::Sample square;  // s, and the density of the visible normal

  Pair(const RglBrdf& brdf, const Vec3& o, const Vec3& i) : half(o, i) {
    const float theta = theta_of(o), phi = std::atan2(o.y, o.x);
    blend = brdf.blend_at(theta);
    normal = brdf.normal_at(half.h, phi);
    at_o = Vec2(from_theta(theta), from_phi(phi));
    square = brdf.visible_.invert(normal, blend);
  }
};

Rgb RglBrdf::f(const Vec3& o, const Vec3& i) const {
  const Pair pair(*this, o, i);
  // Below this projected area the quotient could overflow.
  constexpr float kLeastArea = 1e-12f;
  const float area = 4 * sigma_.at(pair.at_o) * i.z;
  if (!(area > kLeastArea)) return Rgb(0);
  const float facets = ndf_.at(pair.normal) / area;
  Rgb value;
  for (size_t band = 0; band < 3; ++band)
    value[static_cast<int>(band)] = rgb_.at(pair.square.p, {3 * pair.blend.first + band, pair.blend.t}, 3) * facets;
  return value;
}

float RglBrdf::density(const Vec3& o, const Vec3& i) const {
  const Pair pair(*this, o, i);
  if (!(pair.half.cosine > 0)) return 0;
  const float luminance_pdf = luminance_.invert(pair.square.p, pair.blend).pdf;
  return luminance_pdf * pair.square.pdf / solid_angle_per_area(pair.normal, pair.half.h, pair.half.cosine);
}

bool RglBrdf::sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const {
  const SliceBlend blend = blend_at(theta_of(o));
  const Vec2 square = luminance_.sample(random.u, blend).p;
  const Vec2 normal = visible_.sample(square, blend).p;
  const float theta = to_theta(normal.x), phi = to_phi(normal.y) + std::atan2(o.y, o.x);
  const Vec3 h(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  i = reflect(o, h);
  return glm::dot(o, h) > 0;
}

// The roughness of microfacets whose lobe covers the same solid angle, at normal incidence.
void RglBrdf::estimate_alpha() {
  constexpr int kSide = 16;
  const Vec3 o(0, 0, 1);
  double sum = 0;
  int count = 0;
  for (int a = 0; a < kSide; ++a)
    for (int b = 0; b < kSide; ++b) {
      Vec3 i;
      const Vec2 u((static_cast<float>(a) + 0.5f) / kSide, (static_cast<float>(b) + 0.5f) / kSide);
      if (sample_direction(o, LobeRandom(0, u), i) && i.z > 0) {
        sum += density(o, i);
        ++count;
      }
    }
  if (sum > 0) alpha_ = std::min(1.0f, static_cast<float>(std::sqrt(count / (sum * M_PI))));
}

}  // namespace etendue
