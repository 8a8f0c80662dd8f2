#include "base/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <mutex>

#include "base/file.h"
#include "base/provided_files.h"

namespace etendue {
namespace {

// A range of addresses where accesses to missing bytes of a file are expected. Read by a signal handler.
struct AddressRange {
  std::atomic<uintptr_t> begin{0}, end{0};  // `begin` is 0 if the range is free
  std::atomic<bool> is_damaged{false};
};
std::array<AddressRange, 256> g_mapped_ranges;

struct sigaction g_previous_action;

// Puts a page of zeros where the file has no bytes any more. The access is repeated afterwards.
void replace_missing_page(int, siginfo_t* info, void*) {
  const auto address = reinterpret_cast<uintptr_t>(info->si_addr);
  for (AddressRange& range : g_mapped_ranges) {
    const uintptr_t begin = range.begin;
    if (begin == 0 || address < begin || address >= range.end) continue;
    const auto page_size = static_cast<uintptr_t>(sysconf(_SC_PAGESIZE));
    void* page = reinterpret_cast<void*>(address / page_size * page_size);
    if (mmap(page, page_size, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) == MAP_FAILED) break;
    range.is_damaged = true;
    return;
  }
  sigaction(SIGBUS, &g_previous_action, nullptr);
}

void install_handler() {
  static std::once_flag installed;
  std::call_once(installed, [] {
    struct sigaction action {};
    action.sa_sigaction = replace_missing_page;
    action.sa_flags = SA_SIGINFO;
    sigaction(SIGBUS, &action, &g_previous_action);
  });
}

// Marks a free range as used; null if there is none.
AddressRange* claim_range(uintptr_t begin, size_t size) {
  for (AddressRange& range : g_mapped_ranges) {
    uintptr_t unused = 0;
    if (!range.begin.compare_exchange_strong(unused, begin)) continue;
    range.is_damaged = false;
    range.end = begin + size;
    return &range;
  }
  return nullptr;
}

Error cannot_read(const std::filesystem::path& path) {
  return input_error(path.string() + ": cannot be read: " + std::strerror(errno));
}

class Descriptor {
 public:
  explicit Descriptor(const std::filesystem::path& path) : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  // Of the file, in bytes; negative if it is unknown.
  int64_t size() const {
    struct stat status {};
    return number_ >= 0 && fstat(number_, &status) == 0 ? static_cast<int64_t>(status.st_size) : -1;
  }

 private:
  int number_;
};

}  // namespace

class MappedFile::Mapping {
 public:
  Mapping(void* address, size_t size, AddressRange* range, std::unique_ptr<const Descriptor> file)
      : address_(address), size_(size), range_(range), file_(std::move(file)) {}
  ~Mapping() {
    range_->end = 0;
    range_->begin = 0;
    munmap(address_, size_);
  }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;

  // The rest of the last page of a file reads as zero without a signal, so its size counts as well.
  bool is_damaged() const { return range_->is_damaged || file_->size() < static_cast<int64_t>(size_); }

 private:
  void* address_;
  size_t size_;
  AddressRange* range_;
  std::unique_ptr<const Descriptor> file_;
};

bool MappedFile::is_damaged() const { return mapping_ && mapping_->is_damaged(); }

Result<MappedFile> MappedFile::open(const std::filesystem::path& path) {
  MappedFile file;
  if (const auto* provided = provided_file(path)) {
    file.bytes_ = *provided;
    return file;
  }
  if (const auto ok = check_readable(path); !ok) return ok.error();
  auto descriptor = std::make_unique<const Descriptor>(path);
  const int64_t found_size = descriptor->size();
  if (found_size < 0) return cannot_read(path);
  note_file_read(path);
  const auto size = static_cast<size_t>(found_size);
  if (size == 0) return file;
  void* address = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor->number(), 0);
  if (address == MAP_FAILED) return cannot_read(path);
  AddressRange* range = claim_range(reinterpret_cast<uintptr_t>(address), size);
  if (!range) {
    munmap(address, size);
    auto copy = read_file(path);
    if (!copy) return copy.error();
    file.copy_ = std::make_shared<const std::vector<std::byte>>(std::move(*copy));
    file.bytes_ = *file.copy_;
    return file;
  }
  install_handler();
  madvise(address, size, MADV_WILLNEED);
  file.bytes_ = {static_cast<const std::byte*>(address), size};
  file.mapping_ = std::make_shared<const Mapping>(address, size, range, std::move(descriptor));
  return file;
}

}  // namespace etendue
