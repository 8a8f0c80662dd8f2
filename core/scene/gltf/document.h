// A glTF file on its way to a Scene: what the parts of the importer share.
//
// tinygltf reads the structure. Bytes never pass through it: buffers and pictures are found, bounded and read here,
// because it would follow a lying buffer view out of its buffer. Inside the importer, what makes a file unusable is
// thrown as Unusable; load_gltf catches it and puts the file's name in front. `where` names an object as
// "meshes[3].primitives[0]".
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

namespace etendue::scene::gltf {

using Bytes = std::span<const std::byte>;

struct Unusable {
  std::string message;
};

[[noreturn]] inline void fail(const std::string& where, const std::string& what) {
  throw Unusable{where + ": " + what};
}

inline std::string at(const char* array, size_t i) { return std::string(array) + "[" + std::to_string(i) + "]"; }

struct Buffer {
  Bytes bytes;
  std::string problem;       // why there are no bytes; empty if there are
  bool placeholder = false;  // stands for what EXT_meshopt_compression makes; nobody minds its problem
};

struct ImageSource {
  std::string name;
  std::string uri;  // empty if the picture lies in a buffer view
  int view = -1;
};

struct Document {
  tinygltf::Model model;  // its buffers and images are empty: these here are meant
  std::vector<Buffer> buffers;
  std::vector<ImageSource> images;
  std::filesystem::path folder;  // where relative URIs start
  std::vector<std::string> warnings;

  std::deque<std::vector<std::byte>> storage;  // what `buffers` point into
  mutable std::atomic<uint64_t> claimed{0};    // bytes of arrays made so far, see claim()
};

// Reads and splits the file, finds its buffers, decompresses what is compressed and parses its structure. Throws
// Unusable, and Cancelled if `progress` of the decompression says so.
void open_document(const std::filesystem::path& path, Document& document, const std::function<bool(float)>& progress);

// Notes that an array of this many bytes will be made. A small file that asks for more than its size can justify (many
// uses of one accessor, accessors without data) is unusable, and is found to be before memory is taken.
void claim(const Document& document, uint64_t bytes, const std::string& where);

// `i` as an index into an array of `size` objects called `array`; anything else is unusable.
size_t checked_index(int i, size_t size, const std::string& where, const char* array);

// The extension of our own: what glTF has no words for (docs/ETENDUE_transport.schema.json).
inline constexpr const char* kTransport = "ETENDUE_transport";
// The light parameters that KHR_lights_punctual has members for; ETENDUE_transport has the others.
inline constexpr const char* kPunctualParameters[] = {"intensity", "range", "inner-cone", "outer-cone"};
// The member of ETENDUE_transport for a light parameter: "two-sided" is "twoSided".
std::string member_name(std::string_view parameter);

// The names of the extensions that the importer understands.
bool is_supported(const std::string& extension);

// Everything that the importer relies on afterwards: references lead somewhere, views lie in their buffers, accessors
// in their views and are of a kind that their use allows, nodes form trees. Throws Unusable; what nothing uses only
// gets a warning.
void validate(Document& document);

// Pictures of the document by index. Where there are none, `problem` says why.
struct ImageBytes {
  Bytes bytes;
  std::vector<std::byte> owned;
  std::string problem;
};
ImageBytes read_image(const Document& document, size_t image);
std::string image_name(const Document& document, size_t image);

// A bufferView's bytes, or why it has none.
struct ViewBytes {
  Bytes bytes;
  std::string problem;
};
ViewBytes view_bytes(const Document& document, int view);

}  // namespace etendue::scene::gltf
