// An opened glTF file: what all parts of the importer share.
//
// tinygltf parses the structure only. Buffers and images are located, bounded and read here, because tinygltf does not
// check that buffer views lie inside their buffers. Errors are thrown as FileError.
#pragma once
#include <tiny_gltf.h>

#include <atomic>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/mapped_file.h"
#include "scene/gltf/file_error.h"

namespace etendue::scene::gltf {

using Bytes = std::span<const std::byte>;

struct Buffer {
  Bytes bytes;
  std::string problem;       // why the bytes are missing; empty if they are not
  bool placeholder = false;  // stands for the result of EXT_meshopt_compression, which replaces it; no problem then
};

struct ImageSource {
  std::string name;
  std::string uri;  // empty if the image is in a buffer view
  int view = -1;
};

struct InputFile {
  tinygltf::Model model;  // its `buffers` and `images` are empty; use the members below
  std::vector<Buffer> buffers;
  std::vector<ImageSource> images;
  std::filesystem::path folder;  // base of relative URIs
  std::vector<std::string> warnings;

  // Own what `buffers` point into.
  std::deque<std::vector<std::byte>> storage;
  std::vector<MappedFile> files;
  mutable std::atomic<uint64_t> planned_bytes{0};  // bytes of arrays so far, see check_memory
};

// Reads and splits the file, opens its buffers, decompresses geometry and parses the structure. Throws FileError;
// Cancelled if `progress` of the decompression returns false.
void open_input_file(const std::filesystem::path& path, InputFile& input, const std::function<bool(float)>& progress);

// Throws FileError if a file became shorter while it was read.
void check_files(const InputFile& input);

// Call before making an array of this many bytes. Throws FileError if all arrays together need more than the size of
// the file can justify, as when many primitives use one accessor or accessors have no data.
void check_memory(const InputFile& input, uint64_t bytes, const std::string& where);

// Returns `i` if it is an index into an array of `size` objects with the name `array`; throws FileError otherwise.
size_t checked_index(int i, size_t size, const std::string& where, const char* array);

bool is_supported(const std::string& extension);

// The extension of KTX 2 textures, which are not supported.
inline constexpr const char* kBasisUniversal = "KHR_texture_basisu";

// Checks what the importer relies on afterwards: all references exist, buffer views lie inside their buffers, accessors
// inside their views and have types that their use allows, and nodes form trees. Throws FileError. Defects of objects
// that nothing uses only get a warning.
void check_references(InputFile& input);

// The encoded bytes of an image. If there are none, `problem` says why.
struct ImageBytes {
  Bytes bytes;
  std::vector<std::byte> owned;
  std::string problem;
};
ImageBytes read_image(const InputFile& input, size_t image);
std::string image_name(const InputFile& input, size_t image);

// The bytes of a buffer view. If there are none, `problem` says why.
struct ViewBytes {
  Bytes bytes;
  std::string problem;
};
ViewBytes view_bytes(const InputFile& input, int view);

}  // namespace etendue::scene::gltf
