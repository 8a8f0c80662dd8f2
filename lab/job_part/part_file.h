// Files with the results of a part of a job: a header that tells parts of one job from others, and the results, in a
// form that the job determines.
//
// A file begins with a line of text; a checksum, the header and the content follow. Numbers are stored as in memory, so
// that merged results have the same bits as those of one process.
#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/state_bytes.h"
#include "job_part/share.h"

namespace etendue::job_part {

using Settings = std::vector<std::pair<std::string, std::string>>;  // names and values

struct PartHeader {
  std::string job;      // the command: "bench", "stress" or "figure"
  std::string version;  // of the program
  Share share = {};
  Settings settings = {};   // what the results depend on; equal in all parts
  Settings arguments = {};  // other arguments, which may differ between machines, such as the path of the scene
};

struct Part {
  PartHeader header = {};
  std::vector<std::byte> content = {};
};

// The file of a share in a folder: "part-2-of-8.part".
std::filesystem::path part_path(const std::filesystem::path& folder, const Share& share);

// The path of a part that is to be computed. The folder is created. A file that exists is an output error.
Result<std::filesystem::path> new_part_path(const std::filesystem::path& folder, const Share& share);

Result<void> write_part(const std::filesystem::path& path, const Part& part);

// Whether a file begins as a part does. False if it cannot be read.
bool is_part(const std::filesystem::path& path);

// An input error if the file is damaged or is no part.
Result<Part> read_part(const std::filesystem::path& path);

// The parts of one job. They are read one after the other, so that memory holds one of them.
struct PartSet {
  std::vector<std::filesystem::path> files;  // in the order of their numbers
  PartHeader header;                         // of the first
};

// Checks that the files are all parts of one job of this version of the program. Errors name files of other jobs,
// settings or versions, parts that are given twice, and missing parts.
Result<PartSet> complete_set(const std::vector<std::string>& files, const std::string& version);

// Texts in the content of a part.
void write_text(StateWriter& out, const std::string& text);
bool read_text(StateReader& in, std::string& text);

// The error of a part whose content cannot be read.
Error damaged(const std::filesystem::path& path);

}  // namespace etendue::job_part
