#include "bsdf/measured/measured_data.h"

#include <map>
#include <memory>
#include <mutex>

#include "bsdf/all_lobes.h"
#include "bsdf/bsdf_model.h"

namespace etendue {
namespace {

// A cache with one value of each type and key. `make` is called if the value does not exist; its errors are not cached.
template <class Value, class Make>
Result<const Value*> cached(const std::string& key, Make&& make) {
  static std::mutex mutex;
  static std::map<std::string, std::unique_ptr<const Value>, std::less<>> values;
  const std::scoped_lock lock(mutex);
  auto& value = values[key];
  if (!value) {
    Result<std::unique_ptr<const Value>> made = make();
    if (!made) return made.error();
    value = std::move(*made);
  }
  return value.get();
}

template <class Value>
const Value* or_null(const Result<const Value*>& result) {
  return result ? *result : nullptr;
}

template <class Value>
Result<void> status_of(const Result<const Value*>& result) {
  if (!result) return result.error();
  return {};
}

Result<const RglBrdf*> rgl(const std::string& path) {
  return cached<RglBrdf>(path, [&]() -> Result<std::unique_ptr<const RglBrdf>> {
    auto brdf = RglBrdf::read(path);
    if (!brdf) return brdf.error();
    return std::make_unique<const RglBrdf>(std::move(*brdf));
  });
}

using SampledMerl = SampledBrdf<MerlBrdf>;
Result<const SampledMerl*> merl(const std::string& path) {
  return cached<SampledMerl>(path, [&]() -> Result<std::unique_ptr<const SampledMerl>> {
    auto brdf = MerlBrdf::read(path);
    if (!brdf) return brdf.error();
    return std::make_unique<const SampledMerl>(std::move(*brdf), 1, false);
  });
}

std::vector<std::string> split_at_spaces(std::string_view text) {
  std::vector<std::string> words;
  size_t at = 0;
  while (at < text.size()) {
    const size_t end = std::min(text.find(' ', at), text.size());
    if (end > at) words.emplace_back(text.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

bool names_model(std::string_view source) {
  const auto words = split_at_spaces(source);
  return !words.empty() && find_bsdf_model(words[0]) != nullptr;
}

// The model that a source names, with its parameters set.
Result<std::shared_ptr<const BsdfModel>> model_of(std::string_view source) {
  const auto words = split_at_spaces(source);
  auto model = make_bsdf_model(words[0]);
  for (size_t k = 1; k < words.size(); ++k) {
    const size_t equals = std::min(words[k].find('='), words[k].size());
    const std::string name = words[k].substr(0, equals);
    const auto parameters = model->parameters();
    const ParameterInfo* p = find_parameter(parameters, name);
    if (!p || equals == words[k].size())
      return usage_error("'" + words[k] + "' is not a parameter of " + words[0] + "; expected NAME=VALUE");
    const auto value = parse_value(*p, std::string_view(words[k]).substr(equals + 1));
    if (!value) return value.error();
    model = model->with(name, *value);
  }
  AllLobes<Rgb> lobes;
  model->add_unprepared_lobes(lobes);
  if (model->is_solid() || !lobes.has_non_delta_lobe())
    return usage_error(words[0] + " cannot be tabulated: it reflects only specularly or transmits light");
  return model;
}

using SampledTable = SampledBrdf<BrdfTable>;
std::unique_ptr<const SampledTable> sampled(BrdfTable table) {
  const int azimuths = table.isotropic() ? 1 : std::min(table.azimuths(), 16);
  return std::make_unique<const SampledTable>(std::move(table), azimuths, azimuths > 1);
}

Result<const SampledTable*> table(const std::string& source, int polar, int azimuths) {
  const bool from_model = names_model(source);
  const std::string size = from_model ? " " + std::to_string(polar) + " x " + std::to_string(azimuths) : "";
  return cached<SampledTable>(source + size, [&]() -> Result<std::unique_ptr<const SampledTable>> {
    if (!from_model) {
      auto read = BrdfTable::read(source);
      if (!read) return read.error();
      return sampled(std::move(*read));
    }
    const auto model = model_of(source);
    if (!model) return model.error();
    AllLobes<Rgb> lobes;
    (*model)->add_lobes(Rgb(1), lobes);
    const auto f = [&](const Vec3& o, const Vec3& i) { return lobes.eval(o, i, TransportMode::radiance); };
    return sampled(BrdfTable::measured(f, polar, azimuths, !depends_on_azimuth(lobes)));
  });
}

using SampledHarmonics = SampledBrdf<HarmonicBrdf>;
Result<const SampledHarmonics*> harmonics(const std::string& source, int bands) {
  return cached<SampledHarmonics>(
      source + " " + std::to_string(bands), [&]() -> Result<std::unique_ptr<const SampledHarmonics>> {
        if (!names_model(source)) {
          const auto read = table(source, 0, 0);
          if (!read) return read.error();
          const SampledTable& t = **read;
          return std::make_unique<const SampledHarmonics>(
              HarmonicBrdf([&](const Vec3& o, const Vec3& i) { return t.f(o, i); }, bands), 1, true);
        }
        const auto model = model_of(source);
        if (!model) return model.error();
        AllLobes<Rgb> lobes;
        (*model)->add_lobes(Rgb(1), lobes);
        const auto f = [&](const Vec3& o, const Vec3& i) { return lobes.eval(o, i, TransportMode::radiance); };
        return std::make_unique<const SampledHarmonics>(HarmonicBrdf(f, bands), 1, true);
      });
}

// Whether the source is this model, with or without parameters.
bool is_model(std::string_view source, std::string_view model) {
  const auto words = split_at_spaces(source);
  return !words.empty() && words[0] == model;
}

Error recursive_source(std::string_view source) {
  return usage_error("'" + std::string(source) + "' is a table itself; name the model or file that it tabulates");
}

}  // namespace

Result<void> accepts_rgl_file(std::string_view path) { return status_of(rgl(std::string(path))); }
Result<void> accepts_merl_file(std::string_view path) { return status_of(merl(std::string(path))); }

Result<void> accepts_table_source(std::string_view source) {
  if (is_model(source, "tabulated") || is_model(source, "spherical-harmonics")) return recursive_source(source);
  if (!names_model(source)) return status_of(table(std::string(source), 0, 0));
  if (const auto model = model_of(source); !model) return model.error();
  return {};
}

Result<void> accepts_harmonic_source(std::string_view source) {
  if (is_model(source, "spherical-harmonics")) return recursive_source(source);
  if (!names_model(source)) {
    const auto read = table(std::string(source), 0, 0);
    if (!read) return read.error();
    if (!(*read)->function().isotropic())
      return usage_error("'" + std::string(source) + "' is anisotropic; spherical harmonics need an isotropic table");
    return {};
  }
  const auto model = model_of(source);
  if (!model) return model.error();
  AllLobes<Rgb> lobes;
  (*model)->add_unprepared_lobes(lobes);
  if (depends_on_azimuth(lobes))
    return usage_error("'" + std::string(source) + "' is anisotropic; spherical harmonics need an isotropic model");
  return {};
}

const RglBrdf* rgl_data(const std::string& path) { return path == kNoFile ? nullptr : or_null(rgl(path)); }
const SampledMerl* merl_data(const std::string& path) { return path == kNoFile ? nullptr : or_null(merl(path)); }
const SampledTable* table_data(const std::string& source, int polar, int azimuths) {
  return or_null(table(source, polar, azimuths));
}
const SampledHarmonics* harmonic_data(const std::string& source, int bands) {
  return or_null(harmonics(source, bands));
}

}  // namespace etendue
