// A contact sheet: small images in rows with a line of text under each.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "image/image.h"

namespace etendue::looks {

// 8-bit RGB, row 0 at the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<uint8_t> rgb;
};

// An image file over black, averaged down to `size` pixels on its longer side.
Result<Picture> thumbnail(const std::filesystem::path& file, int size);
// The same for this width and height.
Result<Picture> thumbnail(const std::filesystem::path& file, int width, int height);
// Averages down to `size` pixels on the longer side.
Picture shrunk(const Picture& from, int size);

class Sheet {
 public:
  // Tiles of `tile` pixels with their text, `columns` per row.
  Sheet(int tile, int columns) : tile_(tile), columns_(columns) {}

  // A null image leaves the tile empty. Text that is too long is truncated at its beginning.
  void add(const Picture* picture, const std::string& text);
  // The next tile begins a row.
  void end_row();
  Picture picture() const;

 private:
  struct Tile {
    int row, column;
    Picture picture;
    std::string text;
  };
  int tile_, columns_;
  int row_ = 0, column_ = 0;
  std::vector<Tile> tiles_;
};

}  // namespace etendue::looks
