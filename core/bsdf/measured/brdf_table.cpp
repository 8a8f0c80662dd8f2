#include "bsdf/measured/brdf_table.h"

#include <charconv>
#include <cstdio>

#include "base/file.h"

namespace etendue {
namespace {

Vec3 at_angles(float theta, float phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

struct Between {
  size_t first, second;
  float t;
};

Between polar_between(const Vec3& w, int steps) {
  const float theta = std::atan2(std::sqrt(sqr(w.x) + sqr(w.y)), w.z);
  const float x = std::clamp(theta * (2 / kPi) * static_cast<float>(steps) - 0.5f, 0.0f, static_cast<float>(steps - 1));
  const int first = std::min(static_cast<int>(x), std::max(0, steps - 2));
  return {static_cast<size_t>(first), static_cast<size_t>(std::min(first + 1, steps - 1)),
          x - static_cast<float>(first)};
}

Between azimuth_between(float phi, int steps) {
  const float turns = phi / (2 * kPi);
  const float x = (turns - std::floor(turns)) * static_cast<float>(steps);
  const int first = static_cast<int>(x) % steps;
  return {static_cast<size_t>(first), static_cast<size_t>((first + 1) % steps), x - std::floor(x)};
}

// Words of a text one after the other, comments left out.
struct Words {
  std::string_view text;
  size_t at = 0;

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
  bool number(T& value) {
    const std::string_view word = next();
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc{} && end == word.data() + word.size();
  }
};

}  // namespace

size_t BrdfTable::entries(int polar, int azimuths, bool isotropic) {
  const auto n = static_cast<size_t>(polar), m = static_cast<size_t>(azimuths);
  return n * n * m * (isotropic ? 1 : m);
}

BrdfTable::BrdfTable(int polar, int azimuths, bool isotropic)
    : polar_(polar), azimuths_(azimuths), isotropic_(isotropic), values_(entries(polar, azimuths, isotropic)) {}

BrdfTable BrdfTable::measured(const std::function<Rgb(const Vec3&, const Vec3&)>& f, int polar, int azimuths,
                              bool isotropic) {
  while (entries(polar, azimuths, isotropic) > kMostEntries) {
    azimuths = std::max(8, azimuths * 3 / 4);
    if (azimuths == 8) polar = polar * 3 / 4;
  }
  BrdfTable table(polar, azimuths, isotropic);
  const auto theta = [&](int k) { return (static_cast<float>(k) + 0.5f) / static_cast<float>(polar) * (kPi / 2); };
  const auto phi = [&](int k) { return 2 * kPi * static_cast<float>(k) / static_cast<float>(azimuths); };
  size_t at = 0;
  for (int o = 0; o < polar; ++o)
    for (int turn = 0; turn < (isotropic ? 1 : azimuths); ++turn)
      for (int i = 0; i < polar; ++i)
        for (int k = 0; k < azimuths; ++k)
          table.values_[at++] = f(at_angles(theta(o), phi(turn)), at_angles(theta(i), phi(k)));
  return table;
}

Result<BrdfTable> BrdfTable::read(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  return parsed(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()), path.string());
}

Result<BrdfTable> BrdfTable::parsed(const std::string& text, const std::string& name) {
  const auto wrong = [&](const std::string& what) { return input_error(name + ": " + what); };
  Words words{text};
  int version = 0;
  if (words.next() != "etendue-brdf" || !words.number(version) || version != 1)
    return wrong("a table of a BRDF starts with 'etendue-brdf 1'");
  const std::string_view kind = words.next();
  if (kind != "isotropic" && kind != "anisotropic") return wrong("'isotropic' or 'anisotropic' is expected after that");
  int polar = 0, azimuths = 0;
  if (!words.number(polar) || !words.number(azimuths) || polar < 1 || polar > kMostPolar || azimuths < 1 ||
      azimuths > kMostAzimuths)
    return wrong("it needs a number of polar angles from 1 to 90 and one of azimuths from 1 to 360");
  const bool isotropic = kind == "isotropic";
  const size_t count = entries(polar, azimuths, isotropic);
  // An entry takes six characters at least: a short text cannot ask for a large table.
  if (count > kMostEntries || count * 6 > text.size() + 6)
    return wrong("it has not the " + std::to_string(count) + " entries that it announces");
  BrdfTable table(polar, azimuths, isotropic);
  for (size_t k = 0; k < count; ++k)
    for (int band = 0; band < 3; ++band) {
      float value = 0;
      if (!words.number(value) || !std::isfinite(value) || value < 0)
        return wrong("entry " + std::to_string(k + 1) + " of " + std::to_string(count) +
                     " is not three numbers that are finite and not negative");
      table.values_[k][band] = value;
    }
  if (!words.next().empty()) return wrong("there is more than the " + std::to_string(count) + " entries it announces");
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
  const Between to = polar_between(o, polar_), ti = polar_between(i, polar_);
  const float phi_o = std::atan2(o.y, o.x), phi_i = std::atan2(i.y, i.x);
  const Between turn = isotropic_ ? Between{0, 0, 0} : azimuth_between(phi_o, azimuths_);
  const Between k = azimuth_between(isotropic_ ? phi_i - phi_o : phi_i, azimuths_);
  const size_t turns = isotropic_ ? 1 : m;
  const auto line = [&](size_t a, size_t b, size_t c) {
    const Rgb* row = &values_[((a * turns + b) * n + c) * m];
    return mix(row[k.first], row[k.second], k.t);
  };
  const auto plane = [&](size_t a, size_t b) { return mix(line(a, b, ti.first), line(a, b, ti.second), ti.t); };
  const auto space = [&](size_t a) {
    return turn.t > 0 ? mix(plane(a, turn.first), plane(a, turn.second), turn.t) : plane(a, turn.first);
  };
  return mix(space(to.first), space(to.second), to.t);
}

}  // namespace etendue
