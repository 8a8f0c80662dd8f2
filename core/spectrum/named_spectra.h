// Spectra by name.
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "base/result.h"

namespace etendue {

// A spectrum and its name; neither if there is none. Two are equal if their names are.
template <class T>
struct NamedSpectrum {
  std::string name;
  std::shared_ptr<const T> spectrum = nullptr;

  explicit operator bool() const { return spectrum != nullptr; }
  const T* operator->() const { return spectrum.get(); }
  friend bool operator==(const NamedSpectrum& a, const NamedSpectrum& b) { return a.name == b.name; }
};

// Prepared spectra by name, each of which is prepared once. Threads may use it at the same time.
template <class T>
class NamedSpectra {
 public:
  // The spectrum with this name, or `prepare(name)`, a Result<T>. Errors are not kept: a file may appear or be
  // corrected.
  template <class Prepare>
  Result<std::shared_ptr<const T>> find(const std::string& name, Prepare&& prepare) {
    const std::scoped_lock lock(mutex_);
    if (const auto found = known_.find(name); found != known_.end()) return found->second;
    auto prepared = prepare(name);
    if (!prepared) return prepared.error();
    return known_[name] = std::make_shared<const T>(std::move(*prepared));
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const T>> known_;
};

}  // namespace etendue
