// Renders every glTF file of the test data and writes the images as a contact sheet.
//
//   looks DATA OUT.png [TILE [SAMPLES]]            renderings only
//   looks --beside DATA OUT.png [TILE [SAMPLES]]   each next to its published images, where there are any
//   looks --references DATA OUT.png [SAMPLES]      a table of errors against linear reference images; rendering,
//                                                  reference, difference
//   looks --scenes DATA OUT.png [SAMPLES [SIZE]]   the same for the scenes, at SIZE pixels
//   looks --fidelity DATA OUT.png [TILE [SIZE [SAMPLES [NAME=VALUE]]]]
//                                                  renderings next to published Cycles images, and a table of FLIP;
//                                                  NAME=VALUE sets a parameter of all materials
//   looks --builtin OUT.png [TILE [SAMPLES]]       the built-in scenes, and the mean luminance of each
//   looks --pictures OUT.png TILE COLUMNS (FILE TEXT)...
//                                                  image files, each with a text (tools/contact_sheet.sh)
//
// The exit code is 1 if a sample was not a finite, non-negative number.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>

#include "integration/looks/assets.h"
#include "integration/looks/fidelity.h"
#include "integration/looks/sheet.h"
#include "metrics/heat_map.h"
#include "metrics/metrics.h"
#include "scene/builtin/builtin.h"
#include "support/scenes.h"

namespace etendue::looks {
namespace {

constexpr int kPicturesBeside = 4;

std::vector<float> pixels_of(const film::Film& film) {
  std::vector<float> pixels;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      for (int c = 0; c < 3; ++c) pixels.push_back(film.mean(x, y)[c]);
  return pixels;
}

// Prints and returns the number of invalid samples.
uint64_t report_invalid_samples(const std::string& name, const film::Film& film) {
  const auto invalid = film.invalid_samples();
  if (invalid.total() > 0)
    std::printf("%s: %llu NaN, %llu infinite, %llu negative samples\n", name.c_str(),
                static_cast<unsigned long long>(invalid.nan), static_cast<unsigned long long>(invalid.infinite),
                static_cast<unsigned long long>(invalid.negative));
  return invalid.total();
}

void add_pictures(const View& view, int tile, Sheet& sheet) {
  int room = kPicturesBeside;
  for (const auto& file : view.pictures) {
    if (room-- == 0) break;
    const auto picture = thumbnail(file, tile);
    if (!picture) std::printf("%s\n", picture.error().message.c_str());
    sheet.add(picture ? &*picture : nullptr, file.stem().string());
  }
  sheet.end_row();
}

Picture displayed(const image::LayeredImage& image, const render::Document& document) {
  return {image.width, image.height,
          image::display_pixels(image.find("")->pixels, document.display.exposure, document.display.curve)};
}

int save(const Sheet& sheet, const std::string& out) {
  const Picture picture = sheet.picture();
  const auto written = image::write_png(out, picture.width, picture.height, picture.rgb);
  if (!written) std::printf("%s\n", written.error().message.c_str());
  return written ? 0 : 4;
}

int make_sheet(const std::string& data, const std::string& out, bool beside, int tile, uint32_t samples) {
  constexpr int kColumns = 13;
  Sheet sheet(tile, beside ? 1 + kPicturesBeside : kColumns);
  uint64_t invalid = 0;
  for (const View& view : gallery(data)) {
    if (beside && view.pictures.empty()) continue;
    const auto document = open(view, tile, view.background);
    if (document) {
      const film::Film film = test::rendered(*document, samples);
      invalid += report_invalid_samples(view.name, film);
      const Picture ours{film.width(), film.height(),
                         image::display_pixels(pixels_of(film), document->display.exposure, document->display.curve)};
      sheet.add(&ours, view.name);
    } else {
      std::printf("%s\n", document.error().message.c_str());
      sheet.add(nullptr, view.name);
    }
    if (beside) add_pictures(view, tile, sheet);
  }
  if (const int failed = save(sheet, out)) return failed;
  return invalid > 0 ? 1 : 0;
}

// Averages down by an integer factor. Returns the image unchanged if there is none.
image::LayeredImage shrunk(const image::LayeredImage& from, int width) {
  const int f = from.width % width == 0 && from.height % (from.width / width) == 0 ? from.width / width : 1;
  const auto& pixels = from.find("")->pixels;
  image::LayeredImage to{from.width / f, from.height / f, {{"", {"R", "G", "B"}, {}}}, {}};
  for (int y = 0; y < to.height; ++y)
    for (int x = 0; x < to.width; ++x)
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int i = 0; i < f * f; ++i)
          sum += pixels[static_cast<size_t>(((y * f + i / f) * from.width + x * f + i % f) * 3 + c)];
        to.layers[0].pixels.push_back(static_cast<float>(sum / (f * f)));
      }
  return to;
}

