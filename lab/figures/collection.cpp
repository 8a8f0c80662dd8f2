#include "figures/collection.h"

#include "figures/composition.h"
#include "image/image.h"
#include "job_part/part_file.h"

namespace etendue::figures {
namespace {

constexpr int kThumbnail = 300;  // pixels

bool read(StateReader& in, FinishedFigure& figure) {
  std::string number;
  Picture& thumbnail = figure.thumbnail;
  if (!job_part::read_text(in, number) || !in.list(figure.png) || !in.value(thumbnail.width) ||
      !in.value(thumbnail.height) || !in.list(thumbnail.pixels))
    return false;
  figure.figure = find_figure(number);
  return figure.figure &&
         int64_t{3} * thumbnail.width * thumbnail.height == static_cast<int64_t>(thumbnail.pixels.size());
}

}  // namespace

Result<FinishedFigure> finished(const Figure& figure, const MakeContext& context) {
  const auto parts = figure.make(context);
  if (!parts) return parts.error();
  const std::string heading = std::string("Figure ") + figure.number + ": " + figure.title;
  const Picture picture = rasterized(composed(*parts, figure.columns, heading));
  auto png = image::encode_png(picture.width, picture.height, picture.pixels);
  if (!png) return png.error();
  return FinishedFigure{&figure, std::move(*png), thumbnail(rasterized(composed(*parts, figure.columns)), kThumbnail)};
}

Parts contact_sheet(const std::vector<FinishedFigure>& figures) {
  Parts sheet;
  for (const FinishedFigure& f : figures)
    sheet.push_back({.caption = std::string(f.figure->number) + " " + f.figure->title, .content = f.thumbnail});
  return sheet;
}

std::vector<std::byte> bytes_of(const std::vector<FinishedFigure>& figures) {
  StateWriter out;
  out.value<uint64_t>(figures.size());
  for (const FinishedFigure& f : figures) {
    job_part::write_text(out, f.figure->number);
    out.list(std::span<const std::byte>(f.png));
    out.value(f.thumbnail.width);
    out.value(f.thumbnail.height);
    out.list(std::span<const uint8_t>(f.thumbnail.pixels));
  }
  return out.take();
}

std::optional<std::vector<FinishedFigure>> figures_from(std::span<const std::byte> bytes) {
  StateReader in(bytes);
  uint64_t count = 0;
  if (!in.value(count)) return std::nullopt;
  std::vector<FinishedFigure> figures;
  for (uint64_t i = 0; i < count; ++i)
    if (!read(in, figures.emplace_back())) return std::nullopt;
  return in.at_end() ? std::optional(std::move(figures)) : std::nullopt;
}

}  // namespace etendue::figures
