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

// Prepared spectra by name. A spectrum in use is prepared once. Threads may use the object at the same time.
template <class T>
class NamedSpectra {
 public:
  // The spectrum with this name, or `prepare(name)`, a Result<T>. Errors are not kept: a file may appear or be
  // corrected.
  template <class Prepare>
  Result<std::shared_ptr<const T>> find(const std::string& name, Prepare&& prepare) {
    const std::scoped_lock lock(mutex_);
    if (const auto found = known_.find(name); found != known_.end())
      if (auto in_use = found->second.lock()) return in_use;
    auto prepared = prepare(name);
    if (!prepared) return prepared.error();
    std::erase_if(known_, [](const auto& entry) { return entry.second.expired(); });
    auto spectrum = std::make_shared<const T>(std::move(*prepared));
    known_[name] = spectrum;
    return spectrum;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::weak_ptr<const T>> known_;
};

}  // namespace etendue
