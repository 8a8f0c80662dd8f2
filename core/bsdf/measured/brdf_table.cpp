#include "bsdf/measured/brdf_table.h"

#include <charconv>
#include <cstdio>

#include "base/file.h"
#include "bsdf/measured/value_limit.h"

namespace etendue {
namespace {

Vec3 spherical_direction(float theta, float phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// Two neighbouring nodes and the position between them.
struct NodePair {
  size_t first, second;
  float t;
};

NodePair polar_nodes(const Vec3& w, int steps) {
  const float theta = std::atan2(std::sqrt(sqr(w.x) + sqr(w.y)), w.z);
  const float x = std::clamp(theta * (2 / kPi) * static_cast<float>(steps) - 0.5f, 0.0f, static_cast<float>(steps - 1));
  const int first = std::min(static_cast<int>(x), std::max(0, steps - 2));
  return {static_cast<size_t>(first), static_cast<size_t>(std::min(first + 1, steps - 1)),
          x - static_cast<float>(first)};
}

NodePair azimuth_nodes(float phi, int steps) {
  const float turns = phi / (2 * kPi);
  const float x = (turns - std::floor(turns)) * static_cast<float>(steps);
  const int first = static_cast<int>(x) % steps;
  return {static_cast<size_t>(first), static_cast<size_t>((first + 1) % steps), x - std::floor(x)};
}

// Splits a text at white space; comments from # to the end of the line are skipped.
struct Tokenizer {
  std::string_view text;
  size_t at = 0;

  // Empty at the end of the text.
  std::string_view next() {
    for (;;) {
      while (at < text.size() && static_cast<unsigned char>(text[at]) <= ' ') ++at;
      if (at == text.size() || text[at] != '#') break;
      while (at < text.size() && text[at] != '\n') ++at;
    }
    const size_t start = at;
    while (at < text.size() && static_cast<unsigned char>(text[at]) > ' ') ++at;
    return text.substr(start, at - start);
  }
  template <class T>
  bool read_number(T& value) {
    const std::string_view token = next();
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    return error == std::errc{} && end == token.data() + token.size();
  }
};

}  // namespace

size_t BrdfTable::entry_count(int polar, int azimuths, bool isotropic) {
  const auto n = static_cast<size_t>(polar), m = static_cast<size_t>(azimuths);
  return n * n * m * (isotropic ? 1 : m);
}

BrdfTable::BrdfTable(int polar, int azimuths, bool isotropic)
    : polar_(polar), azimuths_(azimuths), isotropic_(isotropic), values_(entry_count(polar, azimuths, isotropic)) {}

BrdfTable BrdfTable::measured(const std::function<Rgb(const Vec3&, const Vec3&)>& f, int polar, int azimuths,
                              bool isotropic) {
  while (entry_count(polar, azimuths, isotropic) > kMaxEntries) {
    azimuths = std::max(8, azimuths * 3 / 4);
    if (azimuths == 8) polar = polar * 3 / 4;
  }
  BrdfTable table(polar, azimuths, isotropic);
  const auto theta = [&](int k) { return (static_cast<float>(k) + 0.5f) / static_cast<float>(polar) * (kPi / 2); };
  const auto phi = [&](int k) { return 2 * kPi * static_cast<float>(k) / static_cast<float>(azimuths); };
  size_t at = 0;
  for (int o = 0; o < polar; ++o)
    for (int azimuth_o = 0; azimuth_o < (isotropic ? 1 : azimuths); ++azimuth_o)
      for (int i = 0; i < polar; ++i)
        for (int k = 0; k < azimuths; ++k)
          table.values_[at++] = f(spherical_direction(theta(o), phi(azimuth_o)), spherical_direction(theta(i), phi(k)));
  return table;
}

Result<BrdfTable> BrdfTable::read(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  return parse(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()), path.string());
}

Result<BrdfTable> BrdfTable::parse(const std::string& text, const std::string& name) {
  const auto wrong = [&](const std::string& what) { return input_error(name + ": " + what); };
  Tokenizer tokens{text};
  int version = 0;
  if (tokens.next() != "etendue-brdf" || !tokens.read_number(version) || version != 1)
    return wrong("the file does not start with 'etendue-brdf 1'");
  const std::string_view kind = tokens.next();
  if (kind != "isotropic" && kind != "anisotropic")
    return wrong("expected 'isotropic' or 'anisotropic' after 'etendue-brdf 1'");
  int polar = 0, azimuths = 0;
  if (!tokens.read_number(polar) || !tokens.read_number(azimuths) || polar < 1 || polar > kMaxPolar || azimuths < 1 ||
      azimuths > kMaxAzimuths)
    return wrong("expected the number of polar angles (1 to 90) and of azimuths (1 to 360)");
  const bool isotropic = kind == "isotropic";
  const size_t count = entry_count(polar, azimuths, isotropic);
  // An entry has at least six characters, so a short text cannot cause a large allocation.
  if (count > kMaxEntries || count * 6 > text.size() + 6)
    return wrong("the table is shorter than the " + std::to_string(count) + " entries that its header declares");
  BrdfTable table(polar, azimuths, isotropic);
  for (size_t k = 0; k < count; ++k)
    for (int band = 0; band < 3; ++band) {
      float value = 0;
      if (!tokens.read_number(value) || !(value >= 0 && value <= kMostTabulated))
        return wrong("entry " + std::to_string(k + 1) + " of " + std::to_string(count) +
                     " is not three numbers from 0 to 1e12");
      table.values_[k][band] = value;
    }
  if (!tokens.next().empty())
    return wrong("the table has more than the " + std::to_string(count) + " entries that its header declares");
  return table;
}

Result<void> BrdfTable::write(const std::filesystem::path& path) const {
  std::string text = "etendue-brdf 1\n";
  text +=
      (isotropic_ ? "isotropic " : "anisotropic ") + std::to_string(polar_) + ' ' + std::to_string(azimuths_) + '\n';
  char line[80];
  for (const Rgb& v : values_) {
    std::snprintf(line, sizeof line, "%.9g %.9g %.9g\n", double{v.r}, double{v.g}, double{v.b});
    text += line;
  }
  return write_file(path, text.data(), text.size());
}

Rgb BrdfTable::f(const Vec3& o, const Vec3& i) const {
  const auto n = static_cast<size_t>(polar_), m = static_cast<size_t>(azimuths_);
  const NodePair theta_o = polar_nodes(o, polar_), theta_i = polar_nodes(i, polar_);
  const float phi_o = std::atan2(o.y, o.x), phi_i = std::atan2(i.y, i.x);
  const NodePair azimuth_o = isotropic_ ? NodePair{0, 0, 0} : azimuth_nodes(phi_o, azimuths_);
  const NodePair k = azimuth_nodes(isotropic_ ? phi_i - phi_o : phi_i, azimuths_);
  const size_t azimuths_o = isotropic_ ? 1 : m;
  const auto line = [&](size_t a, size_t b, size_t c) {
    const Rgb* row = &values_[((a * azimuths_o + b) * n + c) * m];
    return mix(row[k.first], row[k.second], k.t);
  };
  const auto plane = [&](size_t a, size_t b) {
    return mix(line(a, b, theta_i.first), line(a, b, theta_i.second), theta_i.t);
  };
  const auto space = [&](size_t a) {
    return azimuth_o.t > 0 ? mix(plane(a, azimuth_o.first), plane(a, azimuth_o.second), azimuth_o.t)
                           : plane(a, azimuth_o.first);
  };
  return mix(space(theta_o.first), space(theta_o.second), theta_o.t);
}

}  // namespace etendue
