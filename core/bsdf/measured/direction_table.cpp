#include "bsdf/measured/direction_table.h"

namespace etendue {
namespace {

constexpr float kUniformPart = 0.05f;

Vec3 at_cosine(float cosine, float phi) {
  const float sine = safe_sqrt(1 - sqr(cosine));
  return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

// The direction of a point of the grid; phi_o is the azimuth of o.
Vec3 direction_at(const Vec2& p, float phi_o) { return at_cosine(std::sqrt(p.y), phi_o + 2 * kPi * p.x); }

}  // namespace

DirectionTable::DirectionTable(const std::function<Rgb(const Vec3&, const Vec3&)>& f, int azimuths, bool coarse)
    : azimuths_(azimuths) {
  if (coarse) {
    columns_ /= 2;
    rows_ /= 2;
  }
  std::vector<float> values(static_cast<size_t>(columns_ * rows_));
  for (int c = 0; c < kCosines; ++c)
    for (int a = 0; a < azimuths; ++a) {
      const float phi = 2 * kPi * static_cast<float>(a) / static_cast<float>(azimuths);
      const Vec3 o = at_cosine((static_cast<float>(c) + 0.5f) / kCosines, phi);
      double sum = 0;
      for (int row = 0; row < rows_; ++row)
        for (int column = 0; column < columns_; ++column) {
          float cell = 0;
          for (const float dy : {0.25f, 0.75f})
            for (const float dx : {0.25f, 0.75f}) {
              const Vec2 p((static_cast<float>(column) + dx) / static_cast<float>(columns_),
                           (static_cast<float>(row) + dy) / static_cast<float>(rows_));
              cell += 0.25f * average(f(o, direction_at(p, phi)));
            }
          values[static_cast<size_t>(row * columns_ + column)] = cell;
          sum += cell;
        }
      const auto mean = static_cast<float>(sum / (columns_ * rows_));
      double squares = 0;
      for (float& v : values) {
        v = mean > 0 ? v / mean : 1;
        v = (1 - kUniformPart) * v + kUniformPart;
        squares += sqr(double{v}) / (columns_ * rows_);
      }
      grids_.emplace_back(values, columns_, rows_);
      albedos_.push_back(mean * kPi);
      alpha_ = std::min(1.0f, static_cast<float>(std::sqrt(1 / squares)));
    }
}

DirectionTable::GridWeights DirectionTable::grids_near(const Vec3& o) const {
  const float x = std::clamp(o.z * kCosines - 0.5f, 0.0f, kCosines - 1.0f);
  const int c = std::min(static_cast<int>(x), kCosines - 2);
  const float t = x - static_cast<float>(c);
  int first = 0, second = 0;
  float s = 0;
  if (azimuths_ > 1) {
    const float phi = std::atan2(o.y, o.x) / (2 * kPi);
    const float y = (phi - std::floor(phi)) * static_cast<float>(azimuths_);
    first = static_cast<int>(y) % azimuths_;
    second = (first + 1) % azimuths_;
    s = y - std::floor(y);
  }
  const auto grid = [&](int cosine, int azimuth) { return static_cast<size_t>(cosine * azimuths_ + azimuth); };
  return {{grid(c, first), grid(c + 1, first), grid(c, second), grid(c + 1, second)},
          {(1 - t) * (1 - s), t * (1 - s), (1 - t) * s, t * s}};
}

float DirectionTable::density(const Vec3& o, const Vec3& i) const {
  const float turn = (std::atan2(i.y, i.x) - std::atan2(o.y, o.x)) / (2 * kPi);
  const Vec2 p(std::min(turn - std::floor(turn), kOneMinusEpsilon), std::min(sqr(i.z), kOneMinusEpsilon));
  const GridWeights grids = grids_near(o);
  float sum = 0;
  for (int k = 0; k < 4; ++k)
    if (grids.weights[k] > 0) sum += grids.weights[k] * grids_[grids.grids[k]].pdf(p);
  return sum * i.z * kInvPi;
}

bool DirectionTable::sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const {
  const GridWeights grids = grids_near(o);
  float choice = random.choice;
  int k = 0;
  while (k < 3 && choice >= grids.weights[k]) choice -= grids.weights[k++];
  i = direction_at(grids_[grids.grids[k]].sample(random.u).uv, std::atan2(o.y, o.x));
  return true;
}

float DirectionTable::albedo(const Vec3& o) const {
  const GridWeights grids = grids_near(Vec3(o.x, o.y, std::abs(o.z)));
  float sum = 0;
  for (int k = 0; k < 4; ++k) sum += grids.weights[k] * albedos_[grids.grids[k]];
  return sum;
}

}  // namespace etendue
