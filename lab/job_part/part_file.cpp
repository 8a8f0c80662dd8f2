#include "job_part/part_file.h"

#include <algorithm>
#include <array>
#include <fstream>

#include "base/file.h"
#include "base/hash.h"

namespace etendue::job_part {
namespace {

namespace fs = std::filesystem;

const std::string kFirstLine = "etendue part 1\n";
constexpr size_t kNamedParts = 3;  // missing parts that a message names

void write(StateWriter& out, const Settings& settings) {
  out.value<uint64_t>(settings.size());
  for (const auto& [name, value] : settings) {
    write_text(out, name);
    write_text(out, value);
  }
}

bool read(StateReader& in, Settings& settings) {
  uint64_t count = 0;
  if (!in.value(count)) return false;
  for (uint64_t i = 0; i < count; ++i) {
    std::string name, value;
    if (!read_text(in, name) || !read_text(in, value)) return false;
    settings.emplace_back(std::move(name), std::move(value));
  }
  return true;
}

bool read(StateReader& in, PartHeader& header) {
  return read_text(in, header.job) && read_text(in, header.version) && in.value(header.share) &&
         is_valid(header.share) && read(in, header.settings) && read(in, header.arguments);
}

uint64_t checksum_of(std::span<const std::byte> bytes) {
  return hash_bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

std::string value_in(const Settings& settings, const std::string& name) {
  const auto found = std::ranges::find(settings, name, &Settings::value_type::first);
  return found == settings.end() ? "not set" : found->second;
}

// Why two parts are not parts of one job; empty if they are.
std::string difference_of(const PartHeader& part, const PartHeader& other) {
  if (part.job != other.job) return "it is a part of " + part.job + ", not of " + other.job;
  for (const auto& [name, value] : part.settings)
    if (const std::string expected = value_in(other.settings, name); value != expected)
      return name + " is " + value + ", not " + expected;
  if (part.settings.size() != other.settings.size()) return "its settings are others";
  if (part.share.parts != other.share.parts)
    return "it is " + text_of(part.share) + ", not of " + std::to_string(other.share.parts);
  return "";
}

// One element per part of the job, empty for parts without a file.
using FileOfPart = std::vector<fs::path>;

Result<void> check_complete(const FileOfPart& files) {
  std::string missing;
  size_t count = 0;
  for (size_t i = 0; i < files.size(); ++i) {
    if (!files[i].empty() || ++count > kNamedParts) continue;
    missing += (count > 1 ? ", " : "") + std::to_string(i + 1);
  }
  if (count == 0) return {};
  if (count > kNamedParts) missing += " and " + std::to_string(count - kNamedParts) + " more";
  return input_error("merge: missing: part " + missing + " of " + std::to_string(files.size()) +
                     "; compute what is missing with --part");
}

}  // namespace

fs::path part_path(const fs::path& folder, const Share& share) {
  return folder / ("part-" + std::to_string(share.part) + "-of-" + std::to_string(share.parts) + ".part");
}

Result<fs::path> new_part_path(const fs::path& folder, const Share& share) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (!fs::is_directory(folder, code))
    return output_error(folder.string() + ": not a folder, and it cannot be created");
  const fs::path path = part_path(folder, share);
  if (fs::exists(path, code))
    return output_error(path.string() + ": exists already; delete it to compute this part again");
  if (auto ok = check_writable(path); !ok) return ok.error();
  return path;
}

Result<void> write_part(const fs::path& path, const Part& part) {
  StateWriter out;
  write_text(out, part.header.job);
  write_text(out, part.header.version);
  out.value(part.header.share);
  write(out, part.header.settings);
  write(out, part.header.arguments);
  out.list(std::span<const std::byte>(part.content));
  const std::vector<std::byte> body = out.take();
  const uint64_t checksum = checksum_of(body);
  return write_atomically(path, [&](const fs::path& temporary) -> Result<void> {
    std::ofstream file(temporary, std::ios::binary);
    file << kFirstLine;
    file.write(reinterpret_cast<const char*>(&checksum), sizeof checksum);
    file.write(reinterpret_cast<const char*>(body.data()), static_cast<std::streamsize>(body.size()));
    if (file.flush()) return {};
    return output_error(path.string() + ": cannot be written completely; is the disk full?");
  });
}

bool is_part(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line(kFirstLine.size(), '\0');
  file.read(line.data(), static_cast<std::streamsize>(line.size()));
  return file && line == kFirstLine;
}

Result<Part> read_part(const fs::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  if (!is_part(path))
    return input_error(path.string() +
                       ": is not a part; parts are written by bench, stress and figure --all with --part");
  uint64_t checksum = 0;
  const auto rest = std::span<const std::byte>(*bytes).subspan(kFirstLine.size());
  if (rest.size() < sizeof checksum) return damaged(path);
  std::memcpy(&checksum, rest.data(), sizeof checksum);
  const auto body = rest.subspan(sizeof checksum);
  if (checksum_of(body) != checksum) return damaged(path);
  Part part;
  StateReader in(body);
  if (!read(in, part.header) || !in.list(part.content) || !in.at_end()) return damaged(path);
  return part;
}

Result<PartSet> complete_set(const std::vector<std::string>& files, const std::string& version) {
  PartSet set;
  FileOfPart file_of_part;
  for (const std::string& file : files) {
    const auto part = read_part(file);
    if (!part) return part.error();
    const PartHeader& header = part->header;
    if (header.version != version)
      return input_error(file + ": is a part of etendue " + header.version + ", but this is etendue " + version +
                         "; merge with the version that computed it");
    if (file_of_part.empty()) {
      set.header = header;
      file_of_part.resize(header.share.parts);
    }
    if (const std::string text = difference_of(header, set.header); !text.empty())
      return input_error(file + ": is not a part of the same job as " + files[0] + ": " + text);
    fs::path& known = file_of_part[header.share.part - 1];
    if (!known.empty())
      return input_error(file + ": is " + text_of(header.share) + ", as " + known.string() + "; give each part once");
    known = file;
  }
  if (auto ok = check_complete(file_of_part); !ok) return ok.error();
  set.files = std::move(file_of_part);
  return set;
}

void write_text(StateWriter& out, const std::string& text) { out.list(std::span<const char>(text)); }

bool read_text(StateReader& in, std::string& text) {
  std::vector<char> letters;
  if (!in.list(letters)) return false;
  text.assign(letters.begin(), letters.end());
  return true;
}

Error damaged(const fs::path& path) { return input_error(path.string() + ": it is damaged; compute this part again"); }

}  // namespace etendue::job_part