double mean(std::span<const float> values) {
  double sum = 0;
  for (const float v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

int make_table(const std::vector<Reference>& references, const std::string& out, int size, uint32_t samples) {
  uint64_t invalid = 0;
  Sheet sheet(size, 3);
  std::printf("%-30s %10s %10s %10s\n", "asset", "mean/ref", "relmse", "rmse");
  for (const Reference& reference : references) {
    const auto document = open(reference.view, size, true);
    const auto full = image::read_linear(reference.linear);
    if (!document || !full) {
      std::printf("%s\n", (document ? full.error() : document.error()).message.c_str());
      return 3;
    }
    const film::Film film = test::rendered(*document, samples);
    invalid += report_invalid_samples(reference.view.name, film);
    image::LayeredImage ours{film.width(), film.height(), {{"", {"R", "G", "B"}, pixels_of(film)}}, {}};
    const image::LayeredImage linear = shrunk(*full, film.width());
    const auto metrics = metrics::compare(ours, linear);
    if (!metrics) return std::printf("%s\n", metrics.error().message.c_str()), 3;
    std::printf("%-30s %10.4f %10.5f %10.5f\n", reference.view.name.c_str(),
                mean(ours.layers[0].pixels) / mean(linear.find("")->pixels), metrics->relmse, metrics->rmse);
    const Picture mine = displayed(ours, *document), theirs = displayed(linear, *document);
    const Picture difference{ours.width, ours.height, metrics::heat_map(ours, linear)};
    sheet.add(&mine, reference.view.name);
    sheet.add(&theirs, "reference");
    sheet.add(&difference, "difference");
  }
  if (const int failed = save(sheet, out)) return failed;
  return invalid > 0 ? 1 : 0;
}

int make_builtin_sheet(const std::string& out, int tile, uint32_t samples) {
  constexpr int kColumns = 4;
  Sheet sheet(tile, kColumns);
  uint64_t invalid = 0;
  for (const scene::Builtin& builtin : scene::builtins()) {
    auto document = *render::new_document(builtin.name);
    document.width = document.height = tile;
    const film::Film film = test::rendered(document, samples);
    invalid += report_invalid_samples(builtin.name, film);
    std::printf("%-20s %8.4f\n", builtin.name, static_cast<double>(luminance(test::mean_color(film))));
    const Picture ours{film.width(), film.height(), image::display_pixels(pixels_of(film), 0, document.display.curve)};
    sheet.add(&ours, builtin.name);
  }
  if (const int failed = save(sheet, out)) return failed;
  return invalid > 0 ? 1 : 0;
}

// A file that cannot be read leaves its tile empty.
int make_picture_sheet(const std::string& out, int tile, int columns, std::span<const std::string> files_and_texts) {
  Sheet sheet(tile, columns);
  for (size_t i = 0; i + 1 < files_and_texts.size(); i += 2) {
    const auto picture = thumbnail(files_and_texts[i], tile);
    sheet.add(picture ? &*picture : nullptr, files_and_texts[i + 1]);
  }
  return save(sheet, out);
}

int run(std::vector<std::string> args) {
  const auto take = [&](const char* flag) { return std::erase(args, flag) > 0; };
  const bool beside = take("--beside"), table = take("--references"), of_scenes = take("--scenes"),
             builtin = take("--builtin"), pictures = take("--pictures"), fidelity = take("--fidelity");
  const auto number = [&](size_t i, int usual) {
    return args.size() > i ? std::max(1, std::atoi(args[i].c_str())) : usual;
  };
  if (builtin && !args.empty())
    return make_builtin_sheet(args[0], number(1, 192), static_cast<uint32_t>(number(2, 256)));
  if (pictures && args.size() >= 5)
    return make_picture_sheet(args[0], number(1, 160), number(2, 8), std::span(args).subspan(3));
  if (!args.empty() && !std::filesystem::is_directory(args[0] + "/gltf")) {
    std::fprintf(stderr, "looks: %s: has no folder gltf; expected the folder of the test data\n", args[0].c_str());
    return 3;
  }
  if (table && args.size() >= 2)
    return make_table(references(args[0]), args[1], 320, static_cast<uint32_t>(number(2, 256)));
  if (fidelity && args.size() >= 2)
    return make_fidelity(args[0], args[1], number(2, 96), number(3, 256), static_cast<uint32_t>(number(4, 128)),
                         args.size() > 5 ? args[5] : "");
  if (of_scenes && args.size() >= 2)
    return make_table(scenes(args[0]), args[1], number(3, 512), static_cast<uint32_t>(number(2, 64)));
  if (args.size() >= 2)
    return make_sheet(args[0], args[1], beside, number(2, 128), static_cast<uint32_t>(number(3, 64)));
  std::fprintf(stderr,
               "usage: looks [--beside] DATA OUT.png [TILE [SAMPLES]] | looks --references DATA OUT.png [SAMPLES]"
               " | looks --fidelity DATA OUT.png [TILE [SIZE [SAMPLES [NAME=VALUE]]]]"
               " | looks --scenes DATA OUT.png [SAMPLES [SIZE]] | looks --builtin OUT.png [TILE [SAMPLES]]"
               " | looks --pictures OUT.png TILE COLUMNS (FILE TEXT)...\n");
  return 2;
}

}  // namespace
}  // namespace etendue::looks

int main(int argc, char** argv) { return etendue::looks::run({argv + 1, argv + argc}); }
