// Finished figures: their files, their thumbnails for a contact sheet, and their form as the content of a part.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "figures/figure.h"

namespace etendue::figures {

struct FinishedFigure {
  const Figure* figure = nullptr;
  std::vector<std::byte> png;  // the file, with the number and the title of the figure
  Picture thumbnail;
};

Result<FinishedFigure> finished(const Figure& figure, const MakeContext& context);

// Names its thumbnails with number and title.
Parts contact_sheet(const std::vector<FinishedFigure>& figures);
inline constexpr int kContactSheetColumns = 6;

std::vector<std::byte> bytes_of(const std::vector<FinishedFigure>& figures);
// Nothing if the bytes are damaged, or if a figure does not exist.
std::optional<std::vector<FinishedFigure>> figures_from(std::span<const std::byte> bytes);

}  // namespace etendue::figures
