#include "integration/looks/fidelity.h"

#include <cstdio>

#include "integration/looks/assets.h"
#include "integration/looks/sheet.h"
#include "metrics/flip.h"
#include "support/scenes.h"

namespace etendue::looks {
namespace {

constexpr const char* kFirst = "blender-cycles";
// Path tracers first, so that the table is ordered by similarity.
constexpr const char* kOthers[] = {"dspbr-pt", "stellar",  "three-gpu-pathtracer",
                                   "vray",     "filament", "gltf-sample-viewer"};

std::vector<float> linear_of(const Picture& picture) {
  std::vector<float> linear;
  for (const uint8_t byte : picture.rgb) linear.push_back(srgb_to_linear(static_cast<float>(byte) / 255.0f));
  return linear;
}

double brightness(const Picture& picture) {
  double sum = 0;
  for (const float x : linear_of(picture)) sum += x;
  return sum / static_cast<double>(picture.rgb.size());
}

Picture shown(const film::Film& film, float exposure, image::ToneCurve curve) {
  std::vector<float> pixels;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      for (int c = 0; c < 3; ++c) pixels.push_back(film.mean(x, y)[c]);
  return {film.width(), film.height(), image::display_pixels(pixels, exposure, curve)};
}

// The image with the exposure at which its mean equals that of `as`. The light levels differ, and the difference would
// dominate the comparison.
Picture with_equal_brightness(const film::Film& film, const Picture& as, image::ToneCurve curve) {
  float low = -6, high = 4;
  for (int step = 0; step < 12; ++step) {
    const float middle = (low + high) / 2;
    (brightness(shown(film, middle, curve)) < brightness(as) ? low : high) = middle;
  }
  return shown(film, low, curve);
}

// The published images by renderer, averaged down to this size.
std::map<std::string, Picture> published(const View& view, int width, int height) {
  std::map<std::string, Picture> found;
  for (const auto& file : view.pictures)
    if (auto picture = thumbnail(file, width, height)) found[file.stem().string()] = std::move(*picture);
  return found;
}

std::string figure(const std::map<std::string, Picture>& pictures, const std::string& name, const Picture& with) {
  const auto found = pictures.find(name);
  char text[16] = "";
  if (found != pictures.end()) std::snprintf(text, sizeof text, "%.3f", flip(with, found->second));
  return text;
}

void print_header() {
  std::printf("| file | Cycles to Étendue |");
  for (const char* other : kOthers) std::printf(" to %s |", other);
  std::printf(" Étendue to the nearest |\n|---|---|");
  for ([[maybe_unused]] const char* other : kOthers) std::printf("---|");
  std::printf("---|\n");
}

void print_row(const View& view, const Picture& ours, const std::map<std::string, Picture>& pictures) {
  const Picture& cycles = pictures.at(kFirst);
  std::printf("| %s | %.3f |", view.file.stem().string().c_str(), flip(cycles, ours));
  for (const char* other : kOthers) std::printf(" %s |", figure(pictures, other, cycles).c_str());
  double least = 1;
  for (const auto& [name, picture] : pictures) least = std::min(least, flip(ours, picture));
  std::printf(" %.3f |\n", least);
  std::fflush(stdout);
}

}  // namespace

double flip(const Picture& a, const Picture& b) {
  return metrics::mean_of(metrics::flip_map(a.width, a.height, linear_of(a), linear_of(b)));
}

std::optional<BesidePublished> beside_published(const View& view, int size, uint32_t samples,
                                                const std::string& setting) {
  if (view.pictures.empty() || view.pictures[0].stem() != kFirst) return std::nullopt;
  render::Document document = *open(view, size, view.background);
  if (!setting.empty()) document = *test::with_materials_set(std::move(document), setting);
  const film::Film film = test::rendered(document, samples);
  BesidePublished beside{{}, published(view, film.width(), film.height())};
  beside.ours = with_equal_brightness(film, beside.cycles(), document.display.curve);
  return beside;
}

int make_fidelity(const std::string& data, const std::string& out, int tile, int size, uint32_t samples,
                  const std::string& setting) {
  constexpr int kColumns = 8;
  Sheet sheet(tile, kColumns);
  print_header();
  for (const View& view : gallery(data)) {
    const auto beside = beside_published(view, size, samples, setting);
    if (!beside) continue;
    print_row(view, beside->ours, beside->pictures);
    const Picture small = shrunk(beside->ours, tile), cycles = shrunk(beside->cycles(), tile);
    sheet.add(&small, view.file.stem().string());
    sheet.add(&cycles, "CYCLES");
  }
  const Picture picture = sheet.picture();
  const auto written = image::write_png(out, picture.width, picture.height, picture.rgb);
  if (!written) std::printf("%s\n", written.error().message.c_str());
  return written ? 0 : 4;
}

}  // namespace etendue::looks
